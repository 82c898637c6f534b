#pragma once

#include <array>
#include <cstdint>

#include "audio/features/mfcc.hpp"
#include "base/realtime.hpp"

namespace raks::audio {

/// What a running cepstral mean starts from and how fast it follows.
struct CepstralMeanConfig {
    double seconds = 7.0;  ///< time constant of the running mean, 0.1 to 60
    /// How long the start counts as if it had been heard: a mean of the training music holds until
    /// the music itself is known. Seconds, > 0.
    double start_weight = 1.5;
    std::array<float, kMfccStatic> start{};  ///< mean of the statics where the model was learnt
};

/// Cepstral mean normalization while streaming: takes a running mean of the music off the statics,
/// so that neither gain nor equalizer, microphone or codec's band limit stay in them. The
/// derivatives know no mean and are left alone.
///
/// The mean of frame n counts that frame and all before it. Silence does not move it.
/// Threads: one. Real-time: all but the constructor.
class CepstralMean {
 public:
    explicit CepstralMean(const CepstralMeanConfig& config = {}) noexcept;

    enum class Frame : std::uint8_t { music, silence };
    /// Changes the statics of `vector` in place.
    void normalize(Frame frame, MfccVector& vector) noexcept RAKS_NONBLOCKING;
    void reset() noexcept RAKS_NONBLOCKING;

    [[nodiscard]] const std::array<double, kMfccStatic>& mean() const noexcept { return mean_; }

 private:
    CepstralMeanConfig config_;
    double longest_ = 0.0;  // frames that the mean remembers
    double frames_ = 0.0;   // frames that it knows, the start's among them
    std::array<double, kMfccStatic> mean_{};
};

}  // namespace raks::audio
