#include "motion/dance/body/relaxed_hands.hpp"

#include <array>

namespace raks::motion {
namespace {

struct Bend {
    Bone bone;  // left
    float radians;
};
// Index finger nearly straight, the others closing more: a hand held up, not a fist.
constexpr std::array<Bend, 15> kBends = {{
    {Bone::left_index_proximal, 0.16F},
    {Bone::left_index_intermediate, 0.22F},
    {Bone::left_index_distal, 0.12F},
    {Bone::left_middle_proximal, 0.26F},
    {Bone::left_middle_intermediate, 0.34F},
    {Bone::left_middle_distal, 0.2F},
    {Bone::left_ring_proximal, 0.34F},
    {Bone::left_ring_intermediate, 0.42F},
    {Bone::left_ring_distal, 0.24F},
    {Bone::left_little_proximal, 0.36F},
    {Bone::left_little_intermediate, 0.4F},
    {Bone::left_little_distal, 0.24F},
    {Bone::left_thumb_metacarpal, 0.1F},
    {Bone::left_thumb_proximal, 0.15F},
    {Bone::left_thumb_distal, 0.2F},
}};
constexpr glm::vec3 kFingerAxis{0.0F, 0.0F, -1.0F};  // of the left hand: bends toward the palm
constexpr glm::vec3 kThumbAxis{0.0F, -0.70711F, -0.70711F};

}  // namespace

void relax_hands(Pose& pose) noexcept {
    for (const Bend& bend : kBends) {
        const bool is_thumb = bend.bone == Bone::left_thumb_metacarpal ||
                              bend.bone == Bone::left_thumb_proximal ||
                              bend.bone == Bone::left_thumb_distal;
        const glm::quat q = glm::angleAxis(bend.radians, is_thumb ? kThumbAxis : kFingerAxis);
        pose.rotation(bend.bone) = q;
        pose.rotation(mirrored(bend.bone)) = glm::quat(q.w, q.x, -q.y, -q.z);
    }
}

}  // namespace raks::motion
