#pragma once

#include <span>
#include <vector>

#include "motion/skeleton/pose.hpp"
#include "training/cells/take_moments.hpp"

/// What of a take is no dance, found by rule: nobody moves, the arms hang as a machine left them, a
/// body stands with its arms spread, the capture leaps.
namespace raks::motion {

/// By frame of a take. A frame may be several of these.
struct TakePostures {
    /// The mean speed of the joints over one second is under 0.25 m/s, for two seconds or at an end
    /// of the take: a shorter stillness within dancing is a hold, and stays.
    std::vector<bool> is_idle;
    /// Head and collar bones never move in the whole take, as in motion that passed over a robot's
    /// joints, and both upper arms hang, both elbows are bent by 40 to 110 degrees, both forearms
    /// point ahead and the hands hardly move about their shoulders: what such motion has wherever
    /// its maker gave the arms nothing to do.
    std::vector<bool> is_home;
    /// Both arms are stretched sideways and kept so for a second and a half: a held T-pose.
    std::vector<bool> is_spread;
    /// The body goes from one frame to the next as no body can.
    std::vector<bool> is_leap;
};

/// Judges all frames. `poses`: as captured, before any filter, as many as moments; without the
/// frames that are known to be wrong. Threads: workers. Real-time: no.
[[nodiscard]] TakePostures postures_of(std::span<const TakeMoment> moments,
                                       std::span<const Pose> poses,
                                       double frames_per_second);

/// Mean of the values within half of `frames` on either side, as far as there are such.
[[nodiscard]] std::vector<double> moving_mean(std::span<const double> values, std::size_t frames);

}  // namespace raks::motion
