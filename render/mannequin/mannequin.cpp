#include "render/mannequin/mannequin.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <memory>
#include <utility>

#include "base/assert.hpp"
#include "render/avatar/avatar.hpp"
#include "render/avatar/surface_builder.hpp"
#include "render/mannequin/bind_pose.hpp"
#include "render/mannequin/body_field.hpp"
#include "render/mannequin/colour_masks.hpp"
#include "render/mannequin/mirrored_mesh.hpp"
#include "render/mannequin/skin_weights.hpp"
#include "render/mannequin/worn_model.hpp"

#include <glm/geometric.hpp>
#include <glm/matrix.hpp>
#include <glm/trigonometric.hpp>
#include <glm/vec3.hpp>

namespace raks::render {
namespace {

constexpr float kAlongNormal = 0.55F;  // strengths of the two kinds of samples
constexpr float kAroundNormal = 0.75F;
// Never black: light that bounces off the body itself is not modelled.
constexpr float kDarkest = 0.35F;
// Fingers lie apart in the bind pose alone: what they hide of each other there says little.
constexpr float kDarkestFinger = 0.70F;

/// Share of `reach` by which the surface is nearer than that.
float blocked(const BodyField& field, glm::vec3 p, float reach) noexcept {
    return std::clamp(1.0F - field.distance(p) / reach, 0.0F, 1.0F);
}

/// Five samples along the normal, growing apart: creases.
float blocked_along(const BodyField& field, glm::vec3 p, glm::vec3 normal) noexcept {
    float sum = 0.0F;
    float weights = 0.0F;
    float weight = 1.0F;
    for (int k = 1; k <= 5; ++k) {
        const auto step = static_cast<float>(k);
        // On open, flat skin the distance at that height is the height itself: nothing is blocked.
        const float height = 0.0066F * step * step + 0.006F;
        // Far samples weigh less.
        weight *= 0.8F;
        sum += weight * blocked(field, p + normal * height, height);
        weights += weight;
    }
    return sum / weights;
}

/// Twelve samples on a cone about the normal: limbs beside one another.
float blocked_around(const BodyField& field, glm::vec3 p, glm::vec3 normal) noexcept {
    constexpr int kDirections = 6;
    constexpr std::array kHeights = {0.02F, 0.07F};
    // The cone opens 42 degrees from the normal: on flat skin a sample lies at 0.74 of its way over
    // the skin, so a reach a little below that counts no flat skin as blocked.
    constexpr float kReach = 0.72F;
    // Any direction not parallel to the normal will do for the tangents.
    const glm::vec3 other =
        std::abs(normal.y) < 0.9F ? glm::vec3{0.0F, 1.0F, 0.0F} : glm::vec3{1.0F, 0.0F, 0.0F};
    const glm::vec3 t1 = glm::normalize(glm::cross(other, normal));
    const glm::vec3 t2 = glm::cross(normal, t1);
    float sum = 0.0F;
    for (int k = 0; k < kDirections; ++k) {
        const float angle = glm::radians(60.0F * static_cast<float>(k));
        const glm::vec3 direction =
            glm::normalize(normal + 0.9F * (t1 * std::cos(angle) + t2 * std::sin(angle)));
        for (const float height : kHeights) {
            sum += blocked(field, p + direction * height, kReach * height);
        }
    }
    return sum / static_cast<float>(kDirections * kHeights.size());
}

/// How open the skin is at `p` with normal `normal`: 1 on a free ball, `kDarkest` at least. From
/// the field in the bind pose, so it costs nothing per picture. Threads: any.
float ambient_occlusion(const BodyField& field, glm::vec3 p, glm::vec3 normal) noexcept {
    const float open = 1.0F - kAlongNormal * blocked_along(field, p, normal) -
                       kAroundNormal * blocked_around(field, p, normal);
    return std::clamp(open, kDarkest, 1.0F);
}

/// -1..1 as a normalized 16-bit integer of OpenGL.
std::int16_t snorm16(float value) noexcept {
    return static_cast<std::int16_t>(std::lround(std::clamp(value, -1.0F, 1.0F) * 32767.0F));
}
/// Signed distance to a colour edge as a byte; far from the edge it saturates.
std::int8_t mask_byte(float metres) noexcept {
    return static_cast<std::int8_t>(
        std::lround(std::clamp(metres / kMaskRange, -1.0F, 1.0F) * 127.0F));
}

/// Share of a vertex that hand and fingers hold.
float hand_share(const PackedWeights& weights) noexcept {
    int sum = 0;
    for (std::size_t k = 0; k < weights.joints.size(); ++k) {
        const std::size_t joint = weights.joints[k];
        if (joint >= motion::index_of(motion::Bone::left_thumb_metacarpal) &&
            joint <= motion::index_of(motion::Bone::left_little_distal)) {
            sum += weights.weights[k];
        }
    }
    return static_cast<float>(sum) / 255.0F;
}

/// Packs a vertex of the left half with everything the shaders read of it.
AvatarVertex left_vertex(const BodyField& field,
                         const ColourMasks& masks,
                         glm::vec3 p,
                         glm::vec3 normal,
                         const PackedWeights& weights) noexcept {
    AvatarVertex vertex;
    vertex.position = {p.x, p.y, p.z};
    vertex.normal = {snorm16(normal.x), snorm16(normal.y), snorm16(normal.z), 0};
    vertex.joints = weights.joints;
    vertex.weights = weights.weights;
    const std::array<float, kMaskCount> distances = masks.at(p);
    std::transform(distances.begin(), distances.end(), vertex.masks.begin(), mask_byte);
    const float least = kDarkestFinger * hand_share(weights);
    const float open = std::max(least, ambient_occlusion(field, p, normal));
    vertex.ambient_occlusion = static_cast<std::uint8_t>(std::lround(open * 255.0F));
    return vertex;
}

/// The same vertex on the right half: masks and occlusion are symmetric, joints change sides.
AvatarVertex mirror_image(AvatarVertex vertex) noexcept {
    vertex.position[0] = -vertex.position[0];
    vertex.normal[0] = static_cast<std::int16_t>(-vertex.normal[0]);
    for (std::uint8_t& joint : vertex.joints) {
        joint = static_cast<std::uint8_t>(mirrored_joint(joint));
    }
    return vertex;
}

/// Field, surface, relaxed mesh, weights, vertices: each step needs the one before it.
void add_mesh(const BodyField& field,
              const BindFrames& frames,
              MannequinStyle style,
              Avatar& avatar) {
    MirroredMesh mesh = extract_surface(field, frames);
    const Neighbours neighbours(mesh);
    relax(field, neighbours, mesh);
    const std::vector<PackedWeights> weights = skin_weights(field, frames, mesh, neighbours);
    const ColourMasks masks(field, frames, style);

    avatar.vertices.reserve(2 * mesh.positions.size());
    for (std::size_t i = 0; i < mesh.positions.size(); ++i) {
        // Left and right alternate, as MirroredMesh numbers its vertices.
        avatar.vertices.push_back(
            left_vertex(field, masks, mesh.positions[i], mesh.normals[i], weights[i]));
        avatar.vertices.push_back(mirror_image(avatar.vertices.back()));
    }
    // Indices have 16 bits.
    RAKS_ASSERT(avatar.vertices.size() < 65'536);
    avatar.indices.reserve(3 * mesh.triangles.size());
    for (const auto& triangle : mesh.triangles) {
        for (const std::uint32_t vertex : triangle) {
            avatar.indices.push_back(static_cast<std::uint16_t>(vertex));
        }
    }
}

}  // namespace

Avatar build_mannequin(MannequinStyle style) {
    Avatar avatar;
    avatar.name = "Raks mannequin";
    avatar.licence = "CC0-1.0";
    avatar.style = style;
    avatar.skeleton = motion::mannequin_skeleton();
    avatar.bind_pose = mannequin_bind_pose();
    avatar.helpers = mannequin_helpers(avatar.skeleton);
    // The inverse of each joint's bind-pose matrix: with it the bind pose's palette is the
    // identity.
    joint_matrices(avatar, avatar.bind_pose, avatar.inverse_bind);
    for (glm::mat4& matrix : avatar.inverse_bind) {
        matrix = glm::inverse(matrix);
    }
    const BindFrames frames(avatar.skeleton, avatar.bind_pose);
    const BodyField field(frames, style);
    add_mesh(field, frames, style, avatar);
    const Model worn = worn_model(avatar.skeleton, field, style);
    auto rig = std::make_shared<AvatarRig>(build_rig(worn));
    avatar.surface = build_surface(worn, *rig, {});
    avatar.rig = std::move(rig);
    return avatar;
}

}  // namespace raks::render
