#include "audio/genre/training/heard_piece.hpp"

#include <algorithm>
#include <cstring>
#include <type_traits>

#include "audio/genre/genre_recognizer.hpp"
#include "audio/music_analyzer.hpp"
#include "base/file.hpp"

namespace raks::audio {
namespace {

constexpr std::string_view kMagic = "raks-genre-pieces-3\n";
constexpr std::size_t kMostBytes = std::size_t{4} << 30U;

class Listener final : public MusicAnalyzer::Sink {
 public:
    Listener(const MusicAnalyzer& analyzer, HeardPiece& piece)
        : analyzer_(analyzer), piece_(piece) {}

    void on_state(const MusicState& state) noexcept override {
        if (!is_genre_evidence(state)) {
            return;
        }
        piece_.frames.push_back(analyzer_.mfcc());
        const auto mel = analyzer_.mel_magnitudes().first<BarPatterns::kMelBands>();
        piece_.mel.insert(piece_.mel.end(), mel.begin(), mel.end());
        if (patterns_.add(mel, state.grid, state.time) && ++closed_ % 2 == 0) {
            keep_windows();
        }
    }

 private:
    void keep_windows() {
        for (const int segments : kGenreWindows) {
            if (segments <= patterns_.segments()) {
                HeardWindow& window = piece_.windows.emplace_back();
                window.segments = segments;
                window.end_frame = static_cast<int>(piece_.frames.size());
                patterns_.features(segments, window.features);
            }
        }
    }

    const MusicAnalyzer& analyzer_;
    HeardPiece& piece_;
    BarPatterns patterns_;
    int closed_ = 0;
};

/// Writes plain values and lists of them one after the other.
class Packer {
 public:
    template <class T>
    void put(const T& value) {
        static_assert(std::is_trivially_copyable_v<T>);
        bytes_.append(reinterpret_cast<const char*>(&value), sizeof value);
    }
    template <class List>
    void put_list(const List& list) {
        put(static_cast<std::uint32_t>(list.size()));
        bytes_.append(reinterpret_cast<const char*>(list.data()),
                      list.size() * sizeof(typename List::value_type));
    }
    [[nodiscard]] std::string take() { return std::move(bytes_); }

 private:
    std::string bytes_{kMagic};
};

/// Reads them back; after a fault everything is empty.
class Unpacker {
 public:
    explicit Unpacker(std::string_view bytes) : left_(bytes) {}
    [[nodiscard]] bool is_good() const { return is_good_; }
    [[nodiscard]] bool at_end() const { return left_.empty(); }

    template <class T>
    T take() {
        static_assert(std::is_trivially_copyable_v<T>);
        T value{};
        if (has(sizeof value)) {
            std::memcpy(&value, left_.data(), sizeof value);
            left_.remove_prefix(sizeof value);
        }
        return value;
    }
    template <class List>
    List take_list() {
        constexpr std::size_t kSize = sizeof(typename List::value_type);
        const std::size_t count = take<std::uint32_t>();
        List list;
        if (has(count * kSize)) {
            list.resize(count);
            std::memcpy(list.data(), left_.data(), count * kSize);
            left_.remove_prefix(count * kSize);
        }
        return list;
    }

 private:
    bool has(std::size_t bytes) {
        is_good_ = is_good_ && bytes <= left_.size();
        left_ = is_good_ ? left_ : std::string_view{};
        return is_good_;
    }

    std::string_view left_;
    bool is_good_ = true;
};

}  // namespace

Expected<void> hear_piece(std::span<const float> samples,
                          SampleRate rate,
                          const HearingPlan& plan,
                          HeardPiece& piece) {
    MusicAnalyzer analyzer;
    AnalyzerConfig config;
    config.sample_rate = rate;
    config.beat_network = plan.beat_network;
    config.cepstral_mean = plan.cepstral_mean;
    if (auto prepared = analyzer.prepare(config); !prepared) {
        return prepared;
    }
    Listener listener(analyzer, piece);
    analyzer.process(samples, listener);
    return {};
}

Expected<void> save_pieces(std::span<const HeardPiece> pieces, const std::filesystem::path& path) {
    Packer packer;
    for (const HeardPiece& piece : pieces) {
        packer.put_list(piece.name);
        packer.put_list(piece.group);
        packer.put(piece.genre);
        packer.put(piece.kind);
        packer.put_list(piece.frames);
        packer.put_list(piece.mel);
        packer.put_list(piece.windows);
    }
    return write_file(path, packer.take());
}

Expected<std::vector<HeardPiece>> load_pieces(const std::filesystem::path& path) {
    const auto bytes = read_file(path, kMostBytes);
    if (!bytes) {
        return fail(bytes.error());
    }
    if (!bytes->starts_with(kMagic)) {
        return fail(path.string() + ": no pieces that this program heard; remove it");
    }
    Unpacker unpacker(std::string_view(*bytes).substr(kMagic.size()));
    std::vector<HeardPiece> pieces;
    while (!unpacker.at_end() && unpacker.is_good()) {
        HeardPiece& piece = pieces.emplace_back();
        piece.name = unpacker.take_list<std::string>();
        piece.group = unpacker.take_list<std::string>();
        piece.genre = unpacker.take<Genre>();
        piece.kind = unpacker.take<HeardPiece::Kind>();
        piece.frames = unpacker.take_list<std::vector<MfccVector>>();
        piece.mel = unpacker.take_list<std::vector<float>>();
        piece.windows = unpacker.take_list<std::vector<HeardWindow>>();
        if (piece.mel.size() != piece.frames.size() * BarPatterns::kMelBands) {
            return fail(path.string() + ": frames of two kinds differ in number; remove the file");
        }
        for (const HeardWindow& window : piece.windows) {
            const bool fits = window.segments >= 1 && window.segments <= BarPatterns::kSegments &&
                              window.end_frame >= window.segments * BarPatterns::kSegmentHops &&
                              window.end_frame <= static_cast<int>(piece.frames.size());
            if (!fits) {
                return fail(path.string() + ": a window lies outside its piece; remove the file");
            }
        }
        if (piece.genre > Genre::unknown || piece.kind > HeardPiece::Kind::written_held_out) {
            return fail(path.string() + ": is damaged; remove it");
        }
    }
    if (!unpacker.is_good()) {
        return fail(path.string() + ": is cut short; remove it");
    }
    return pieces;
}

}  // namespace raks::audio
