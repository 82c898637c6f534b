#include "render/avatar/skinned_mesh.hpp"

#include <algorithm>
#include <limits>

#include <glm/vec4.hpp>

namespace raks::render {
namespace {

using motion::Bone;

/// The bone that carries each joint; none for what swings, and for what hangs from no bone.
std::vector<std::size_t> bones_of_joints(const AvatarRig& rig) {
    std::vector<std::size_t> bones(rig.tree.joints.size(), SkinnedMesh::kNoBone);
    std::vector<bool> is_decided(bones.size(), false);
    for (std::size_t i = 0; i < rig.springs.size(); ++i) {
        is_decided[rig.springs.joint(i)] = true;
    }
    for (std::size_t b = 0; b < motion::kBoneCount; ++b) {
        if (const int joint = rig.humanoid.joint(static_cast<Bone>(b)); joint >= 0) {
            bones[static_cast<std::size_t>(joint)] = b;
            is_decided[static_cast<std::size_t>(joint)] = true;
        }
    }
    // Parents come first.
    for (std::size_t i = 0; i < bones.size(); ++i) {
        if (const int parent = rig.tree.joints[i].parent; !is_decided[i] && parent >= 0) {
            bones[i] = bones[static_cast<std::size_t>(parent)];
        }
    }
    return bones;
}

template <typename Weights>
std::size_t heaviest(const Weights& weights) noexcept {
    return static_cast<std::size_t>(std::max_element(weights.begin(), weights.end()) -
                                    weights.begin());
}

}  // namespace

SkinnedMesh::SkinnedMesh(const Avatar& avatar) : avatar_(avatar) {
    if (!avatar.vertices.empty()) {
        add_painted();
    }
    if (avatar.rig != nullptr) {
        add_surface();
    }
}

void SkinnedMesh::add_painted() {
    matrices_.resize(kPaletteSize, glm::mat4(1.0F));
    for (const AvatarVertex& from : avatar_.vertices) {
        Vertex& vertex = vertices_.emplace_back();
        vertex.place = {from.position[0], from.position[1], from.position[2]};
        for (std::size_t k = 0; k < from.joints.size(); ++k) {
            vertex.matrices[k] = from.joints[k];
            vertex.weights[k] = static_cast<float>(from.weights[k]) / 255.0F;
        }
        const std::size_t joint = from.joints[heaviest(from.weights)];
        vertex.bone = joint < motion::kBoneCount
                          ? joint
                          : index_of(avatar_.helpers[joint - motion::kBoneCount].parent);
    }
    triangles_.assign(avatar_.indices.begin(), avatar_.indices.end());
}

void SkinnedMesh::add_surface() {
    const Surface& surface = avatar_.surface;
    for (const SurfaceSkin& skin : surface.skins) {
        first_of_skin_.push_back(matrices_.size());
        matrices_.resize(matrices_.size() + skin.joints.size(), glm::mat4(1.0F));
    }
    const std::vector<std::size_t> bones = bones_of_joints(*avatar_.rig);
    constexpr std::uint32_t kUnseen = std::numeric_limits<std::uint32_t>::max();
    std::vector<std::uint32_t> own_index(surface.vertices.size(), kUnseen);
    for (const SurfacePart& part : surface.parts) {
        const auto number = static_cast<std::size_t>(part.skin);
        const SurfaceSkin& skin = surface.skins[number];
        for (std::uint32_t i = 0; i < part.index_count; ++i) {
            const std::uint32_t index = surface.indices[part.first_index + i];
            if (own_index[index] == kUnseen) {
                own_index[index] = static_cast<std::uint32_t>(vertices_.size());
                const SurfaceVertex& from = surface.vertices[index];
                Vertex& vertex = vertices_.emplace_back();
                vertex.place = {from.position[0], from.position[1], from.position[2]};
                for (std::size_t k = 0; k < from.joints.size(); ++k) {
                    vertex.matrices[k] =
                        static_cast<std::uint32_t>(first_of_skin_[number] + from.joints[k]);
                    vertex.weights[k] = static_cast<float>(from.weights[k]) / 65'535.0F;
                }
                const std::size_t joint = from.joints[heaviest(from.weights)];
                vertex.bone = bones[static_cast<std::size_t>(skin.joints[joint])];
            }
            triangles_.push_back(own_index[index]);
        }
    }
}

void SkinnedMesh::set_pose(const motion::Pose& pose, const RigState* state) noexcept {
    if (!avatar_.vertices.empty()) {
        skinning_palette(avatar_, pose, std::span(matrices_).first<kPaletteSize>());
    }
    for (std::size_t number = 0; state != nullptr && number < first_of_skin_.size(); ++number) {
        const SurfaceSkin& skin = avatar_.surface.skins[number];
        for (std::size_t k = 0; k < skin.joints.size(); ++k) {
            matrices_[first_of_skin_[number] + k] =
                state->joints.world[static_cast<std::size_t>(skin.joints[k])] *
                skin.inverse_bind[k];
        }
    }
}

glm::vec3 SkinnedMesh::place(std::size_t i) const noexcept {
    const Vertex& vertex = vertices_[i];
    const glm::vec4 at(vertex.place, 1.0F);
    glm::vec4 sum(0.0F);
    for (std::size_t k = 0; k < vertex.weights.size(); ++k) {
        if (vertex.weights[k] > 0.0F) {
            sum += vertex.weights[k] * (matrices_[vertex.matrices[k]] * at);
        }
    }
    return glm::vec3(sum);
}

}  // namespace raks::render
