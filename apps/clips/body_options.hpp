// Options that say how the body of a motion clip lies in its file: `--up`, `--unit`, `--height`.
#pragma once

#include <string>

#include "apps/terminal/option_checks.hpp"
#include "motion/skeleton/body/body_finder.hpp"

#include <CLI/CLI.hpp>

namespace raks::apps {

/// What was given; the rest is found.
struct BodyArguments {
    double scale = 0.0;   ///< metres per unit; 0: found
    std::string up;       ///< "z"; empty: found
    std::string unit;     ///< "cm"; empty: found
    double height = 0.0;  ///< of the body, metres; 0: found

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

/// Adds `--scale`, `--up`, `--unit` and `--height` to a command.
inline void add_body_options(CLI::App& app, BodyArguments& arguments) {
    // From a tenth of a millimetre to 10 m: the units of motion files differ that much.
    auto* scale = app.add_option("--scale", arguments.scale, "metres per unit of the file")
                      ->check(in_range(1e-4, 10.0));
    app.add_option("--up", arguments.up, "axis of the file that points up")
        ->check(one_of({"x", "y", "z", "-x", "-y", "-z"}));
    auto* unit = app.add_option("--unit", arguments.unit, "unit of the file")
                     ->check(one_of({"m", "dm", "cm", "mm", "in", "ft"}))
                     ->excludes(scale);
    app.add_option("--height", arguments.height, "metres of the body, which gives the unit")
        ->check(in_range(0.3, 3.0))
        ->excludes(scale)
        ->excludes(unit);
}

}  // namespace raks::apps
