#include "training/cells/prepared_take.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <utility>

#include "motion/evaluate/body_track.hpp"
#include "motion/evaluate/dance_metrics.hpp"
#include "motion/figures/clip_conditioning.hpp"
#include "motion/figures/foot_events.hpp"
#include "motion/skeleton/skeleton.hpp"
#include "training/cells/rigid_joints.hpp"

namespace raks::motion {
namespace {

constexpr double kFewestFramesASecond = 14.0;
constexpr double kMostFramesASecond = 1000.0;
constexpr double kShortestTake = 1.0;     // seconds
constexpr double kJerkFrames = 60.0;      // a second: jerk depends on it
constexpr double kSlowestForJerk = 50.0;  // frames a second; interpolation is no motion

// The poses as a body of the built-in one's height has them.
std::vector<Pose> of_common_height(std::vector<Pose> poses, double hips_height) {
    const auto scale =
        static_cast<float>(static_cast<double>(mannequin_skeleton().hips_height()) / hips_height);
    for (Pose& pose : poses) {
        pose.hips_position *= scale;
    }
    return poses;
}

}  // namespace

Expected<PreparedTake> prepare_take(TrainingClip clip) {
    const double rate = clip.frames_per_second;
    if (!(rate >= kFewestFramesASecond && rate <= kMostFramesASecond)) {
        return fail(fmt::format("{}: has {:g} frames a second, must be {:g} to {:g}",
                                clip.name,
                                rate,
                                kFewestFramesASecond,
                                kMostFramesASecond));
    }
    if (static_cast<double>(clip.poses.size()) < kShortestTake * rate) {
        return fail(fmt::format("{}: lasts {:.2f} s, must be {:g} s at least",
                                clip.name,
                                static_cast<double>(clip.poses.size()) / rate,
                                kShortestTake));
    }
    PreparedTake take;
    take.clip = std::move(clip);
    bridge_faults(take.clip.poses, take.clip.faults);
    bridge_faults(take.clip.feet, take.clip.faults);
    take.clip.faults.clear();
    const std::vector<Pose> captured = of_common_height(take.clip.poses, take.clip.hips_height);
    spread_trunk(take.clip.poses);
    roll_heels(mannequin_skeleton(), take.clip.feet, take.clip.poses);
    for (const Side side : kSides) {
        take.landings[static_cast<std::size_t>(side)] = landings(take.clip.feet, side, rate);
    }
    measure_moments(take);
    take.postures = postures_of(take.moments, captured, rate);
    return take;
}

void measure_moments(PreparedTake& take) {
    const double rate = take.clip.frames_per_second;
    const std::vector<Pose> smooth =
        filtered(of_common_height(take.clip.poses, take.clip.hips_height),
                 low_pass_taps(kTakeLowPassHz, rate));
    std::array<std::vector<bool>, 2> planted;
    for (const Side side : kSides) {
        planted[static_cast<std::size_t>(side)] = toe_contacts(take.clip.feet, side, rate);
    }
    take.moments = moments_of(smooth, rate, mannequin_skeleton(), planted);
}

Expected<PreparedTake> prepare_take(const std::filesystem::path& path,
                                    const ClipUnits& units,
                                    std::vector<std::string>& warnings) {
    auto clip = load_clip(path, units, warnings);
    return clip ? prepare_take(std::move(*clip)) : fail(std::move(clip.error()));
}

std::vector<double> jerk_samples(const PreparedTake& take, const std::vector<bool>& counted) {
    const double rate = take.clip.frames_per_second;
    if (rate < kSlowestForJerk) {
        return {};
    }
    std::vector<Pose> poses = of_common_height(take.clip.poses, take.clip.hips_height);
    MetricFrames frames;
    frames.counted = counted;
    if (std::abs(rate - kJerkFrames) > 0.01) {
        poses = resampled(poses, rate, kJerkFrames);
        frames.counted.clear();
        for (std::size_t i = 0; i < poses.size(); ++i) {
            const double frame = std::round(static_cast<double>(i) * rate / kJerkFrames);
            frames.counted.push_back(
                counted[std::min(static_cast<std::size_t>(frame), counted.size() - 1)]);
        }
    }
    return jerk_of(body_track(mannequin_skeleton(), poses, kJerkFrames), frames).samples;
}

}  // namespace raks::motion
