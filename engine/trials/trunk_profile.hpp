// The trunk of a mesh as a row of slices: how deep a point is inside it.
#pragma once

#include <array>
#include <cstddef>
#include <span>
#include <vector>

#include "motion/skeleton/skeleton.hpp"
#include "render/avatar/skinned_mesh.hpp"

#include <glm/vec3.hpp>

namespace raks::engine {

/// How far the trunk reaches to every side, by height, from the hips to under the armpits, in the
/// T-pose. Each point of a posed body is brought back to the T-pose by the bone of its height.
/// Independent of motion::Girth, which the dance was solved with. Threads: any. Real-time: no.
class TrunkProfile {
 public:
    /// Without a trunk: nothing is inside.
    TrunkProfile() = default;
    /// `at_rest`: places of the mesh's vertices in the T-pose, whose bones are `bones`.
    TrunkProfile(const render::SkinnedMesh& mesh,
                 std::span<const glm::vec3> at_rest,
                 const motion::WorldPose& bones);

    /// How deep a place is inside, towards the trunk's middle line; 0: outside. Metres.
    [[nodiscard]] float depth(const glm::vec3& place,
                              const motion::WorldPose& bones) const noexcept;

 private:
    static constexpr std::size_t kSlices = 12;
    static constexpr std::size_t kSides = 24;

    [[nodiscard]] float depth_at_rest(const glm::vec3& place) const noexcept;

    motion::WorldPose bones_;  // of the T-pose
    float low_ = 0.0F;
    float high_ = 0.0F;
    std::array<float, kSlices> middle_{};  // z of each slice's middle
    std::array<std::array<float, kSides>, kSlices> reach_{};
};

}  // namespace raks::engine
