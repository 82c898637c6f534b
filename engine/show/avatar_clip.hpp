// What moves a figure in a dance's place: a clip of a file.
#pragma once

#include <filesystem>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "base/expected.hpp"
#include "motion/skeleton/joint_labels.hpp"
#include "motion/skeleton/pose.hpp"
#include "render/avatar/face.hpp"
#include "render/avatar/joint_tree.hpp"
#include "render/avatar/node_clip.hpp"
#include "render/import/humanoid_labels.hpp"

#include <glm/vec3.hpp>

namespace raks::engine {

/// What a person says of a clip and of whom it moves.
struct AvatarClipOptions {
    std::filesystem::path avatar;  ///< the model that it moves; empty: none
    /// By what that model was scaled, which the travel of its own clips then is, too; none: by the
    /// ratio of hips heights, as of other clips.
    std::optional<float> own_scale{};
    /// Label file of that model, which counts where the clip is that model's own; empty: none.
    std::filesystem::path labels;
    motion::JointLabels joints{};  ///< which joint of a clip that is no model is which bone
    /// Of a motion of MikuMikuDance: motion::MotionReadOptions::arm_angle.
    std::optional<double> arm_angle{};
    /// Labels of that model, in the place of its file's; none: the file's.
    std::optional<render::BoneLabels> own_labels{};
    /// Whether AvatarClip::move_others is called for each pose of a clip of that model itself.
    render::OtherNodes others = render::OtherNodes::folded;
};

/// A clip on a body: of a VRMA, of a glTF (its own), of a BVH or another format of motion, with the
/// face of a VMD, or a figure of a written dance, at its written tempo. Threads: one. Real-time:
/// no.
class AvatarClip {
 public:
    /// `argument`: "FILE", whose first clip (figure) is taken, or "FILE#NAME". `hips`: where those
    /// of the body rest; their travel is scaled by the ratio of hips heights. Errors, with the
    /// file's name: those of its reader, there is no such clip in it, no figure, joints that it has
    /// not, and joints where it is a model.
    [[nodiscard]] static Expected<AvatarClip> load(const std::string& argument,
                                                   const glm::vec3& hips,
                                                   const AvatarClipOptions& options = {});

    /// Seconds to the last pose.
    [[nodiscard]] double duration() const noexcept { return duration_; }
    /// Poses a second: the file's, or 60 where it has no rate.
    [[nodiscard]] double rate() const noexcept { return rate_; }
    /// Its tempo, where the file says it: of a written dance.
    [[nodiscard]] std::optional<double> bpm() const noexcept { return bpm_; }
    /// Whether clips of its kind are made for one song, at whose start they start.
    [[nodiscard]] bool is_of_one_song() const noexcept { return is_of_one_song_; }
    /// One line where it is the first of several clips of a file and none was named; else empty.
    [[nodiscard]] const std::string& choice() const noexcept { return choice_; }
    /// What the clip's reader left out or mended; one line each.
    [[nodiscard]] const std::vector<std::string>& warnings() const noexcept { return warnings_; }

    /// The pose at `seconds`, held before the start and after the end.
    [[nodiscard]] motion::Pose pose_at(double seconds) const { return pose_(seconds); }
    /// The face; none: the clip has none.
    [[nodiscard]] std::optional<render::Face> face_at(double seconds) const {
        return face_ ? std::optional(face_(seconds)) : std::nullopt;
    }

    /// Moves what a pose does not hold (helpers, hair, parts of a face; bones that are shifted or
    /// change their size) on the model whose own clip this is, where AvatarClipOptions::others says
    /// so; else nothing. To be called before render::pose_avatar with the pose of that time.
    /// `tree`: of the model that AvatarClipOptions names.
    void move_others(double seconds,
                     const motion::Pose& pose,
                     const render::JointTree& tree,
                     render::JointState& state) const {
        if (others_) {
            others_(seconds, pose.hips_position, tree, state);
        }
    }

    /// The file of an argument, without the clip's name.
    [[nodiscard]] static std::filesystem::path file_of(const std::string& argument);

 private:
    friend class AvatarClipReader;

    std::function<motion::Pose(double)> pose_;
    std::function<render::Face(double)> face_;
    std::function<void(
        double, const glm::vec3& hips, const render::JointTree&, render::JointState&)>
        others_;
    double duration_ = 0.0;
    double rate_ = 60.0;
    std::optional<double> bpm_;
    bool is_of_one_song_ = false;
    std::string choice_;
    std::vector<std::string> warnings_;
};

}  // namespace raks::engine
