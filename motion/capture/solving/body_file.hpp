// Body file: which joints of a body turn, and how far, as a person writes it down.
#pragma once

#include <string>
#include <string_view>

#include "base/expected.hpp"
#include "motion/capture/solving/body_model.hpp"

namespace raks::capture {

/// Reads a body (TOML). Angles are in degrees, from the T-pose; axes are those of the world in
/// which the T-pose faces +z:
///
///     format = "raks-joints"
///     version = 1
///     [[joint]]                       # the root: it turns as it likes
///     name = "hips"
///     bones = ["hips"]                # by VRM 1.0's names; several share the turn
///     [[joint]]
///     name = "leftElbow"
///     parent = "leftShoulder"
///     bones = ["leftLowerArm"]
///     axis = [0, -1, 0]               # of a hinge; left out: it turns about all axes
///     limits = [0, 150]               # of a hinge; of others `limit = 60`: the whole turn
///     usual = 50                      # where nothing is measured; of others [x, y, z]
///     deviation = 80                  # from the usual turn, likewise
///     acceleration = 80               # radians / s^2
///
/// Errors, one line with its number: not TOML, another format or version, unknown keys and bones
/// (with the nearest), two joints of one name, a parent that there is not, joints that hang on each
/// other in a loop, no root or several, a root that is not the hips, a joint whose bones do not
/// hang on its parent's, two joints that share bones without being hinges, limits the wrong way
/// round, an axis of no length, more joints or variables than a model may have.
[[nodiscard]] Expected<BodyModel> read_body_model(std::string_view text, const std::string& file);

/// A model as such a file. Reads back to the same joints.
[[nodiscard]] std::string body_model_text(const BodyModel& model);

}  // namespace raks::capture
