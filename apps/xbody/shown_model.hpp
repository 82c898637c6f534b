// A model that is looked at: with what is drawn of it, and what moves it.
#pragma once

#include <cstddef>
#include <filesystem>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "apps/xbody/model_look.hpp"
#include "base/expected.hpp"
#include "engine/show/avatar_clip.hpp"
#include "engine/show/avatar_model.hpp"
#include "render/avatar/avatar.hpp"
#include "render/avatar/avatar_rig.hpp"
#include "render/import/humanoid_labels.hpp"
#include "render/model/model.hpp"
#include "render/scene/camera.hpp"

namespace raks::apps {

/// What is asked to be shown.
struct ShownModelPlan {
    std::filesystem::path file;
    engine::AvatarOptions options;
    std::string motion;                              ///< clip: FILE, or FILE#NAME; empty: none
    motion::JointLabels joints;                      ///< which joint of the clip is which bone
    std::optional<double> arm_angle = std::nullopt;  ///< engine::AvatarClipOptions::arm_angle
};

/// A model, standing: a figure in its T-pose as a dance has it, all else as its file has it, as
/// large as a figure. Threads: one.
struct ShownModel {
    ShownModelPlan plan;
    std::filesystem::path labels_file;         ///< where its labels are, or would be
    std::optional<render::BoneLabels> labels;  ///< it stands by; none: no such file
    render::Model as_read;                     ///< with bones that the file itself names, alone
    engine::AvatarModel figure;                ///< standing
    std::shared_ptr<const render::Avatar> avatar;
    render::SurfaceImages::Images images;    ///< of the avatar; kept: each look uploads it anew
    std::vector<std::string> notes;          ///< what was mended, guessed, left out: one line each
    std::optional<engine::AvatarClip> clip;  ///< what moves it; none: it stands

    [[nodiscard]] const std::filesystem::path& file() const { return plan.file; }
    /// Of the clip; 1: it stands.
    [[nodiscard]] std::size_t frame_count() const;
    /// Frames a second; 60 where it stands.
    [[nodiscard]] double rate() const;
};

/// Reads model, labels and motion. A model without a body is shown, too; labels that give no
/// body are said in a note. Errors: those of the files; a motion where the model has no body.
/// Threads: workers. Real-time: no.
[[nodiscard]] Expected<ShownModel> load_shown_model(const ShownModelPlan& plan);

/// Lets the model stand, and move, by other labels than before; all its nodes are drawn. A motion
/// that it cannot have (no longer or not yet a figure) is left out, with a note; it comes back with
/// the bones. Poses are to be made anew. Threads: workers. Real-time: no.
void stand_by_labels(std::vector<render::BoneLabel> labels, ShownModel& model);

/// What a motion must know of whom it moves: a motion can be read while the model is shown.
struct MotionWearer {
    ShownModelPlan plan;
    std::optional<render::BoneLabels> labels;  ///< it stands by
    std::string missing;                       ///< bones that it lacks; empty: it can move
    glm::vec3 hips{0.0F};                      ///< where those of its body rest
    float scale = 1.0F;                        ///< of its body, from the file
};
/// As the model stands now.
[[nodiscard]] MotionWearer wearer_of(const ShownModel& model);

/// Reads a motion (FILE, or FILE#NAME). Errors: as load_shown_model. Threads: workers. Real-time:
/// no.
[[nodiscard]] Expected<engine::AvatarClip> load_motion(const std::string& motion,
                                                       const MotionWearer& wearer);

/// Lets a motion move the model, instead of what moved it; it was read for the model as it stands.
void wear(std::string motion, engine::AvatarClip clip, ShownModel& model);

/// A dancer's picture of a frame: pose and joints. What swings is at rest.
struct ShownPose {
    explicit ShownPose(const ShownModel& model);  ///< frame 0
    motion::Pose pose;
    render::Face face;
    render::RigState state;
};
/// Goes to a frame, clamped to the clip. Threads: one. Real-time: no.
void show_frame(const ShownModel& model, std::size_t frame, ShownPose& shown);

/// Where the model is: its joints, and the corners of its box at rest, carried with its hips.
[[nodiscard]] std::vector<glm::vec3> reached_places(const ShownModel& model,
                                                    const ShownPose& shown);

/// A camera turned as of "front", "side", "back" or "top" (others: front).
[[nodiscard]] render::Camera camera_of_view(std::string_view view);

/// A camera that has all of the model in a picture of this `aspect` (width / height): "front",
/// "side", "back" or "top" (others: front). Threads: any. Real-time: no.
[[nodiscard]] render::Camera camera_before(const ShownModel& model,
                                           const ShownPose& shown,
                                           std::string_view view,
                                           float aspect);

/// The camera turned as it is, but looking at `points` (not empty), which then fill the picture.
[[nodiscard]] render::Camera camera_before(render::Camera camera,
                                           const std::vector<glm::vec3>& points,
                                           float aspect);

/// Makes the avatar look so. Poses of it are to be made anew. Threads: one. Real-time: no.
void set_look(const ModelLook& look, ShownModel& model);

/// Where a node and all below it are; -1: all nodes. Threads: any. Real-time: no.
[[nodiscard]] std::vector<glm::vec3> branch_places(const ShownModel& model,
                                                   const ShownPose& shown,
                                                   int node);

}  // namespace raks::apps
