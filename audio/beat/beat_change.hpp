#pragma once

#include <array>
#include <cstddef>
#include <span>

#include "audio/features/onset.hpp"
#include "base/realtime.hpp"

namespace raks::audio {

/// How much the sound changes at a beat: the mean spectrum of the beat's time against that of the
/// beat before. Harmony and bass line change where bars begin, where a network on onsets hears 1
/// and 3 alike. (Davies, Plumbley 2006, "A spectral difference approach to downbeat extraction in
/// musical audio"; here on mel bands, compressed and each against its own level.)
///
/// Threads: one. Real-time: yes.
class BeatChange {
 public:
    BeatChange() noexcept { reset(); }

    /// The bands' magnitudes of one more hop.
    void add(std::span<const float, OnsetDetector::kMelBands> magnitudes) noexcept RAKS_NONBLOCKING;

    /// A beat comes. Gives how much the sound changed at the beat before this one, in standard
    /// deviations from the mean of the last beats, [-3, 3]; 0 while little was heard.
    float next_beat() noexcept RAKS_NONBLOCKING;

    void reset() noexcept RAKS_NONBLOCKING;

 private:
    using Bands = std::array<float, OnsetDetector::kMelBands>;

    Bands sum_{};     // of the beat that goes on
    int hops_ = 0;    // in it
    Bands level_{};   // running mean, by band
    Bands before_{};  // compressed, of the last whole beat
    int beats_ = 0;   // whole ones so far
    float mean_ = 0.0F;
    float variance_ = 0.0F;
};

}  // namespace raks::audio
