#pragma once

#include <array>
#include <cstddef>
#include <span>
#include <vector>

#include "motion/skeleton/pose.hpp"
#include "motion/skeleton/skeleton.hpp"

/// Phrase signals: what of a phrase of motion tells its beat.
namespace raks::motion {

/// Numbers that PhraseSignals::features gives for a tempo.
inline constexpr std::size_t kPhraseFeatures = 32;

/// Motion that comes back after a while.
struct PhraseRepeat {
    double seconds = 0.0;  ///< 1.4 to 3.6; 0: nothing comes back
    /// Distance of the body about the hips from itself then, over that of random moments nearby.
    double distance = 1.0;
};

/// What of a phrase tells its beat: feet that land, hips that bounce and sway, trunk and hands that
/// stop. Threads: workers. Real-time: no.
class PhraseSignals {
 public:
    /// `poses`: of the phrase alone, on `body`; `frames_per_second` > 0. Without poses it has no
    /// seconds.
    PhraseSignals(std::span<const Pose> poses, double frames_per_second, const Skeleton& body);

    /// How long the phrase lasts: each pose for one frame.
    [[nodiscard]] double seconds() const noexcept { return seconds_; }
    /// The stretch that repeats best.
    [[nodiscard]] const PhraseRepeat& repeat() const noexcept { return repeat_; }
    /// How well the signals go with beats of a tempo: for each signal the logarithm of the share of
    /// its variance that is an oscillation of four beats, two, one, half a one; then how far the
    /// tempo is from those that people dance to, how many steps a beat has, which shares of the
    /// steps come how many beats after the one before, and how far feet and hands go in a beat.
    [[nodiscard]] std::array<double, kPhraseFeatures> features(double bpm) const;

 private:
    enum Signal : std::size_t { kFeet, kHeight, kSway, kTrunk, kHands, kSignals };
    [[nodiscard]] double share_at(std::size_t signal, double hertz) const;
    void watch_feet(std::span<const Pose> poses, double frames_per_row, const Skeleton& body);
    void watch_trunk(std::span<const Pose> poses, double frames_per_row, const Skeleton& body);
    void watch_hands(std::span<const Pose> poses, double frames_per_row, const Skeleton& body);

    double seconds_ = 0.0;
    std::vector<double> steps_;  // seconds at which feet land, rising
    double feet_speed_ = 0.0;    // m/s, mean
    double hands_speed_ = 0.0;   // likewise, from the chest
    PhraseRepeat repeat_;
    std::array<std::vector<double>, kSignals> signals_;  // mean 0, variance 1; empty: it is still
};

}  // namespace raks::motion
