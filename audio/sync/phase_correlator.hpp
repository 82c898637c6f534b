#pragma once

#include <cstddef>
#include <memory>
#include <optional>
#include <span>
#include <vector>

namespace raks::audio {

/// A place where a stretch of sound lies in a longer one.
struct CorrelationPeak {
    double lag = 0.0;     ///< samples from the longer one's start, between two of them (parabola)
    double height = 0.0;  ///< of the peak: 1 where the sounds are the same and equally long
    double deviations = 0.0;  ///< height over the standard deviation of what lies around
};

/// Finds a stretch of sound in a longer one by the phase of their cross-spectrum (generalized
/// cross-correlation with phase transform, GCC-PHAT: Knapp, Carter 1976): each frequency of a band
/// counts alike, so that what a room, a microphone or a filter does to the loudness of frequencies
/// does not matter. Threads: one. Real-time: no.
class PhaseCorrelator {
 public:
    /// The frequencies that count, hertz, below half the rate.
    struct Band {
        double low_hz = 0.0;
        double high_hz = 0.0;
    };
    /// `longest`: size of the longest sound that will be searched.
    PhaseCorrelator(int rate, Band band, std::size_t longest);
    /// Frees the plans.
    ~PhaseCorrelator();
    /// Neither copied nor moved.
    PhaseCorrelator(const PhaseCorrelator&) = delete;
    /// As above.
    PhaseCorrelator& operator=(const PhaseCorrelator&) = delete;

    /// Takes in the sound that is searched next, at most `longest` samples.
    void set_whole(std::span<const float> whole);
    /// Where `part`, not longer than the whole, lies within it: heights for the lags 0 ..
    /// whole - part, in samples. Valid until the next call. All 0 where one of both is silent in
    /// the band.
    std::span<const float> correlate(std::span<const float> part);

 private:
    struct Plan;
    std::unique_ptr<Plan> plan_;
};

/// The highest peaks of `heights`, highest first: at most `count`, each at least `apart` samples
/// from all higher ones, each over `least` standard deviations (by the median of all heights, so
/// that the peaks themselves do not count).
[[nodiscard]] std::vector<CorrelationPeak> highest_peaks(std::span<const float> heights,
                                                         std::size_t count,
                                                         std::size_t apart,
                                                         double least);

}  // namespace raks::audio
