#include "training/beat/annotated_music.hpp"

#include <fmt/format.h>

#include <string>
#include <utility>
#include <vector>

#include "audio/evaluate/beat_corpus.hpp"
#include "audio/io/audio_file.hpp"
#include "audio/music/instruments/soundfont_player.hpp"
#include "base/file.hpp"

namespace raks::audio {
namespace {

namespace fs = std::filesystem;

// Annotated beats in the form of a tracker's estimate, which can be saved.
BeatEstimate told(const std::vector<PlayedBeat>& beats) {
    BeatEstimate estimate;
    for (const PlayedBeat& beat : beats) {
        estimate.beats.times.push_back(beat.time);
        estimate.beats.bar_positions.push_back(beat.bar_position);
    }
    return estimate;
}

}  // namespace

Expected<void> write_music_folder(const CorpusPlan& plan, const fs::path& folder) {
    // All is written into a pending folder and moved into place at the end: all or nothing.
    auto pending = PendingFile::create_folder(folder);
    if (!pending) {
        return fail(pending.error());
    }
    const fs::path& part = pending->part();
    // One slot a piece, because pieces arrive in any order; those without beats leave an empty row.
    std::vector<std::string> rows(static_cast<std::size_t>(plan.excerpts));
    const auto write = [&](int number, const CorpusPiece& piece) -> Expected<void> {
        if (piece.beats.empty()) {
            return {};
        }
        const std::string name = fmt::format("{:05}", number);
        rows[static_cast<std::size_t>(number)] = fmt::format("{}\t{}\n", name, piece.family);
        if (auto written = save_beat_estimate(part, name, told(piece.beats)); !written) {
            return written;
        }
        return write_wav(
            part / (name + ".wav"), piece.samples, 1, SampleRate(SoundfontPlayer::kRate));
    };
    if (auto made = make_pieces(plan, write); !made) {
        return made;
    }
    std::string index = "name\tclass\n";
    for (const std::string& row : rows) {
        index += row;
    }
    if (auto written = write_file(part / "index.tsv", index); !written) {
        return written;
    }
    return pending->commit();
}

}  // namespace raks::audio
