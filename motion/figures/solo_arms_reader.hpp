// Reading of solo arms.
#pragma once

#include "base/toml_tree.hpp"
#include "motion/figures/couple_form_reader.hpp"
#include "motion/figures/solo_arms.hpp"

namespace raks::motion {

/// Reads [solo]: beats, home and [[solo.arms]] with left, right = [[beat, outward, up, ahead], ...]
/// and elbow_left, elbow_right = [outward, up, ahead]. A pattern that is none is complained of and
/// left out.
[[nodiscard]] SoloArms read_solo_arms(const toml::node& node, HoldComplaints& complaints);

}  // namespace raks::motion
