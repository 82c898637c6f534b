// Pose model file: a network that finds people or their joints (scripts/convert_pose.py).
#pragma once

#include <optional>
#include <string>
#include <string_view>

#include "base/expected.hpp"

namespace raks::capture {

/// What a pose network is for.
enum class PoseNetworkKind {
    detector,  ///< finds people in a whole picture
    joints,    ///< finds the joints of a person in a square
};

/// A network that this program knows.
struct KnownPoseNetwork {
    std::string_view name;  ///< "full"
    PoseNetworkKind kind = PoseNetworkKind::joints;
    std::string_view sha256;  ///< of its file
};

/// The network whose file this is. Errors, without the file's name: not a pose network, of another
/// version, or none that is known: cut off, damaged, or of other origin. Only a known network goes
/// on to OpenCV, whose reader of models is not made for files of strangers.
[[nodiscard]] Expected<KnownPoseNetwork> known_pose_network(std::string_view file);

/// The file as ONNX: graph and weights, these as floats. The form is in docs/reference/files.md.
/// Errors, without the file's name: not a pose network, another version, cut off, more than it
/// says.
[[nodiscard]] Expected<std::string> pose_file_as_onnx(std::string_view file);

}  // namespace raks::capture
