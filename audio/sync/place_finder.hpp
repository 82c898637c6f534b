#pragma once

#include <cstddef>
#include <optional>
#include <span>
#include <vector>

#include "audio/sync/phase_correlator.hpp"

namespace raks::audio {

/// Where in a recording that is at hand the sound is that is heard now, found by the phase of their
/// cross-spectrum (PhaseCorrelator). A loudspeaker, a room or an equalizer in between does not
/// matter; another tempo or pitch does: then nothing is found.
///
///     PlaceFinder finder(samples_of_file);
///     if (const auto place = finder.find(last_second)) ... // it began at *place seconds of the
///     file
///
/// Threads: one. Real-time: no.
class PlaceFinder {
 public:
    static constexpr int kRate = 4'000;        ///< of all sound here, hertz
    static constexpr double kShortest = 0.6;   ///< of what is heard, seconds; less is not found
    static constexpr double kLongest = 8.0;    ///< likewise; more does not help
    static constexpr double kHintReach = 2.0;  ///< seconds around a hint

    /// `song`: the whole recording, mono, at kRate.
    explicit PlaceFinder(std::vector<float> song);

    /// Seconds from the song's first sample to the first of `heard`, to about a millisecond. None
    /// where `heard` is not in the song, is silent, or lies as well in several places of it: music
    /// that repeats itself to the sample; then more of it may be found, or the one place that is
    /// near `hint`.
    [[nodiscard]] std::optional<double> find(std::span<const float> heard,
                                             std::optional<double> hint = std::nullopt);
    /// The same within `reach` seconds of `place`, for a fraction of the work.
    [[nodiscard]] std::optional<double> find_near(std::span<const float> heard,
                                                  double place,
                                                  double reach) const;

    /// Length of the song.
    [[nodiscard]] double seconds() const noexcept {
        return static_cast<double>(song_.size()) / kRate - kLongest;
    }

 private:
    std::vector<float> song_;  // and silence behind it
    PhaseCorrelator whole_;
};

}  // namespace raks::audio
