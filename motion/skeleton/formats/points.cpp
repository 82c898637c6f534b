#include "motion/skeleton/formats/points.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <string>
#include <utility>

#include "motion/skeleton/formats/motion_limits.hpp"
#include "motion/skeleton/text_lines.hpp"

namespace raks::motion {

std::optional<double> metres_of_unit(std::string_view name) {
    constexpr std::array<std::pair<std::string_view, double>, 12> kUnits = {{
        {"m", 1.0},
        {"meter", 1.0},
        {"meters", 1.0},
        {"metre", 1.0},
        {"metres", 1.0},
        {"dm", 0.1},
        {"cm", 0.01},
        {"mm", 0.001},
        {"in", 0.0254},
        {"inch", 0.0254},
        {"inches", 0.0254},
        {"ft", 0.3048},
    }};
    const std::string plain = lower(trimmed(name));
    const auto* const found = std::find_if(
        kUnits.begin(), kUnits.end(), [&](const auto& unit) { return unit.first == plain; });
    return found == kUnits.end() ? std::nullopt : std::optional(found->second);
}

Expected<void> check_points(PointClip& clip) {
    if (clip.names.empty()) {
        return fail("holds no points");
    }
    if (clip.names.size() > kMostJoints) {
        return fail(fmt::format("holds {} points; at most {}", clip.names.size(), kMostJoints));
    }
    if (clip.frame_count == 0) {
        return fail("has no frames");
    }
    if (!(clip.frames_per_second >= kLeastRate && clip.frames_per_second <= kLargestRate)) {
        return fail(fmt::format("its frame rate is {}, which is impossible; give it with --fps",
                                clip.frames_per_second));
    }
    bool is_seen = false;
    for (std::size_t i = 0; i < clip.positions.size(); ++i) {
        glm::dvec3& place = clip.positions[i];
        if (std::isnan(place.x) || std::isnan(place.y) || std::isnan(place.z)) {
            place = glm::dvec3(std::numeric_limits<double>::quiet_NaN());
            continue;
        }
        is_seen = true;
        const double largest = std::max({std::abs(place.x), std::abs(place.y), std::abs(place.z)});
        if (!(largest <= kLargestMotionNumber)) {
            return fail(fmt::format("frame {} has a point {} from the origin, which is impossible",
                                    i / clip.names.size(),
                                    largest));
        }
    }
    if (!is_seen) {
        return fail("none of its points was ever seen");
    }
    return {};
}

}  // namespace raks::motion
