#include "apps/xbody/pose_tuning.hpp"

#include <algorithm>

#include <glm/gtc/quaternion.hpp>
#include <glm/trigonometric.hpp>

namespace raks::apps {
namespace {

void turn_bones(const PoseTuning& tuning, motion::Pose& pose) {
    for (std::size_t bone = 0; bone < tuning.turns.size(); ++bone) {
        if (tuning.turns[bone] != glm::vec3(0.0F)) {
            pose.local_rotations[bone] =
                pose.local_rotations[bone] * glm::quat(glm::radians(tuning.turns[bone]));
        }
    }
}

// As far as a face is away in a talk.
glm::vec3 gaze_target(const ShownModel& model, const glm::vec2& gaze, const ShownPose& shown) {
    constexpr float kDistance = 2.0F;  // metres
    const int head =
        model.figure.model.character.humanoid.nodes[motion::index_of(motion::Bone::head)];
    const int joint = model.avatar->rig->tree.joint_of(head);
    const glm::vec3 from =
        joint < 0 ? glm::vec3(0.0F)
                  : glm::vec3(shown.state.joints.world[static_cast<std::size_t>(joint)][3]);
    const glm::vec2 turn = glm::radians(gaze);
    const glm::vec3 ahead(
        glm::sin(turn.x) * glm::cos(turn.y), glm::sin(turn.y), glm::cos(turn.x) * glm::cos(turn.y));
    return from + kDistance * ahead;
}

}  // namespace

std::vector<std::string> expression_names(const ShownModel& model) {
    const render::ExpressionRig& rig = model.avatar->rig->expressions;
    std::vector<std::string> names;
    for (std::size_t i = 0; i < rig.size(); ++i) {
        names.push_back(rig.name(i));
    }
    return names;
}

void show_tuned_frame(const ShownModel& model,
                      std::size_t frame,
                      const PoseTuning& tuning,
                      ShownPose& shown) {
    show_frame(model, frame, shown);
    if (tuning == PoseTuning()) {
        return;
    }
    turn_bones(tuning, shown.pose);
    render::Face face = shown.face;
    if (tuning.gaze != glm::vec2(0.0F)) {
        face.gaze = 1.0F;
        face.gaze_target = gaze_target(model, tuning.gaze, shown);
    }
    const render::AvatarRig& rig = *model.avatar->rig;
    render::pose_avatar(rig, shown.pose, face, 1.0F, shown.state);
    std::vector<float>& weights = shown.state.weights;
    for (std::size_t i = 0; i < std::min(weights.size(), tuning.expressions.size()); ++i) {
        weights[i] = std::max(weights[i], tuning.expressions[i]);
    }
    rig.expressions.apply(weights, shown.state.face);
}

}  // namespace raks::apps
