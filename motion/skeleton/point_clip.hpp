// Point clip: recorded places of markers or joints, which no bones join.
#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <vector>

#include <glm/vec3.hpp>

namespace raks::motion {

/// Places over time as a file has them: markers of a capture, or joints without turns. They can be
/// looked at; a body must be solved from them before anything can dance them. For tools: double
/// precision, may allocate.
struct PointClip {
    std::vector<std::string> names;     ///< one a point, as written; may be empty or used twice
    double frames_per_second = 0.0;     ///< > 0 once read
    std::size_t frame_count = 0;        ///< at least 1 once read
    std::vector<glm::dvec3> positions;  ///< file units; frames x points, row-major; NaN: not seen
    std::optional<double> metres_per_unit;  ///< where the format or the file says it; > 0
    std::optional<glm::dvec3> up;           ///< where the format or the file says it; unit length
    std::vector<std::string> warnings;      ///< one line each, without the file's name

    /// Place of a point at a frame; all three NaN where it was not seen.
    [[nodiscard]] const glm::dvec3& position(std::size_t frame, std::size_t point) const noexcept {
        return positions[frame * names.size() + point];
    }
};

}  // namespace raks::motion
