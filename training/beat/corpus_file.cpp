#include "training/beat/corpus.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstring>
#include <string>
#include <type_traits>
#include <utility>
#include <vector>

#include "audio/evaluate/beat_corpus.hpp"
#include "audio/io/audio_file.hpp"
#include "audio/io/wav_writer.hpp"
#include "audio/music/instruments/soundfont_band.hpp"
#include "base/file.hpp"
#include "base/pending_file.hpp"

// File of a training corpus: "RAKSBEAT", a version, then for each excerpt its sizes and numbers.
namespace raks::audio {
namespace {

constexpr std::string_view kCorpusMagic = "RAKSBEAT";
constexpr std::uint32_t kVersion = 3;
constexpr double kLongestBar = 64.0;     // bar positions beyond it mean damage
constexpr double kLongestExcerpt = 1e6;  // seconds
constexpr float kLoudest = 1e9F;         // mel magnitude: beyond it sums become infinite
constexpr std::size_t kLargest = std::size_t{4} << 30U;  // 4 GiB

// Appends numbers as this machine stores them.
template <class T>
void put(std::string& bytes, const T* values, std::size_t count) {
    static_assert(std::is_trivially_copyable_v<T>);
    bytes.append(reinterpret_cast<const char*>(values), count * sizeof(T));
}

/// Takes numbers off the front of a file. Once it was too short, every later call fails.
class Bytes {
 public:
    explicit Bytes(std::string_view bytes) : left_(bytes) {}

    template <class T>
    bool take(std::size_t count, std::vector<T>& values) {
        // Compared by division: count * sizeof(T) could overflow.
        if (count > left_.size() / sizeof(T)) {
            left_ = {};
            return false;
        }
        values.resize(count);
        if (count > 0) {
            std::memcpy(values.data(), left_.data(), count * sizeof(T));
        }
        left_.remove_prefix(count * sizeof(T));
        return true;
    }
    [[nodiscard]] bool is_empty() const { return left_.empty(); }

 private:
    std::string_view left_;
};

// One excerpt: four sizes, then family, style, mel and beats.
bool take_excerpt(Bytes& bytes, TrainingExcerpt& excerpt) {
    std::vector<std::uint64_t> sizes;
    std::vector<char> family;
    std::vector<char> style;
    std::vector<double> beats;
    if (!bytes.take(4, sizes) || !bytes.take(sizes[0], family) || !bytes.take(sizes[1], style) ||
        !bytes.take(sizes[2], excerpt.mel) || sizes[3] > kLargest ||
        !bytes.take(3 * sizes[3], beats)) {
        return false;
    }
    // Beats are stored as three doubles each; the comparisons are false for NaN.
    for (std::size_t i = 0; i < beats.size(); i += 3) {
        const double position = beats[i + 1];
        const double parts = beats[i + 2];
        if (!(std::abs(beats[i]) < kLongestExcerpt) ||
            !(position >= 0.0 && position <= kLongestBar) || !(parts == 2.0 || parts == 3.0)) {
            return false;
        }
        excerpt.beats.push_back({beats[i], static_cast<int>(position), static_cast<int>(parts)});
    }
    // NaN or infinite features would spoil a whole training run.
    const bool is_sound = std::all_of(excerpt.mel.begin(), excerpt.mel.end(), [](float magnitude) {
        return magnitude >= 0.0F && magnitude < kLoudest;
    });
    if (!is_sound) {
        return false;
    }
    excerpt.family.assign(family.begin(), family.end());
    excerpt.style.assign(style.begin(), style.end());
    return true;
}

}  // namespace

Expected<void> save_corpus(const std::vector<TrainingExcerpt>& corpus,
                           const std::filesystem::path& path) {
    std::string bytes(kCorpusMagic);
    put(bytes, &kVersion, 1);
    for (const TrainingExcerpt& excerpt : corpus) {
        const std::array<std::uint64_t, 4> sizes = {
            excerpt.family.size(), excerpt.style.size(), excerpt.mel.size(), excerpt.beats.size()};
        put(bytes, sizes.data(), sizes.size());
        put(bytes, excerpt.family.data(), excerpt.family.size());
        put(bytes, excerpt.style.data(), excerpt.style.size());
        put(bytes, excerpt.mel.data(), excerpt.mel.size());
        std::vector<double> beats;  // three numbers a beat: padding of a struct is undefined
        for (const PlayedBeat& beat : excerpt.beats) {
            beats.insert(beats.end(),
                         {beat.time,
                          static_cast<double>(beat.bar_position),
                          static_cast<double>(beat.parts)});
        }
        put(bytes, beats.data(), beats.size());
    }
    return write_file(path, bytes);
}

Expected<std::vector<TrainingExcerpt>> load_corpus(const std::filesystem::path& path) {
    std::uint32_t version = 0;
    // Magic and version first: a large file of another kind is not read whole.
    const auto start = read_file_start(path, kCorpusMagic.size() + sizeof(version));
    if (!start) {
        return fail(start.error());
    }
    if (!start->starts_with(kCorpusMagic) ||
        start->size() < kCorpusMagic.size() + sizeof(version)) {
        return fail(path.string() + ": not a corpus of beats");
    }
    std::memcpy(&version, start->data() + kCorpusMagic.size(), sizeof(version));
    if (version != kVersion) {
        return fail(path.string() + ": version " + std::to_string(version) +
                    " of a corpus, this program reads " + std::to_string(kVersion) +
                    "; delete it to make it anew");
    }
    const auto text = read_file(path, kLargest);
    if (!text) {
        return fail(text.error());
    }
    Bytes bytes(std::string_view(*text).substr(std::min(start->size(), text->size())));
    std::vector<TrainingExcerpt> corpus;
    while (!bytes.is_empty()) {
        TrainingExcerpt excerpt;
        if (!take_excerpt(bytes, excerpt) || excerpt.mel.size() % 36 != 0) {
            return fail(path.string() + ": cut short or damaged; delete it to make it anew");
        }
        corpus.push_back(std::move(excerpt));
    }
    return corpus;
}

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
        return write_wav(part / (name + ".wav"), piece.samples, 1, SampleRate(kPerformanceRate));
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
