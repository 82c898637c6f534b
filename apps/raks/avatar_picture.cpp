#include "apps/raks/avatar_picture.hpp"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <limits>
#include <span>
#include <vector>

#include "engine/show/picture.hpp"
#include "engine/show/themes.hpp"
#include "render/gl/offscreen.hpp"
#include "render/import/humanoid_map.hpp"
#include "render/model/model_survey.hpp"
#include "render/renderer.hpp"
#include "render/scene/scene.hpp"
#include "render/video/png.hpp"

#include <glm/gtc/quaternion.hpp>
#include <glm/trigonometric.hpp>

namespace raks::apps {
namespace {

using motion::Bone;

// From the front, a little from above, so that the floor is seen.
render::Camera front_camera() {
    render::Camera camera = render::find_camera("front").value_or(render::Camera{});
    camera.yaw = 0.0F;
    camera.pitch = render::Camera::kMinPitch;
    return camera;
}

// So far away that this much of the height fits.
float distance_for(const render::Camera& camera, float half_height) {
    constexpr float kMargin = 1.1F;
    return kMargin * half_height / std::tan(camera.vertical_fov / 2.0F);
}

}  // namespace

motion::Pose pose_at_ease(const render::Avatar& avatar) {
    constexpr float kArms = glm::radians(72.0F);
    constexpr double kFingers = 0.25;
    constexpr glm::vec3 kForward(0.0F, 0.0F, 1.0F);
    motion::Pose pose;
    pose.hips_position = avatar.skeleton.offsets[0];
    pose.rotation(Bone::left_upper_arm) = glm::angleAxis(-kArms, kForward);
    pose.rotation(Bone::right_upper_arm) = glm::angleAxis(kArms, kForward);
    motion::set_hand_shape(motion::Side::left, kFingers, pose);
    motion::set_hand_shape(motion::Side::right, kFingers, pose);
    return pose;
}

motion::Pose standing_on_floor(const render::Avatar& avatar, motion::Pose pose) {
    const motion::Skeleton& body = avatar.skeleton;
    const motion::WorldPose world = motion::world_pose(body, pose);
    float lowest = std::numeric_limits<float>::max();
    for (const motion::Side side : motion::kSides) {
        for (const glm::vec3& point : {body.ball, body.heel}) {
            lowest = std::min(lowest, motion::foot_point(world, side, point).y);
        }
    }
    pose.hips_position.y -= lowest;
    return pose;
}

render::Camera whole_camera(const engine::AvatarModel& shown,
                            const render::Avatar& avatar,
                            const motion::Pose& pose) {
    constexpr float kAspect = 0.75F;
    render::Camera camera = front_camera();
    const auto box = render::rest_box(shown.model);
    if (!box) {
        return camera;
    }
    // Hands over the head stay in it, and arms spread as they are in the T-pose.
    const float top = box->high.y * shown.options.scale - avatar.soles;
    const float half_width = shown.options.scale * std::max(box->high.x, -box->low.x);
    camera.target.y = 0.54F * top;
    camera.distance = distance_for(camera, std::max(0.6F * top, half_width / kAspect));
    camera.pan_to(pose.hips_position);
    return camera;
}

render::Camera portrait_camera(const engine::AvatarModel& shown, const render::Avatar& avatar) {
    render::Camera camera = front_camera();
    const auto box = render::rest_box(shown.model);
    if (!box) {
        return camera;
    }
    const float scale = shown.options.scale;
    float low = box->low.y * scale - avatar.soles;
    float high = box->high.y * scale - avatar.soles;
    float half_width = 0.0F;
    float half_depth = 0.0F;  // what is deep must not come too near
    if (shown.model.character.humanoid.nodes[motion::index_of(Bone::head)] >= 0) {
        const motion::WorldPose world = motion::world_pose(avatar.skeleton, pose_at_ease(avatar));
        // As much below the head's joint as a chest is long. Of some bodies that joint is at the
        // top of a large head, so at least down to the armpits.
        const float size = render::size_of(avatar);
        low = std::min(world.position(Bone::head).y - 0.27F * size,
                       world.position(Bone::left_upper_arm).y - 0.08F * size);
    } else {
        half_width = scale * std::max(box->high.x, -box->low.x);
        half_depth = scale * std::max(box->high.z, 0.0F);
    }
    camera.target = {0.0F, (low + high) / 2.0F, 0.0F};
    camera.distance = distance_for(camera, std::max((high - low) / 2.0F, half_width)) + half_depth;
    return camera;
}

Expected<void> write_avatar_picture(const std::filesystem::path& output,
                                    const render::Avatar& avatar,
                                    const motion::Pose& pose,
                                    const render::RigState& state,
                                    const AvatarPicture& picture) {
    const auto context = render::OffscreenContext::create();
    if (!context) {
        return fail(context.error());
    }
    auto renderer = render::Renderer::create(avatar, {.quality = render::Quality::high});
    if (!renderer) {
        return fail(renderer.error());
    }
    auto target = render::OffscreenTarget::create(
        {.width = picture.width, .height = picture.height, .samples = renderer->samples()});
    if (!target) {
        return fail(target.error());
    }
    render::Scene scene;
    scene.theme = engine::find_theme("studio_light").value_or(scene.theme);
    scene.camera = picture.camera;
    const render::Dancer dancer{.avatar = {}, .pose = pose, .state = &state};
    renderer->draw(scene, std::span(&dancer, 1), target->frame());
    std::vector<std::uint8_t> rgba(static_cast<std::size_t>(picture.width) *
                                   static_cast<std::size_t>(picture.height) * 4U);
    if (auto read = target->read_rgba(rgba); !read) {
        return read;
    }
    return render::write_png(output, picture.width, picture.height, rgba);
}

}  // namespace raks::apps
