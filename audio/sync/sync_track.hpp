#pragma once

#include <span>
#include <string>
#include <vector>

#include "base/expected.hpp"
#include "base/time.hpp"

namespace raks::audio {

/// What one recorder heard, made ready to be aligned with others: brought once to the two rates at
/// which alignment works, so that each of several tracks is prepared once and compared often.
/// Takes 80 kB for a second of sound.
/// Threads: any number may read one.
class SyncTrack {
 public:
    static constexpr int kRate = 16'000;       ///< of fine(), hertz
    static constexpr int kCoarseRate = 4'000;  ///< of coarse(), hertz
    static constexpr double kWindow = 5.0;     ///< shortest track, and length of a window; seconds

    /// `samples`: mono, at `rate` (a supported one), of any level; what is not finite counts as 0.
    /// `name` stands in front of errors.
    /// Errors: shorter than a window; silent throughout (nothing above -80 dBFS but a constant);
    /// another rate.
    [[nodiscard]] static Expected<SyncTrack> prepare(std::span<const float> samples,
                                                     SampleRate rate,
                                                     std::string name);

    /// For messages.
    [[nodiscard]] const std::string& name() const noexcept { return name_; }
    /// At kRate; sample k belongs to k / kRate seconds after the track's first sample.
    [[nodiscard]] std::span<const float> fine() const noexcept { return fine_; }
    /// The same at kCoarseRate.
    [[nodiscard]] std::span<const float> coarse() const noexcept { return coarse_; }
    /// Length.
    [[nodiscard]] double seconds() const noexcept {
        return static_cast<double>(fine_.size()) / kRate;
    }

 private:
    std::string name_;
    std::vector<float> fine_;
    std::vector<float> coarse_;
};

}  // namespace raks::audio
