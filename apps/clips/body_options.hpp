// Options that say how the body of a motion clip lies in its file. Its header is large: for the
// tables of commands alone.
#pragma once

#include <optional>

#include "apps/clips/body_arguments.hpp"
#include "apps/terminal/option_checks.hpp"

#include <CLI/CLI.hpp>

namespace raks::apps {

/// Adds `--arm-angle` to a command; the value must outlive the parsing.
inline CLI::Option* add_arm_angle_option(CLI::App& app, std::optional<double>& arm_angle) {
    return app
        .add_option_function<double>(
            "--arm-angle",
            [&arm_angle](const double& degrees) { arm_angle = degrees; },
            "degrees that the arms of a VMD's or VPD's body hang at rest; 35 is usual")
        ->check(in_range(0.0, 90.0));
}

/// Adds `--scale`, `--up`, `--unit`, `--height` and `--arm-angle` to a command.
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
    add_arm_angle_option(app, arguments.arm_angle);
}

}  // namespace raks::apps
