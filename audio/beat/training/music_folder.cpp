#include "audio/beat/training/music_folder.hpp"

#include <fmt/format.h>

#include <string>
#include <utility>
#include <vector>

#include "audio/beat/training/soundfont_player.hpp"
#include "audio/evaluate/beat_corpus.hpp"
#include "audio/io/audio_file.hpp"
#include "base/file.hpp"

namespace raks::audio {
namespace {

namespace fs = std::filesystem;

BeatEstimate told(const std::vector<PlayedBeat>& beats) {
    BeatEstimate estimate;
    for (const PlayedBeat& beat : beats) {
        estimate.beats.times.push_back(beat.time);
        estimate.beats.bar_positions.push_back(beat.bar_position);
    }
    return estimate;
}

Expected<void> make_folder(const fs::path& folder) {
    std::error_code error;
    fs::create_directories(folder, error);
    if (error || !fs::is_empty(folder, error) || error) {
        return fail(fmt::format("{}: {}",
                                folder.string(),
                                error ? error.message() : "is not empty; name a new folder"));
    }
    return {};
}

}  // namespace

Expected<void> write_music_folder(const CorpusPlan& plan, const fs::path& folder) {
    if (auto made = make_folder(folder); !made) {
        return made;
    }
    std::vector<std::string> rows(static_cast<std::size_t>(plan.excerpts));
    const auto write = [&](int number, const CorpusPiece& piece) -> Expected<void> {
        if (piece.beats.empty()) {
            return {};
        }
        const std::string name = fmt::format("{:05}", number);
        rows[static_cast<std::size_t>(number)] = fmt::format("{}\t{}\n", name, piece.family);
        if (auto written = save_beat_estimate(folder, name, told(piece.beats)); !written) {
            return written;
        }
        return write_wav(
            folder / (name + ".wav"), piece.samples, 1, SampleRate(SoundfontPlayer::kRate));
    };
    if (auto made = make_pieces(plan, write); !made) {
        return made;
    }
    std::string index = "name\tclass\n";
    for (const std::string& row : rows) {
        index += row;
    }
    return write_file(folder / "index.tsv", index);
}

}  // namespace raks::audio
