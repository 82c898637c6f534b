#pragma once

#include <array>
#include <cstdint>
#include <span>

#include "audio/features/onset.hpp"
#include "base/beat_grid.hpp"
#include "base/realtime.hpp"

namespace raks::audio {

/// What the rhythm, the tempo and the sound of some seconds of music are like, folded over the bar
/// that the beat tracker finds: dances are told apart by clave, maqsum or four-on-the-floor.
///
/// Each hop's log-mel levels, above a floor that follows the music's own peak (so that gain drops
/// out), give onsets in six bands. They are summed by their place in a bar of four beats, in a bar
/// of three and within the beat, and through resonators of 0.7 to 12 Hz that need no tracker. Sums
/// are kept for segments of half a second; a window's features come from the sums of its segments,
/// added anew each time: nothing drifts, and what is left behind is left behind exactly (but for
/// the resonators, which remember 2.5 s more).
///
/// Where the tracker's bar is wrong, the pattern is turned by whole beats. So most features do not
/// change by that: magnitudes of the pattern's Fourier series, the phases between bands, and the
/// profile of one beat. The pattern as the tracker has it comes beside them.
///
/// Threads: one. Real-time: yes (bounded, no allocation).
class BarPatterns {
 public:
    static constexpr int kSegmentHops = 50;
    static constexpr int kSegments = 20;  ///< of the longest window: 10 s
    static constexpr int kMelBands = OnsetDetector::kMelBands;
    static constexpr int kBands = 6;
    static constexpr int kGroups = 3;       ///< pairs of bands: low, middle, high
    static constexpr int kBarSlots = 16;    ///< of four beats
    static constexpr int kWaltzSlots = 12;  ///< of three beats
    static constexpr int kBeatSlots = 12;
    static constexpr int kResonators = 10;

    /// Names and sizes of the parts of a feature vector, in order.
    struct Part {
        const char* name;
        int size;
    };
    static constexpr std::array<Part, 11> kParts = {{
        {"shape", 9},            // cosine series of the mean log spectrum, without its level
        {"spread", 6},           // the same of its deviation
        {"onsets", 7},           // share of each band, and all
        {"beat", 4 * kBands},    // profile of one beat
        {"series", 8 * kBands},  // magnitudes over the bar
        {"bar", kBarSlots* kGroups},
        {"phases", 24},          // of two groups against each other
        {"three", 2 * kGroups},  // magnitudes over three beats
        {"swing", kBeatSlots},
        {"pulse", 4 * kResonators},
        {"tempo", 6},
    }};
    static constexpr int kFeatures = [] {
        int sum = 0;
        for (const Part& part : kParts) {
            sum += part.size;
        }
        return sum;
    }();

    BarPatterns();

    /// Takes a hop of music (leave silence out). `mel`: the magnitudes of the onset detector.
    /// Returns true when a segment was closed with it.
    bool add(std::span<const float, kMelBands> mel,
             const BeatGrid& grid,
             StreamTime time) noexcept RAKS_NONBLOCKING;

    /// Segments that features() can look back to.
    [[nodiscard]] int segments() const noexcept {
        return segments_ < kSegments ? segments_ : kSegments;
    }
    /// Features of the newest `count` closed segments, 1 <= count <= segments().
    void features(int count, std::span<float, kFeatures> out) const noexcept RAKS_NONBLOCKING;
    void reset() noexcept RAKS_NONBLOCKING;

 private:
    struct Sums {
        float hops = 0.0F;
        std::array<float, kMelBands> level{};
        std::array<float, kMelBands> level_squared{};
        std::array<std::array<float, kBarSlots>, kBands> bar{};
        std::array<std::array<float, kWaltzSlots>, kGroups> waltz{};
        std::array<float, kBeatSlots> beat{};
        std::array<float, kBarSlots> bar_hops{};
        std::array<float, kWaltzSlots> waltz_hops{};
        std::array<float, kBeatSlots> beat_hops{};
        std::array<std::array<float, kResonators>, 4> pulse{};
        std::array<float, 4> pulse_power{};
        std::array<float, 6> tempo{};

        void add(const Sums& other) noexcept;
    };

    void take_levels(std::span<const float, kMelBands> mel) noexcept;
    void take_onsets(const BeatGrid& grid, StreamTime time) noexcept;
    void resonate(const std::array<float, 4>& onsets) noexcept;

    std::array<std::array<float, kResonators>, 2> rotation_{};  // cosine and sine a hop
    std::array<std::array<std::array<float, kResonators>, 2>, 4> resonance_{};
    float peak_ = 0.0F;  // dB, slowly falling
    std::array<float, kMelBands> level_{};
    std::array<std::array<float, kBands>, 3> band_levels_{};  // ring of hops
    std::array<float, kBands> onset_{};
    std::int64_t hops_ = 0;  // since reset
    Sums open_;
    std::array<Sums, kSegments> closed_{};  // ring
    int segments_ = 0;
    int next_ = 0;
};

}  // namespace raks::audio
