// Model motion: a clip of a glTF, GLB, VRM or VRMA as recorded motion of its skeleton.
#pragma once

#include <cstddef>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "base/expected.hpp"
#include "motion/skeleton/motion_clip.hpp"
#include "render/model/model.hpp"

namespace raks::render {

/// The animation of a name in a model, or its first. Errors, without the file's name: there is none
/// of that name, or none at all.
[[nodiscard]] Expected<std::size_t> find_animation(const Model& model, const std::string& name);

/// One line for people where `clip` names none of several clips, so that the first is taken; else
/// empty.
[[nodiscard]] std::string first_of_several(const Model& model, const std::string& clip);

/// A clip of a model as motion of its joints, in metres and y up, as glTF has it: the humanoid's
/// bones where the file names them (VRM, VRMA; they then have VRM's names), else the joints of its
/// skins, else the nodes that the clip moves; and the bones of a humanoid that was found in it
/// (map_humanoid), which then is MotionClip::known, with the height and the facing of the model at
/// rest, and hangs together as a body does (body_parents). Other nodes are not joints, but what
/// they turn, move and scale is in the joints' places. Rest is the T-pose of VRM, the pose in which
/// the skins were bound, or else that of the nodes as stored; there joints have the world's axes.
///
/// Sampled from the clip's first key to its last at `frames_per_second`, or where none is given at
/// the rate of its keys if they are even, else at 60. Errors, without the file's name: no joints or
/// more than 1,000, a clip of hours, places that are no body's. Threads: workers. Real-time: no.
[[nodiscard]] Expected<motion::MotionClip> model_motion(const Model& model,
                                                        std::size_t animation,
                                                        std::optional<double> frames_per_second);

/// The clip with the node of each of its joints.
struct ModelClip {
    motion::MotionClip clip;
    std::vector<std::size_t> nodes;  ///< by joint
};

/// The same as model_motion.
[[nodiscard]] Expected<ModelClip> model_clip(const Model& model,
                                             std::size_t animation,
                                             std::optional<double> frames_per_second);

/// The same from a file, whose figure is looked for before (map_humanoid, with the label file
/// beside it, if there is one). `clip` is the animation's name, or empty for the first. What was
/// repaired in the file is among the warnings, and so are the other clips in it. Errors: also those
/// of load_model, with the file's name.
[[nodiscard]] Expected<motion::MotionClip> read_model_motion(
    const std::filesystem::path& file,
    const std::string& clip,
    std::optional<double> frames_per_second);

}  // namespace raks::render
