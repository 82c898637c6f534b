// What options say of how the body of a motion clip lies in its file: `--up`, `--unit`, `--height`,
// `--arm-angle`.
#pragma once

#include <optional>
#include <string>

#include "motion/skeleton/body/body_finder.hpp"

namespace raks::apps {

/// What was given; the rest is found.
struct BodyArguments {
    double scale = 0.0;   ///< metres per unit; 0: found
    std::string up;       ///< "z"; empty: found
    std::string unit;     ///< "cm"; empty: found
    double height = 0.0;  ///< of the body, metres; 0: found
    /// That the arms of a VMD's body hang below the horizon, degrees; none: the usual one.
    std::optional<double> arm_angle{};

    /// Whether the unit was given, in one of the three ways.
    [[nodiscard]] bool has_unit() const { return scale > 0.0 || height > 0.0 || !unit.empty(); }

    /// The same for the finder. The words were checked when the options were read.
    [[nodiscard]] motion::BodyOptions options() const {
        motion::BodyOptions options;
        if (const auto axis = motion::read_axis(up)) {
            options.up = *axis;
        }
        if (const auto metres = motion::read_unit(unit)) {
            options.metres_per_unit = *metres;
        }
        if (scale > 0.0) {
            options.metres_per_unit = scale;
        }
        if (height > 0.0) {
            options.height = height;
        }
        return options;
    }
};

}  // namespace raks::apps
