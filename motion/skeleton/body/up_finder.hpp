// Up finder: which axis of a file points up, from how the body stands in it.
#pragma once

#include <string>
#include <string_view>

#include "base/expected.hpp"
#include "motion/skeleton/body/posed_body.hpp"

#include <glm/gtc/quaternion.hpp>
#include <glm/vec3.hpp>

namespace raks::motion {

/// What was found about a file's upright axis.
struct FoundUp {
    glm::dvec3 axis{0.0, 1.0, 0.0};             ///< of the file; unit
    glm::dquat upright = {1.0, 0.0, 0.0, 0.0};  ///< turns it to +y
    double confidence = 0.0;                    ///< 0 to 1
    std::string reason;                         ///< a few words
};

/// The axis (one of six) along which the head is over the feet in most frames. The floor has the
/// last word: where what is lowest along y stays on one plane in every frame, and what is lowest
/// along the body's axis does not, the body lies or stands on its hands in a file with y up, and is
/// not stood up. A body that is upright along no axis (it tumbles) keeps y.
[[nodiscard]] FoundUp find_up(const PosedBody& body);

/// The rotation that turns an axis to +y, as the programs do that write it: about x for z (x stays
/// where it is), about z for x; unit.
[[nodiscard]] glm::dquat turn_to_y(const glm::dvec3& axis);

/// Reads "y", "z", "-x", "+z". Errors: anything else.
[[nodiscard]] Expected<glm::dvec3> read_axis(std::string_view text);

/// "+z", or "0.10 0.99 0.00" for what is no axis.
[[nodiscard]] std::string axis_name(const glm::dvec3& axis);

}  // namespace raks::motion
