// Solo arms: what the arms do of one who dances a couples' dance alone.
#pragma once

#include <array>
#include <vector>

#include <glm/vec3.hpp>

namespace raks::motion {

/// Where the elbow of a bent arm points: outward, up and ahead.
inline constexpr glm::vec3 kUsualElbow{0.6F, -0.5F, -1.0F};

/// Where both hands go in a few beats. At each key a hand arrives and stays until it must leave for
/// the next one, so that arms have accents.
struct ArmPattern {
    /// Where a hand is at a beat.
    struct Key {
        double beat = 0.0;  ///< of the pattern
        /// Wrist, from its shoulder: outward, up and ahead in the frame of the chest, in lengths of
        /// the arm
        glm::vec3 wrist{};
    };
    std::array<std::vector<Key>, 2> keys;  ///< by Side; rising beats, at least one
    /// By Side: where the elbow points, outward, up and ahead; from a beat after the pattern begins
    /// to a beat before it ends, at its ends as by default
    std::array<glm::vec3, 2> elbow{kUsualElbow, kUsualElbow};
};

/// The arms of one who dances alone, instead of those of figures that were learnt from couples.
struct SoloArms {
    double beats = 8.0;                 ///< length of each pattern
    glm::vec3 home{0.1F, -0.5F, 0.5F};  ///< where both hands are as a pattern begins and ends
    std::vector<ArmPattern> patterns;   ///< none: the figures' own arms
};

}  // namespace raks::motion
