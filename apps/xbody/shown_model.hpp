// A model that is looked at: with what is drawn of it, and what moves it.
#pragma once

#include <cstddef>
#include <filesystem>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

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
    std::string motion;          ///< clip: FILE, or FILE#NAME; empty: none
    motion::JointLabels joints;  ///< which joint of the clip is which bone
};

/// A model, standing: a figure in its T-pose as a dance has it, all else as its file has it, as
/// large as a figure. Threads: one.
struct ShownModel {
    std::filesystem::path file;
    std::filesystem::path labels_file;         ///< where its labels are, or would be
    std::optional<render::BoneLabels> labels;  ///< none: no such file
    render::Model as_read;                     ///< with bones that the file itself names, alone
    engine::AvatarModel figure;                ///< standing
    std::shared_ptr<const render::Avatar> avatar;
    std::vector<std::string> notes;          ///< what was mended, guessed, left out: one line each
    std::optional<engine::AvatarClip> clip;  ///< what moves it; none: it stands

    /// Of the clip; 1: it stands.
    [[nodiscard]] std::size_t frame_count() const;
    /// Frames a second; 60 where it stands.
    [[nodiscard]] double rate() const;
};

/// Reads model, labels and motion. A model without a figure is shown, too; labels that make no
/// figure are said in a note. Errors: those of the files; a motion where there is no figure.
/// Threads: workers. Real-time: no.
[[nodiscard]] Expected<ShownModel> load_shown_model(const ShownModelPlan& plan);

/// A dancer's picture of a frame: pose and joints. What swings is at rest.
struct ShownPose {
    explicit ShownPose(const ShownModel& model);  ///< frame 0
    motion::Pose pose;
    render::RigState state;
};
/// Goes to a frame, clamped to the clip. Threads: one. Real-time: no.
void show_frame(const ShownModel& model, std::size_t frame, ShownPose& shown);

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

/// Leaves the meshes of hidden nodes (by node) out of the avatar, or takes them in again. Poses of
/// it are to be made anew. Threads: one. Real-time: no.
void hide_nodes(const std::vector<bool>& is_hidden, ShownModel& model);

/// Where a node and all below it are; -1: all nodes. Threads: any. Real-time: no.
[[nodiscard]] std::vector<glm::vec3> branch_places(const ShownModel& model,
                                                   const ShownPose& shown,
                                                   int node);

}  // namespace raks::apps
