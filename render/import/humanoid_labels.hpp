// A label file: which nodes of a model are its bones, said by a person.
#pragma once

#include <cstdint>
#include <filesystem>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "base/expected.hpp"
#include "motion/skeleton/humanoid.hpp"

#include <glm/vec3.hpp>

namespace raks::render {

/// One line of a label file.
struct BoneLabel {
    motion::Bone bone = motion::Bone::hips;
    std::string node;  ///< name
    /// Where the bone points at rest, along an axis of the node; 0: found by what hangs on it.
    glm::vec3 axis{0.0F};
    friend bool operator==(const BoneLabel&, const BoneLabel&) = default;
};

/// What a label file says.
///
///     format = "raks-avatar-labels"
///     version = 1
///     [bones]
///     hips = "Pelvis"
///     leftUpperLeg = "thigh_01"
///     leftUpperArm = {node = "arm-left", axis = "-y"}
struct BoneLabels {
    std::string file;  ///< its name, for messages
    std::vector<BoneLabel> bones;
    std::vector<std::string> left_out{};  ///< what of it does not count: one line each
};

/// Reads a label file. `file`: its name, for messages. Of a bone that has several lines the first
/// counts, though TOML itself has no such files; the others are left out. Errors, in one line with
/// their place: not TOML, another format or version, a bone that VRM 1.0 does not know (with the
/// nearest), a bone that no dance moves (eyes, jaw), a value that is neither a text nor a table of
/// node and axis, an axis that is none of x, y, z, -x, -y, -z, no bones.
[[nodiscard]] Expected<BoneLabels> read_bone_labels(std::string_view text, const std::string& file);

/// The same of a file. Errors: those of the file, too. Threads: workers. Real-time: no.
[[nodiscard]] Expected<BoneLabels> load_labels(const std::filesystem::path& file);

/// The label file beside a model, me.labels.toml of me.3ds; empty: there is none. Threads: any.
[[nodiscard]] std::filesystem::path labels_beside(const std::filesystem::path& model);

/// "x", "-y"; empty: it is 0.
[[nodiscard]] std::string name_of_axis(const glm::vec3& axis);

/// The label file of these labels, whose names are UTF-8: read_bone_labels gives them back.
[[nodiscard]] std::string bone_labels_text(std::span<const BoneLabel> labels);

}  // namespace raks::render
