#include "motion/skeleton/body/posed_body.hpp"

#include <algorithm>
#include <glm/geometric.hpp>

#include "base/statistics.hpp"

namespace raks::motion {

PosedBody::PosedBody(const MotionClip& clip, const HumanoidMapping& mapping)
    : clip_(&clip), mapping_(&mapping) {
    const std::size_t count = std::min(kMostFrames, clip.frame_count);
    worlds_.reserve(count);
    for (std::size_t i = 0; i < count; ++i) {
        const std::size_t frame = count == 1 ? 0 : i * (clip.frame_count - 1) / (count - 1);
        worlds_.push_back(world_pose(clip, frame));
    }
}

glm::dvec3 PosedBody::toe_tip(std::size_t i, Side side) const {
    return toe_tip_of(*clip_, *mapping_, side, worlds_[i].positions, worlds_[i].rotations);
}

glm::dvec3 PosedBody::local_vector(std::size_t from, std::size_t to) const {
    // Of one frame first: adding up only what differs from it keeps a constant vector exact.
    const auto at = [&](const ClipWorldPose& world) {
        return glm::conjugate(world.rotations[from]) *
               (world.positions[to] - world.positions[from]);
    };
    const glm::dvec3 first = at(worlds_.front());
    glm::dvec3 rest(0.0);
    for (const ClipWorldPose& world : worlds_) {
        rest += at(world) - first;
    }
    return first + rest / static_cast<double>(worlds_.size());
}

double PosedBody::distance(Bone a, Bone b) const {
    std::vector<double> distances;
    for (std::size_t i = 0; i < frames(); ++i) {
        distances.push_back(glm::distance(place(i, a), place(i, b)));
    }
    return upper_median(std::move(distances));
}

glm::dvec3 toe_tip_of(const MotionClip& clip,
                      const HumanoidMapping& mapping,
                      Side side,
                      const std::vector<glm::dvec3>& positions,
                      const std::vector<glm::dquat>& rotations) {
    for (const Bone bone : {Bone::left_toes, Bone::left_foot}) {
        if (const auto joint = mapping.joint(on_side(bone, side))) {
            const auto& end = clip.joints[*joint].end_site;
            return end ? positions[*joint] + rotations[*joint] * *end : positions[*joint];
        }
    }
    return {};
}

}  // namespace raks::motion
