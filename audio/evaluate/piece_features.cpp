#include "audio/evaluate/piece_features.hpp"

#include <algorithm>
#include <cmath>
#include <utility>
#include <vector>

#include "audio/features/noise_floor.hpp"
#include "audio/genre/genre_recognizer.hpp"
#include "audio/music_analyzer.hpp"
#include "base/file.hpp"
#include "base/pending_file.hpp"

#include <fmt/format.h>

namespace raks::audio {
namespace {

// Its number changes with the packed form and with the features.
constexpr std::string_view kMagic = "raks-genre-pieces-5\n";
constexpr std::size_t kMostBytes = std::size_t{4} << 30U;  // of a file

// Collects the features of each hop that counts as evidence, as GenreRecognizer does.
class FeatureSink final : public MusicAnalyzer::Sink {
 public:
    FeatureSink(const MusicAnalyzer& analyzer, PieceFeatures& piece)
        : analyzer_(analyzer), piece_(piece) {}

    void on_state(const MusicState& state) noexcept override {
        if (!is_genre_evidence(state)) {
            return;
        }
        piece_.frames.push_back(analyzer_.mfcc());
        // Bar patterns and the networks are trained on magnitudes without hiss; MFCC are not.
        const NoiseFloor::Bands& mel =
            noise_.subtract(analyzer_.mel_magnitudes().first<NoiseFloor::kBands>());
        piece_.mel.insert(piece_.mel.end(), mel.begin(), mel.end());
        // A segment is half a second: windows are kept every second one, once a second.
        if (patterns_.add(mel, state.grid, state.time) && ++closed_ % 2 == 0) {
            keep_windows();
        }
    }

 private:
    // One entry for each window length that the music so far fills.
    void keep_windows() {
        for (const int segments : kGenreWindows) {
            if (segments <= patterns_.segments()) {
                WindowFeatures& window = piece_.windows.emplace_back();
                window.segments = segments;
                window.end_frame = static_cast<int>(piece_.frames.size());
                patterns_.features(segments, window.features);
            }
        }
    }

    const MusicAnalyzer& analyzer_;
    PieceFeatures& piece_;
    NoiseFloor noise_;
    BarPatterns patterns_;
    int closed_ = 0;
};

}  // namespace

Expected<void> extract_features(std::span<const float> samples,
                                SampleRate rate,
                                const FeaturePlan& plan,
                                PieceFeatures& piece) {
    MusicAnalyzer analyzer;
    AnalyzerConfig config;
    config.sample_rate = rate;
    config.beat_network = plan.beat_network;
    config.cepstral_mean = plan.cepstral_mean;
    if (auto prepared = analyzer.prepare(config); !prepared) {
        return prepared;
    }
    FeatureSink sink(analyzer, piece);
    analyzer.process(samples, sink);
    return {};
}

Expected<void> save_pieces(std::span<const PieceFeatures> pieces,
                           const std::filesystem::path& path) {
    Packer packer(kMagic);
    for (const PieceFeatures& piece : pieces) {
        pack_piece(piece, packer);
    }
    return write_file(path, packer.take());
}

Expected<std::vector<PieceFeatures>> load_pieces(const std::filesystem::path& path) {
    // The head first: a wrong file of gigabytes is refused without reading it.
    const auto start = read_file_start(path, kMagic.size());
    if (!start) {
        return fail(start.error());
    }
    if (*start != kMagic) {
        return fail(path.string() + ": no pieces that this program heard; remove it");
    }
    const auto bytes = read_file(path, kMostBytes);
    if (!bytes) {
        return fail(bytes.error());
    }
    Unpacker unpacker(std::string_view(*bytes).substr(std::min(start->size(), bytes->size())));
    std::vector<PieceFeatures> pieces;
    while (!unpacker.at_end()) {
        auto piece = unpack_piece(unpacker);
        if (!piece) {
            return fail(fmt::format("{}: {}; remove it", path.string(), piece.error().message));
        }
        pieces.push_back(std::move(*piece));
    }
    return pieces;
}

namespace {

constexpr float kMost = 1e9F;  // larger ones would overflow sums of squares in float

// Whether all are finite and not huge; a NaN fails the comparison.
template <class Numbers>
bool are_sound(const Numbers& numbers) {
    return std::all_of(
        numbers.begin(), numbers.end(), [](float number) { return std::abs(number) < kMost; });
}

// Whether all numbers can come from feature computation: not huge, magnitudes not negative.
bool is_whole(const PieceFeatures& piece) {
    return std::all_of(piece.frames.begin(), piece.frames.end(), are_sound<MfccVector>) &&
           are_sound(piece.mel) &&
           std::all_of(piece.mel.begin(), piece.mel.end(), [](float mel) { return mel >= 0.0F; }) &&
           std::all_of(piece.windows.begin(),
                       piece.windows.end(),
                       [](const WindowFeatures& window) { return are_sound(window.features); });
}

}  // namespace

// The order is the file format: unpack_piece reads the same.
void pack_piece(const PieceFeatures& piece, Packer& packer) {
    packer.put_list(piece.name);
    packer.put_list(piece.group);
    packer.put_list(piece.genre);
    packer.put(piece.kind);
    packer.put_list(piece.frames);
    packer.put_list(piece.mel);
    packer.put_list(piece.windows);
}

Expected<PieceFeatures> unpack_piece(Unpacker& unpacker) {
    PieceFeatures piece;
    piece.name = unpacker.take_list<std::string>();
    piece.group = unpacker.take_list<std::string>();
    piece.genre = unpacker.take_list<std::string>();
    piece.kind = unpacker.take<PieceFeatures::Kind>();
    piece.frames = unpacker.take_list<std::vector<MfccVector>>();
    piece.mel = unpacker.take_list<std::vector<float>>();
    piece.windows = unpacker.take_list<std::vector<WindowFeatures>>();
    // The unpacker gives empty values after the end of its data, so one check here is enough.
    if (!unpacker.is_good()) {
        return fail("is cut short");
    }
    if (!is_whole(piece)) {
        return fail("holds numbers that no sound gives");
    }
    // One hop gives one MFCC vector and one row of mel magnitudes.
    if (piece.mel.size() != piece.frames.size() * BarPatterns::kMelBands) {
        return fail("frames of two kinds differ in number");
    }
    // score_piece reads a window's frames by these numbers without further checks.
    const bool fit =
        std::all_of(piece.windows.begin(), piece.windows.end(), [&](const WindowFeatures& window) {
            return window.segments >= 1 && window.segments <= BarPatterns::kSegments &&
                   window.end_frame >= window.segments * BarPatterns::kSegmentHops &&
                   window.end_frame <= static_cast<int>(piece.frames.size());
        });
    if (!fit) {
        return fail("a window lies outside its piece");
    }
    if ((!piece.genre.empty() && !is_dance_name(piece.genre)) ||
        piece.kind > PieceFeatures::Kind::written_held_out) {
        return fail("is damaged");
    }
    return piece;
}

}  // namespace raks::audio
