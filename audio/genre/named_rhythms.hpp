#pragma once

#include <array>
#include <cstddef>
#include <span>

#include "base/realtime.hpp"

/// How much a pattern of onsets is like rhythms that dances are known by.
namespace raks::audio {

/// Sums of onsets over cycles of some beats, as the tracker hears them, of which the likeness to
/// each rhythm is told: maqsum, saidi, malfuf, karsilama, the clave of son, tumbao,
/// four-on-the-floor, boom-bap, backbeat and oom-pah-pah.
///
/// A rhythm is looked for as written and at half the speed, for trackers double the tempo, and
/// begun at each beat, for they miss the first of a bar. Its likeness is the highest correlation
/// found. Onsets count at the nearest quarter of a beat.
///
/// Threads: one. Real-time: yes (bounded, no allocation).
class NamedRhythms {
 public:
    static constexpr std::size_t kRhythms = 10;
    static constexpr std::size_t kGroups = 3;  ///< of onsets: low, middle, high
    /// Names of the rhythms, in the order of likeness().
    static constexpr std::array<const char*, kRhythms> kNames = {"maqsum",
                                                                 "saidi",
                                                                 "malfuf",
                                                                 "karsilama",
                                                                 "clave",
                                                                 "tumbao",
                                                                 "four-on-the-floor",
                                                                 "boom-bap",
                                                                 "backbeat",
                                                                 "oom-pah-pah"};

    /// Counts a hop's onset strengths. `beats`: position of the hop, from any beat.
    void add(std::span<const float, kGroups> onsets, double beats) noexcept RAKS_NONBLOCKING;
    /// Adds what another has counted.
    void add(const NamedRhythms& other) noexcept RAKS_NONBLOCKING;
    /// Correlation with each rhythm, -1 to 1; 0 where nothing was counted.
    [[nodiscard]] std::array<float, kRhythms> likeness() const noexcept RAKS_NONBLOCKING;

 private:
    // Onsets by quarter of a beat in a cycle that repeats.
    template <std::size_t Beats>
    struct Cycle {
        static constexpr std::size_t kSlots = 4 * Beats;
        std::array<std::array<float, kSlots>, kGroups> onsets{};
        std::array<float, kSlots> hops{};
    };
    // Two bars of four, two of three, and one or two of nine eighths.
    Cycle<8> fours_;
    Cycle<6> threes_;
    Cycle<9> nines_;
};

}  // namespace raks::audio
