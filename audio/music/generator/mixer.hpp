#pragma once

#include <array>
#include <cstdint>
#include <map>
#include <span>
#include <vector>

#include "audio/music/generator/notes.hpp"
#include "audio/music/generator/tempo_curve.hpp"

namespace raks::audio {

/// Small room after Schroeder (1962): four combs in parallel, two all-passes, one side each.
class Reverb {
 public:
    explicit Reverb(double rate);
    /// Adds the room's answer to `send` to both sides.
    void process(std::span<const float> send, std::span<float> left, std::span<float> right);
    void clear();

 private:
    struct Line {
        std::vector<float> memory;
        std::size_t at = 0;
        float low = 0.0F;  ///< state of the comb's damping
    };
    struct Side {
        std::array<Line, 4> combs;
        std::array<Line, 2> all_passes;
    };
    [[nodiscard]] static float step(Side& side, float in) noexcept;

    std::array<Side, 2> sides_;
};

/// A range of frames, [from, to).
struct FrameRange {
    std::int64_t from = 0;
    std::int64_t to = 0;
};

/// Plays a score: makes each sound once, places it, adds the room and limits the sum softly.
class Mixer {
 public:
    Mixer(const MusicPlan& plan, const TempoCurve& curve, const Notes& score);
    /// All of the piece, stereo, interleaved.
    [[nodiscard]] std::vector<float> render(std::span<const FrameRange> silences);

 private:
    struct SoundKey {
        Sound sound;
        int pitch;
        int length;      ///< steps of 10 ms
        int brightness;  ///< steps of 1/8
        int variant;
        friend auto operator<=>(const SoundKey&, const SoundKey&) = default;
    };
    struct Event {
        std::int64_t start;  ///< frame
        const std::vector<float>* samples;
        Sound sound;
        float gain;
    };

    const std::vector<float>& sound_for(const SoundKey& key);
    void render_stretch(std::int64_t from, std::int64_t to, std::vector<float>& out);
    void mix_events(std::int64_t from, std::size_t frames);
    void write_block(std::size_t frames, std::vector<float>& out) const;

    static constexpr std::size_t kBlock = 1024;

    MusicPlan plan_;
    std::int64_t total_frames_;
    std::map<SoundKey, std::vector<float>> sounds_;  // addresses stay
    std::vector<Event> events_;                      // ascending start
    std::size_t next_event_ = 0;
    std::vector<Event> playing_;
    Reverb reverb_;
    std::array<float, kBlock> left_{};
    std::array<float, kBlock> right_{};
    std::array<float, kBlock> send_{};
};

}  // namespace raks::audio
