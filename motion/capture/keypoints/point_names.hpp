// Point names: how others call the joints that they find in pictures.
#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "base/expected.hpp"
#include "motion/capture/keypoints/keypoints.hpp"

namespace raks::capture {

/// What a person says of single names: theirs, and the joint.
using PointNameMap = std::vector<std::pair<std::string, BodyPoint>>;

/// Reads such a map: a row each, their name, a tab, the joint's name ("LWri<tab>left_wrist"); lines
/// that begin with # are passed over. Errors, one line with its number: another number of cells, a
/// joint that there is none of (with the nearest), a name twice.
[[nodiscard]] Expected<PointNameMap> read_point_names(std::string_view text,
                                                      const std::string& file);

/// The joint that a name means: by the map, else by its words, however they are written and in
/// whatever order: "left_wrist", "LWrist", "l-wrist", "WristLeft", "LBigToe". Nothing: none of
/// ours.
[[nodiscard]] std::optional<BodyPoint> body_point_meant(std::string_view name,
                                                        const PointNameMap& map);

}  // namespace raks::capture
