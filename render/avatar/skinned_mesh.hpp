// The whole mesh of an avatar in a pose, computed without a graphics card: for measuring it.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "motion/skeleton/humanoid.hpp"
#include "motion/skeleton/pose.hpp"
#include "render/avatar/avatar.hpp"
#include "render/avatar/avatar_rig.hpp"

#include <glm/mat4x4.hpp>
#include <glm/vec3.hpp>

namespace raks::render {

/// Vertices and triangles of an avatar, painted skin and surface alike, without its morphs.
///
///     SkinnedMesh mesh(avatar);
///     mesh.set_pose(pose, &state);       // or null: a painted skin
///     mesh.place(i)
///
/// Threads: one at a time. The avatar must outlive it.
class SkinnedMesh {
 public:
    static constexpr std::size_t kNoBone = motion::kBoneCount;

    explicit SkinnedMesh(const Avatar& avatar);

    /// Takes a pose of the avatar's own body. `state`: what pose_avatar() made of it; avatars
    /// without a rig need none. Real-time: yes.
    void set_pose(const motion::Pose& pose, const RigState* state) noexcept;

    [[nodiscard]] std::size_t size() const noexcept { return vertices_.size(); }
    /// Where vertex i is in the pose that was set last; metres.
    [[nodiscard]] glm::vec3 place(std::size_t i) const noexcept;
    /// motion::Bone that carries vertex i; kNoBone: it swings, or hangs from no bone.
    [[nodiscard]] std::size_t bone(std::size_t i) const noexcept { return vertices_[i].bone; }
    /// Vertices of each triangle, three in a row.
    [[nodiscard]] std::span<const std::uint32_t> triangles() const noexcept { return triangles_; }

 private:
    struct Vertex {
        glm::vec3 place{};
        std::array<std::uint32_t, 4> matrices{};
        std::array<float, 4> weights{};
        std::size_t bone = kNoBone;
    };
    void add_painted();
    void add_surface();

    const Avatar& avatar_;
    std::vector<Vertex> vertices_;
    std::vector<std::uint32_t> triangles_;
    std::vector<glm::mat4> matrices_;         // first the painted skin's, then by skin
    std::vector<std::size_t> first_of_skin_;  // in matrices_
};

}  // namespace raks::render
