// Size finder: how large a file's unit is, from the size of the body in it.
#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "base/expected.hpp"
#include "motion/skeleton/body/posed_body.hpp"

#include <glm/vec3.hpp>

namespace raks::motion {

/// What is known beforehand of a file's unit.
struct SizeOptions {
    std::optional<double> metres_per_unit;  ///< > 0
    std::optional<double> height;           ///< of the body, metres; used where no unit is given
};

/// What was found about it.
struct FoundSize {
    double metres_per_unit = 1.0;
    double height = 0.0;             ///< of the standing body, metres; of a model that of its mesh
    double confidence = 0.0;         ///< 0 to 1
    std::string reason;              ///< a few words
    std::vector<std::string> notes;  ///< one line each
};

/// The unit among metre, decimetre, centimetre, millimetre, inch and foot that makes the body
/// nearest to 1.68 m tall: they differ by factors of 2.5 and more, people by less. The height is
/// that of the legs and the trunk up to the head, as the posed frames have them, in proportion to
/// the mannequin's. Where no unit makes a person (1.1 to 2.3 m), that of CMU's skeletons may
/// (0.0254 / 0.45 m), and jumps tell: a body off the floor falls with 9.81 m/s2; without any of
/// these, the body is taken to be 1.70 m tall. `up`: unit, of the file.
[[nodiscard]] FoundSize find_size(const PosedBody& body,
                                  const glm::dvec3& up,
                                  const SizeOptions& options);

/// Standing height of the body in file units, from lengths of legs and trunk.
[[nodiscard]] double body_height(const PosedBody& body);

/// Acceleration of free fall over the clip's jumps, file units a second squared; none: no jumps.
/// A jump: both feet off the floor for 0.15 s or more, the body's middle on a parabola.
[[nodiscard]] std::optional<double> free_fall(const MotionClip& clip,
                                              const HumanoidMapping& mapping,
                                              const glm::dvec3& up,
                                              double height);

/// Reads "m", "dm", "cm", "mm", "in", "ft" as metres. Errors: anything else.
[[nodiscard]] Expected<double> read_unit(std::string_view text);

/// "cm", or "0.0564 m" for what is none of them.
[[nodiscard]] std::string unit_name(double metres);

}  // namespace raks::motion
