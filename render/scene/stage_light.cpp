#include "render/scene/stage_light.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <glm/ext/matrix_clip_space.hpp>
#include <glm/ext/matrix_transform.hpp>
#include <glm/geometric.hpp>

namespace raks::render {
namespace {

using motion::Bone;

constexpr float kKeyFollowsYaw = 0.6F;

/// Turned about the world's y.
glm::vec3 turned(glm::vec3 direction, float angle) noexcept {
    const float c = std::cos(angle);
    const float s = std::sin(angle);
    return {c * direction.x + s * direction.z, direction.y, c * direction.z - s * direction.x};
}

// The blob of one joint, as it is with the joint on the floor.
struct BlobRecipe {
    Bone bone;
    float above;  // metres over the joint
    float radius;
    float strength;
};
// Tuned by eye: feet darkest, since they touch the floor.
constexpr std::array<BlobRecipe, kShadowBlobs> kBlobs = {{
    {Bone::left_foot, 0.0F, 0.12F, 0.85F},
    {Bone::right_foot, 0.0F, 0.12F, 0.85F},
    {Bone::left_lower_leg, 0.0F, 0.13F, 0.65F},
    {Bone::right_lower_leg, 0.0F, 0.13F, 0.65F},
    {Bone::hips, 0.0F, 0.20F, 0.75F},
    {Bone::upper_chest, 0.0F, 0.22F, 0.75F},
    {Bone::head, 0.1F, 0.15F, 0.65F},
    {Bone::left_lower_arm, 0.0F, 0.10F, 0.45F},
    {Bone::right_lower_arm, 0.0F, 0.10F, 0.45F},
    {Bone::left_hand, 0.0F, 0.09F, 0.35F},
    {Bone::right_hand, 0.0F, 0.09F, 0.35F},
}};
// Penumbra: with height a shadow gets wider (metres a metre) and weaker.
constexpr float kWiderPerMetre = 0.05F;
constexpr float kWeakerPerMetre = 0.25F;

}  // namespace

LightDirections light_directions(const Camera& camera) noexcept {
    // Directions for a camera in front; key from the left, fill from the right, rim from behind.
    return {turned(glm::normalize(glm::vec3(-0.55F, 0.95F, 0.70F)), kKeyFollowsYaw * camera.yaw),
            turned(glm::normalize(glm::vec3(0.85F, 0.25F, 0.45F)), camera.yaw),
            turned(glm::normalize(glm::vec3(0.45F, 0.55F, -0.75F)), camera.yaw)};
}

std::array<ShadowBlob, kShadowBlobs> shadow_blobs(const motion::WorldPose& world,
                                                  float scale,
                                                  glm::vec3 key) noexcept {
    std::array<ShadowBlob, kShadowBlobs> blobs{};
    for (std::size_t i = 0; i < kBlobs.size(); ++i) {
        const BlobRecipe& recipe = kBlobs[i];
        const glm::vec3 joint =
            world.position(recipe.bone) + glm::vec3(0.0F, scale * recipe.above, 0.0F);
        const float height = std::max(joint.y, 0.0F);
        // Where the ray from the key light through the joint meets the floor.
        blobs[i] = {.x = joint.x - key.x / key.y * height,
                    .z = joint.z - key.z / key.y * height,
                    .radius = scale * recipe.radius + kWiderPerMetre * height,
                    .strength = recipe.strength / (1.0F + kWeakerPerMetre * height)};
    }
    return blobs;
}

glm::mat4 light_clip_from_world(glm::vec3 hips, float spread, glm::vec3 key) noexcept {
    const float half_side = 1.25F + spread;
    // In front of and behind the middle: of up to three dancers, and of more.
    constexpr float kDepth = 3.0F;
    constexpr float kUsualSpread = 1.8F;
    const float depth = kDepth + std::max(spread - kUsualSpread, 0.0F);
    // A fixed height, about the middle of a standing body.
    const glm::vec3 middle{hips.x, 0.85F, hips.z};
    const glm::mat4 view = glm::lookAt(middle + depth * key, middle, glm::vec3(0.0F, 1.0F, 0.0F));
    return glm::ortho(-half_side, half_side, -half_side, half_side, 0.0F, 2.0F * depth) * view;
}

}  // namespace raks::render
