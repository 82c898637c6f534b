// Options that say which joint of a motion clip is which bone. Its header is large: for the tables
// of commands alone.
#pragma once

#include <string>

#include "apps/clips/joint_arguments.hpp"

#include <CLI/CLI.hpp>

namespace raks::apps {

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
