#include "apps/raks_capture/filmed_motion.hpp"

#include <algorithm>
#include <utility>

#include "apps/clips/clip_reading.hpp"
#include "motion/skeleton/body/retarget.hpp"
#include "motion/skeleton/humanoid.hpp"
#include "motion/skeleton/skeleton.hpp"

#include <glm/geometric.hpp>

namespace raks::apps {
namespace {

// The fastest of the ends of the limbs between two frames; metres a second.
double fastest_end(const FilmedMotion& filmed, std::size_t frame) {
    using motion::Bone;
    const auto& skeleton = motion::mannequin_skeleton();
    const motion::WorldPose before = motion::world_pose(skeleton, filmed.poses[frame - 1]);
    const motion::WorldPose after = motion::world_pose(skeleton, filmed.poses[frame]);
    double farthest = 0.0;
    for (const Bone bone :
         {Bone::left_hand, Bone::right_hand, Bone::left_foot, Bone::right_foot, Bone::head}) {
        farthest = std::max(
            farthest,
            static_cast<double>(glm::distance(after.position(bone), before.position(bone))));
    }
    return farthest * filmed.frames_per_second;
}

// Many recordings begin with a T-pose that the dance leaves by a jump within a few frames, which no
// dancer makes and no camera could follow: the pose behind it is held in its place.
void hold_before_jump(FilmedMotion& filmed) {
    constexpr double kLongest = 0.5;      // seconds
    constexpr double kFastestHand = 7.0;  // metres a second
    const auto last = std::min(filmed.poses.size() - 1,
                               static_cast<std::size_t>(kLongest * filmed.frames_per_second));
    std::size_t jump = 0;
    for (std::size_t frame = 1; frame <= last; ++frame) {
        jump = fastest_end(filmed, frame) > kFastestHand ? frame : jump;
    }
    std::fill_n(filmed.poses.begin(), jump, filmed.poses[jump]);
}

}  // namespace

Expected<FilmedMotion> read_filmed_motion(const std::filesystem::path& file,
                                          const FilmedMotionOptions& options) {
    auto clip = motion::read_skeleton_motion(
        file, clip_reading(options.frames_per_second, {}, options.arm_angle));
    if (!clip) {
        return fail(std::move(clip.error()));
    }
    motion::RetargetOptions retargeting;
    retargeting.body = options.body;
    auto danced = motion::retarget(*clip, motion::mannequin_skeleton(), retargeting);
    if (!danced) {
        return fail(std::move(danced.error()).in(file.string()));
    }
    FilmedMotion filmed{std::move(danced->poses), danced->frames_per_second * options.tempo};
    hold_before_jump(filmed);
    if (options.seconds > 0.0) {
        const auto count = static_cast<std::size_t>(options.seconds * filmed.frames_per_second) + 1;
        filmed.poses.resize(std::min(filmed.poses.size(), count));
    }
    return filmed;
}

}  // namespace raks::apps
