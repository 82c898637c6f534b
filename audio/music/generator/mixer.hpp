#pragma once

#include <array>
#include <cstdint>
#include <map>
#include <span>
#include <vector>

#include "audio/music/generator/form_sound.hpp"
#include "audio/music/generator/notes.hpp"
#include "audio/music/generator/tempo_curve.hpp"

namespace raks::audio {

/// A small room after Schroeder (1962): four comb filters in parallel, then two all-passes,
/// separately for each side.
class Reverb {
 public:
    /// `rate`: hertz; sets the delays.
    explicit Reverb(double rate);
    /// Adds the reverberation of `send` to both sides.
    void process(std::span<const float> send, std::span<float> left, std::span<float> right);
    /// Silence: forgets what is still sounding.
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
    std::int64_t from = 0;  ///< first frame
    std::int64_t to = 0;    ///< one past the last
};

/// Renders a score: makes each sound once, places it in time and between the sides, adds the room
/// and limits the sum softly.
class Mixer {
 public:
    /// Makes all sounds that the score needs. `curve`: times of the notes' beats. `form`: levels
    /// and filters of the sections; empty: none.
    Mixer(const MusicPlan& plan,
          const TempoCurve& curve,
          const Notes& score,
          std::span<const SectionSpan> form);
    /// The whole piece in order, stereo, interleaved, as blocks to `sink`; digital silence in
    /// `silences` (ascending, not overlapping). Ends early, with false, when `sink` returns false.
    /// To be called once.
    [[nodiscard]] bool render(std::span<const FrameRange> silences, const MusicSink& sink);

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
    [[nodiscard]] bool render_stretch(std::int64_t from, std::int64_t to, const MusicSink& sink);
    [[nodiscard]] static bool render_silence(std::int64_t frames, const MusicSink& sink);
    void mix_events(std::int64_t from, std::size_t frames);
    [[nodiscard]] std::span<float> limited(std::size_t frames) noexcept;

    static constexpr std::size_t kBlock = 1024;

    MusicPlan plan_;
    std::int64_t total_frames_;
    std::map<SoundKey, std::vector<float>> sounds_;  // a map: addresses of its elements stay valid
    std::vector<Event> events_;                      // by start
    std::size_t next_event_ = 0;
    std::vector<Event> playing_;  // events that overlap the current block
    Reverb reverb_;
    FormSound form_sound_;
    std::array<float, kBlock> left_{};
    std::array<float, kBlock> right_{};
    std::array<float, kBlock> send_{};
    std::array<float, 2 * kBlock> limited_{};
};

}  // namespace raks::audio
