#pragma once

#include <cstdint>
#include <string_view>

#include "render/scene/camera.hpp"
#include "render/scene/dancers_room.hpp"

namespace raks::render {

/// How much of the dancers a camera shows.
enum class ShotSize : std::uint8_t {
    wide,        ///< all of them, with much of the stage
    low,         ///< all of them, near and from below
    full,        ///< all of them
    knees_up,    ///< from the knees up
    upper_body,  ///< from the waist up, with the hands
    face,        ///< head and neck
    feet,        ///< up to the thighs
};

/// Its name, for people and tests: "wide", "low", "full", "knees up", "upper body", "face",
/// "feet".
[[nodiscard]] std::string_view name_of(ShotSize size) noexcept;

/// What a camera is to show, of whatever picture: from where, and which part of the room.
struct ShotView {
    StageBox box;                      ///< what it is about
    StageOutline outline{};            ///< all over it, from the box's lower to its upper side, is
                                       ///< in the picture
    float yaw = 0.0F;                  ///< as Camera::yaw, radians
    float pitch = glm::radians(5.0F);  ///< as Camera::pitch, radians
    float fov = glm::radians(26.0F);   ///< as Camera::vertical_fov, radians
    float margin = 0.06F;              ///< share of the picture left free above and below
    /// At most so much is left free at either side.
    static constexpr float kSideMargin = 0.04F;
};

/// Whose face a shot shows.
enum class FaceOf : std::uint8_t { first, second, both };

/// That of a size of shot of dancers in this room, seen from `yaw`. `whose`: of ShotSize::face.
[[nodiscard]] ShotView view_of(ShotSize size,
                               const DancersRoom& room,
                               float yaw,
                               FaceOf whose = FaceOf::first) noexcept;

/// Between two views: `share` 0 gives the first, 1 the second. Yaws the shorter way.
[[nodiscard]] ShotView between(const ShotView& from, const ShotView& to, float share) noexcept;

/// The nearest camera that shows all of the view's box in a picture of width / height = `aspect`
/// (> 0). Where width decides, more is seen below, down to the floor, then as much above and below.
/// Pure.
[[nodiscard]] Camera camera_of(const ShotView& view, float aspect) noexcept;

/// How many times as far the camera stands as the height of the box alone asks for, >= 1: by much
/// more than 1 a picture is too narrow for this view.
[[nodiscard]] float width_demand(const ShotView& view, float aspect) noexcept;

}  // namespace raks::render
