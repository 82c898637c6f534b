#pragma once

#include <array>
#include <cstdint>
#include <span>

#include "audio/features/onset.hpp"
#include "audio/genre/named_rhythms.hpp"
#include "base/beat_grid.hpp"
#include "base/realtime.hpp"

namespace raks::audio {

/// Rhythm, tempo and sound of some seconds of music as one feature vector, folded over the bar that
/// the beat tracker finds: dances differ by clave, maqsum or four-on-the-floor.
///
/// Each hop's log-mel levels, above a floor that follows the music's own peak (so that gain has no
/// influence), give onset strengths in six bands. These are summed by their place in a bar of four
/// beats, in a bar of three and within the beat, and through resonators of 0.7 to 12 Hz, which need
/// no tracker. Sums are kept for segments of half a second; the features of a window come from the
/// sums of its segments, added anew each time: no rounding errors pile up, and what lies before the
/// window has no influence (but for the resonators, which remember 2.5 s more).
///
/// Where the tracker's bar is wrong, the pattern is rotated by whole beats. Most features do not
/// change by that: magnitudes of the pattern's Fourier series, the phases between bands, and the
/// profile of one beat. The pattern in the tracker's own bar is part of the vector, too, and how
/// much the onsets are like rhythms that dances are known by (NamedRhythms).
///
/// Threads: one. Real-time: yes (bounded, no allocation).
class BarPatterns {
 public:
    static constexpr int kSegmentHops = 50;                     ///< half a second
    static constexpr int kSegments = 20;                        ///< of the longest window: 10 s
    static constexpr int kMelBands = OnsetDetector::kMelBands;  ///< of the input
    static constexpr int kBands = 6;                            ///< of onsets, from low to high
    static constexpr int kGroups = 3;       ///< pairs of bands: low, middle, high
    static constexpr int kBarSlots = 16;    ///< of four beats
    static constexpr int kWaltzSlots = 12;  ///< of three beats
    static constexpr int kBeatSlots = 12;   ///< within a beat
    static constexpr int kResonators = 10;  ///< from 0.7 to 12 Hz, equally spaced in log frequency

    /// One part of a feature vector.
    struct Part {
        const char* name;  ///< for reports
        int size;          ///< number of features
    };
    /// The parts of a feature vector, in order.
    static constexpr std::array<Part, 12> kParts = {{
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
        {"rhythms", static_cast<int>(NamedRhythms::kRhythms)},  // likeness to each
    }};
    /// Length of a feature vector.
    static constexpr int kFeatures = [] {
        int sum = 0;
        for (const Part& part : kParts) {
            sum += part.size;
        }
        return sum;
    }();

    /// Ready for the first hop.
    BarPatterns();

    /// Takes a hop of music (leave silence out). `mel`: the onset detector's magnitudes, without
    /// noise. `grid`: the tracker's beats at `time`. Returns true when the hop closes a segment.
    bool add(std::span<const float, kMelBands> mel,
             const BeatGrid& grid,
             StreamTime time) noexcept RAKS_NONBLOCKING;

    /// Closed segments that features() can use, at most kSegments.
    [[nodiscard]] int segments() const noexcept {
        return segments_ < kSegments ? segments_ : kSegments;
    }
    /// Features of the newest `count` closed segments, 1 <= count <= segments().
    void features(int count, std::span<float, kFeatures> out) const noexcept RAKS_NONBLOCKING;
    /// Forgets the music.
    void reset() noexcept RAKS_NONBLOCKING;

 private:
    // Sums over the hops of one segment.
    struct Sums {
        float hops = 0.0F;
        std::array<float, kMelBands> level{};  // log-mel, above the floor
        std::array<float, kMelBands> level_squared{};
        // Onset strength by slot, as are `waltz` and `beat`.
        std::array<std::array<float, kBarSlots>, kBands> bar{};
        std::array<std::array<float, kWaltzSlots>, kGroups> waltz{};
        std::array<float, kBeatSlots> beat{};
        std::array<float, kBarSlots> bar_hops{};  // hops by slot, to take means
        std::array<float, kWaltzSlots> waltz_hops{};
        std::array<float, kBeatSlots> beat_hops{};
        // Radii of the resonators: low, middle, high, all.
        std::array<std::array<float, kResonators>, 4> pulse{};
        std::array<float, 4> pulse_power{};  // onset strength of the same groups
        std::array<float, 6> tempo{};        // see put_pulse()
        NamedRhythms rhythms;

        void add(const Sums& other) noexcept;
    };

    void take_levels(std::span<const float, kMelBands> mel) noexcept;
    void take_onsets(const BeatGrid& grid, StreamTime time) noexcept;
    void resonate(const std::array<float, 4>& onsets) noexcept;

    std::array<std::array<float, kResonators>, 2> rotation_{};  // cosine and sine a hop
    // Complex states by group.
    std::array<std::array<std::array<float, kResonators>, 2>, 4> resonance_{};
    float peak_ = 0.0F;                                       // dB: recent maximum, falls slowly
    std::array<float, kMelBands> level_{};                    // of the hop, dB above the floor
    std::array<std::array<float, kBands>, 3> band_levels_{};  // ring of hops
    std::array<float, kBands> onset_{};                       // of the hop
    std::int64_t hops_ = 0;                                   // since reset
    Sums open_;                                               // current segment
    std::array<Sums, kSegments> closed_{};                    // ring
    int segments_ = 0;                                        // closed segments, at most kSegments
    int next_ = 0;                                            // place of the next one in closed_
};

}  // namespace raks::audio
