#pragma once

#include <array>
#include <cstddef>
#include <span>

#include "audio/features/onset.hpp"
#include "base/realtime.hpp"

namespace raks::audio {

/// How much the sound changes at a beat: the mean spectrum of the beat's time against that of the
/// beat before. Harmony and bass line change where bars begin; a network on onsets often gives
/// beats 1 and 3 the same evidence. (Davies, Plumbley 2006, "A spectral difference approach to
/// downbeat extraction in musical audio"; here on mel bands, compressed, each relative to its own
/// level.)
///
/// Threads: one. Real-time: yes.
class BeatChange {
 public:
    /// Starts without any beat.
    BeatChange() noexcept { reset(); }

    /// Adds a hop's mel magnitudes to the current beat.
    void add(std::span<const float, OnsetDetector::kMelBands> magnitudes) noexcept RAKS_NONBLOCKING;

    /// Ends the current beat and starts the next. Returns how much the sound changed at the start
    /// of the ended beat, in standard deviations from the mean over the last beats, [-3, 3]; 0 in
    /// the first beats.
    float next_beat() noexcept RAKS_NONBLOCKING;

    /// Forgets all beats.
    void reset() noexcept RAKS_NONBLOCKING;

 private:
    using Bands = std::array<float, OnsetDetector::kMelBands>;

    Bands sum_{};            // magnitudes of the current beat
    int hops_ = 0;           // hops of the current beat
    Bands level_{};          // running mean of the beats, by band
    Bands before_{};         // compressed magnitudes of the last whole beat
    int beats_ = 0;          // whole beats so far
    float mean_ = 0.0F;      // of the change
    float variance_ = 0.0F;  // of the change
};

}  // namespace raks::audio
