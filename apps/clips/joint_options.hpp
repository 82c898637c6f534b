// Options that say which joint of a motion clip is which bone: `--joint`, `--joints`.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "base/expected.hpp"
#include "motion/skeleton/joint_labels.hpp"

#include <CLI/CLI.hpp>

namespace raks::apps {

/// What was given; the rest is found.
struct JointArguments {
    std::filesystem::path map;       ///< joint map; empty: none
    std::vector<std::string> lines;  ///< "leftUpperArm=bip_l_arm"; they win

    /// Whether anything was given.
    [[nodiscard]] bool any() const { return !map.empty() || !lines.empty(); }

    /// The same for the finder. Errors: those of motion::joint_labels.
    [[nodiscard]] Expected<motion::JointLabels> labels() const {
        return motion::joint_labels(map, lines);
    }
};

/// Adds `--joint` and `--joints` to a command. `whose`: "the clip" or "the clips"; `needed`: the
/// option without which they say nothing; null: none.
inline void add_joint_options(CLI::App& app,
                              JointArguments& arguments,
                              const std::string& whose,
                              CLI::Option* needed = nullptr) {
    auto* const line =
        app.add_option("--joint", arguments.lines, "BONE=JOINT of " + whose + "; one each time")
            ->allow_extra_args(false);
    auto* const map = app.add_option(
        "--joints", arguments.map, "X.toml: which joint of " + whose + " is which bone");
    if (needed != nullptr) {
        line->needs(needed);
        map->needs(needed);
    }
}

}  // namespace raks::apps
