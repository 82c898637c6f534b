#pragma once

#include <filesystem>

#include "base/expected.hpp"
#include "engine/show/avatar_model.hpp"
#include "motion/skeleton/pose.hpp"
#include "render/avatar/avatar.hpp"
#include "render/scene/camera.hpp"

namespace raks::apps {

/// A body at ease: arms beside it, fingers a little curled, hips where they rest.
[[nodiscard]] motion::Pose pose_at_ease(const render::Avatar& avatar);

/// The pose lifted or lowered until its lower foot stands on the floor.
[[nodiscard]] motion::Pose standing_on_floor(const render::Avatar& avatar, motion::Pose pose);

/// A camera before the whole of `shown`, for a picture of 3:4.
[[nodiscard]] render::Camera whole_camera(const engine::AvatarModel& shown,
                                          const render::Avatar& avatar,
                                          const motion::Pose& pose);

/// A camera before head and shoulders of `shown`; where it has no bones of a body, before all of
/// it.
[[nodiscard]] render::Camera portrait_camera(const engine::AvatarModel& shown,
                                             const render::Avatar& avatar);

/// A picture of an avatar to write.
struct AvatarPicture {
    int width = 600;   ///< pixels
    int height = 800;  ///< pixels
    render::Camera camera;
};
/// Draws the avatar off-screen, as its drivers made `state` of `pose`, and writes it as PNG.
/// Errors: no OpenGL, or the driver refuses; those of the file. Threads: main.
[[nodiscard]] Expected<void> write_avatar_picture(const std::filesystem::path& output,
                                                  const render::Avatar& avatar,
                                                  const motion::Pose& pose,
                                                  const render::RigState& state,
                                                  const AvatarPicture& picture);

}  // namespace raks::apps
