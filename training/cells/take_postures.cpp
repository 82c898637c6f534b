#include "training/cells/take_postures.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>

#include "training/cells/rigid_joints.hpp"

#include <glm/geometric.hpp>

namespace raks::motion {
namespace {

// Idle, by a prototype: on takes of a dancer it marks 6 to 46 % of a take.
constexpr double kIdleSpeed = 0.25;      // metres a second, of the joints about the hips
constexpr double kIdleWindow = 1.0;      // seconds of its mean
constexpr double kShortestIdle = 2.0;    // seconds; less is a hold
constexpr double kHandWindow = 0.5;      // seconds over which a hand's speed is meant
constexpr double kSpreadWindow = 1.0;    // seconds, most of which the arms are spread
constexpr double kShortestSpread = 1.5;  // seconds
// The home pose: of the directions of upper arm and forearm, cosines against down and ahead.
constexpr double kArmHangs = 0.8;
constexpr double kForearmAhead = 0.6;
constexpr double kLeastBend = 40.0 / 180.0 * M_PI;
constexpr double kMostBend = 110.0 / 180.0 * M_PI;
constexpr double kHomeHandSpeed = 1.2;  // metres a second about the shoulder
// The T-pose: cosine against the side, the most bend of an elbow.
constexpr double kArmAside = 0.8;
constexpr double kStretched = 45.0 / 180.0 * M_PI;
constexpr double kSpreadHandSpeed = 0.6;  // metres a second about the shoulder
// A dancer's hips stay under 5 m/s, joints under 25 rad/s.
constexpr double kFastestHips = 8.0;
constexpr double kFastestJoint = 50.0;

std::size_t frames_in(double seconds, double frames_per_second) {
    return std::max<std::size_t>(
        1, static_cast<std::size_t>(std::lround(seconds * frames_per_second)));
}

// Joints of an arm in kMomentBones.
struct ArmJoints {
    std::size_t shoulder;
    std::size_t elbow;
    std::size_t hand;
    double aside;  // sign of x away from the body
};
constexpr std::array<ArmJoints, 2> kArms = {{{3, 5, 7, 1.0}, {4, 6, 8, -1.0}}};

// How one arm is held.
struct ArmPosture {
    glm::dvec3 upper{};  // unit
    glm::dvec3 fore{};   // unit
    double bend = 0.0;   // of the elbow, radians; 0: stretched
};

glm::dvec3 unit_way(const glm::dvec3& from, const glm::dvec3& to) {
    const glm::dvec3 way = to - from;
    return way / std::max(1e-9, glm::length(way));
}

ArmPosture arm_of(const TakeMoment& moment, const ArmJoints& arm) {
    ArmPosture held;
    held.upper = unit_way(moment.places[arm.shoulder], moment.places[arm.elbow]);
    held.fore = unit_way(moment.places[arm.elbow], moment.places[arm.hand]);
    held.bend = std::acos(std::clamp(glm::dot(held.upper, held.fore), -1.0, 1.0));
    return held;
}

// Speed of a hand about its shoulder by frame.
std::vector<double> hand_speeds(std::span<const TakeMoment> moments,
                                const ArmJoints& arm,
                                double frames_per_second) {
    std::vector<double> speeds;
    speeds.reserve(moments.size());
    for (const TakeMoment& moment : moments) {
        speeds.push_back(
            glm::length(moment.velocities[arm.hand] - moment.velocities[arm.shoulder]));
    }
    return moving_mean(speeds, frames_in(kHandWindow, frames_per_second));
}

bool hangs_as_a_machine(const ArmPosture& arm, double speed) {
    return -arm.upper.y > kArmHangs && arm.fore.z > kForearmAhead && arm.bend > kLeastBend &&
           arm.bend < kMostBend && speed < kHomeHandSpeed;
}

bool is_aside(const ArmPosture& arm, double side, double speed) {
    return side * arm.upper.x > kArmAside && arm.bend < kStretched && speed < kSpreadHandSpeed;
}

// Clears runs of true that are shorter than `least`, but for those at either end where these count.
void drop_short(std::vector<bool>& flags, std::size_t least, bool with_ends) {
    for (std::size_t first = 0; first < flags.size();) {
        std::size_t last = first;
        while (last < flags.size() && flags[last] == flags[first]) {
            ++last;
        }
        const bool is_end = with_ends && (first == 0 || last == flags.size());
        if (flags[first] && last - first < least && !is_end) {
            std::fill(flags.begin() + static_cast<std::ptrdiff_t>(first),
                      flags.begin() + static_cast<std::ptrdiff_t>(last),
                      false);
        }
        first = last;
    }
}

std::vector<bool> idle_frames(std::span<const TakeMoment> moments, double frames_per_second) {
    std::vector<double> speeds;
    speeds.reserve(moments.size());
    for (const TakeMoment& moment : moments) {
        speeds.push_back(moment.speed());
    }
    std::vector<bool> idle;
    for (const double mean : moving_mean(speeds, frames_in(kIdleWindow, frames_per_second))) {
        idle.push_back(mean < kIdleSpeed);
    }
    drop_short(idle, frames_in(kShortestIdle, frames_per_second), true);
    return idle;
}

// Whether motion passed over a robot's joints: these have no head and no collar bones to move.
// People's arms hang with bent elbows, too, in many a basic step.
bool is_of_robot(std::span<const Pose> poses) {
    constexpr std::array<Bone, 4> kPeoples = {
        Bone::neck, Bone::head, Bone::left_shoulder, Bone::right_shoulder};
    return !poses.empty() && std::none_of(kPeoples.begin(), kPeoples.end(), [&](Bone bone) {
        return ever_moves(poses, bone);
    });
}

void judge_arms(std::span<const TakeMoment> moments,
                bool may_be_home,
                double frames_per_second,
                TakePostures& postures) {
    std::array<std::vector<double>, 2> speeds;
    for (std::size_t side = 0; side < kArms.size(); ++side) {
        speeds[side] = hand_speeds(moments, kArms[side], frames_per_second);
    }
    std::vector<double> spread(moments.size());
    for (std::size_t frame = 0; frame < moments.size(); ++frame) {
        bool is_home = may_be_home;
        bool is_spread = true;
        for (std::size_t side = 0; side < kArms.size(); ++side) {
            const ArmPosture arm = arm_of(moments[frame], kArms[side]);
            is_home = is_home && hangs_as_a_machine(arm, speeds[side][frame]);
            is_spread = is_spread && is_aside(arm, kArms[side].aside, speeds[side][frame]);
        }
        postures.is_home.push_back(is_home);
        spread[frame] = is_spread ? 1.0 : 0.0;
    }
    for (const double share : moving_mean(spread, frames_in(kSpreadWindow, frames_per_second))) {
        postures.is_spread.push_back(share > 0.5);
    }
    drop_short(postures.is_spread, frames_in(kShortestSpread, frames_per_second), false);
}

std::vector<bool> leaps_of(std::span<const Pose> poses, double frames_per_second) {
    std::vector<bool> leaps(poses.size());
    for (std::size_t frame = 1; frame < poses.size(); ++frame) {
        const Pose& before = poses[frame - 1];
        const Pose& now = poses[frame];
        double fastest = 0.0;
        for (std::size_t bone = 0; bone < now.local_rotations.size(); ++bone) {
            const auto turn = static_cast<double>(
                std::abs(glm::dot(before.local_rotations[bone], now.local_rotations[bone])));
            fastest = std::max(fastest, 2.0 * std::acos(std::min(1.0, turn)));
        }
        const auto way = static_cast<double>(glm::length(now.hips_position - before.hips_position));
        leaps[frame] =
            way * frames_per_second > kFastestHips || fastest * frames_per_second > kFastestJoint;
    }
    return leaps;
}

}  // namespace

std::vector<double> moving_mean(std::span<const double> values, std::size_t frames) {
    std::vector<double> sums = {0.0};
    sums.reserve(values.size() + 1);
    for (const double value : values) {
        sums.push_back(sums.back() + value);
    }
    const std::size_t half = frames / 2;
    std::vector<double> means(values.size());
    for (std::size_t i = 0; i < values.size(); ++i) {
        const std::size_t first = i > half ? i - half : 0;
        const std::size_t end = std::min(i + half + 1, values.size());
        means[i] = (sums[end] - sums[first]) / static_cast<double>(end - first);
    }
    return means;
}

TakePostures postures_of(std::span<const TakeMoment> moments,
                         std::span<const Pose> poses,
                         double frames_per_second) {
    TakePostures postures;
    postures.is_idle = idle_frames(moments, frames_per_second);
    judge_arms(moments, is_of_robot(poses), frames_per_second, postures);
    postures.is_leap = leaps_of(poses, frames_per_second);
    return postures;
}

}  // namespace raks::motion
