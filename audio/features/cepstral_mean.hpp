#pragma once

#include <array>
#include <cstdint>

#include "audio/features/mfcc.hpp"
#include "base/realtime.hpp"

namespace raks::audio {

/// Time constant and start of a running cepstral mean.
struct CepstralMeanConfig {
    double seconds = 7.0;  ///< time constant of the running mean, 0.1 to 60
    /// How many seconds of music the start value counts for, > 0: until the mean of the music
    /// itself is known, a mean of the training music holds.
    double start_weight = 1.5;
    std::array<float, kMfccStatic> start{};  ///< mean of the statics in the training data
};

/// Streaming cepstral mean normalization: subtracts a running mean from the statics, which removes
/// what a constant gain, an equalizer, a microphone or a codec's band limit adds to the cepstrum.
/// The derivatives have no such offset and stay unchanged.
///
/// The mean of frame n includes that frame and all before it. Frames of silence do not change it.
/// Threads: one. Real-time: all but the constructor.
class CepstralMean {
 public:
    /// Starts from config.start.
    explicit CepstralMean(const CepstralMeanConfig& config = {}) noexcept;

    /// Whether a frame counts for the mean.
    enum class Frame : std::uint8_t { music, silence };
    /// Subtracts the mean from the statics of `vector` in place.
    void normalize(Frame frame, MfccVector& vector) noexcept RAKS_NONBLOCKING;
    /// Back to config.start, as after construction.
    void reset() noexcept RAKS_NONBLOCKING;

    /// The mean as it stands, one value for each static.
    [[nodiscard]] const std::array<double, kMfccStatic>& mean() const noexcept { return mean_; }

 private:
    CepstralMeanConfig config_;
    double longest_ = 0.0;  // most frames in the mean, as if it were a plain one
    double frames_ = 0.0;   // frames in the mean, the start's included
    std::array<double, kMfccStatic> mean_{};
};

}  // namespace raks::audio
