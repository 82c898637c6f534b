// What options say of which joint of a motion clip is which bone: `--joint`, `--joints`.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "base/expected.hpp"
#include "motion/skeleton/joint_labels.hpp"

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

}  // namespace raks::apps
