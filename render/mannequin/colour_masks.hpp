#pragma once

#include <array>

#include "render/avatar/avatar.hpp"
#include "render/mannequin/bind_pose.hpp"
#include "render/mannequin/body_field.hpp"

#include <glm/gtc/quaternion.hpp>
#include <glm/vec3.hpp>

namespace raks::render {

/// The colour areas as functions of a point of the left half of the skin, in the bind pose. Every
/// function is a signed distance, about metres, positive inside, and continuous: where a rule does
/// not hold any more a growing penalty ends the area, never an `if`, which would fray its edge.
class ColourMasks {
 public:
    ColourMasks(const BodyField& field, const BindFrames& frames, MannequinStyle style) noexcept;

    /// By AvatarMask.
    [[nodiscard]] std::array<float, kMaskCount> at(glm::vec3 p) const noexcept;

 private:
    [[nodiscard]] float suit(glm::vec3 p) const noexcept;
    [[nodiscard]] float unitard(glm::vec3 p) const noexcept;
    [[nodiscard]] float sleeved(glm::vec3 p) const noexcept;
    [[nodiscard]] float two_pieces(glm::vec3 p) const noexcept;
    [[nodiscard]] static float neckline(glm::vec3 p) noexcept;
    [[nodiscard]] static float collar(glm::vec3 p) noexcept;
    [[nodiscard]] float cap_sleeve(glm::vec3 p, float length) const noexcept;
    [[nodiscard]] float armhole(glm::vec3 p) const noexcept;
    [[nodiscard]] float long_sleeve(glm::vec3 p, float along_forearm) const noexcept;
    [[nodiscard]] float off_arm(glm::vec3 p) const noexcept;
    [[nodiscard]] float beside_arm(glm::vec3 p) const noexcept;
    [[nodiscard]] float leg_end(glm::vec3 p) const noexcept;
    [[nodiscard]] glm::vec3 from_leg_line(glm::vec3 p) const noexcept;
    [[nodiscard]] float second_cloth(glm::vec3 p) const noexcept;
    [[nodiscard]] static float hair(glm::vec3 p) noexcept;
    [[nodiscard]] static float shoe(glm::vec3 foot) noexcept;
    [[nodiscard]] float bands(glm::vec3 p) const noexcept;

    const BodyField& field_;
    MannequinStyle style_;
    float below_knee_;  // metres
    glm::vec3 shoulder_;
    glm::vec3 elbow_;
    glm::vec3 wrist_;
    glm::vec3 hip_;
    glm::vec3 knee_;
    glm::vec3 ankle_;
    glm::vec3 along_upper_arm_;
    glm::vec3 along_forearm_;
    glm::vec3 along_thigh_;
    glm::vec3 along_shank_;
    glm::vec3 along_hand_;
    glm::quat foot_from_world_;
};

}  // namespace raks::render
