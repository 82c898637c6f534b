#include "apps/grid/take_figure.hpp"

#include <cmath>

#include "motion/figures/clip_conditioning.hpp"
#include "motion/figures/motion_features.hpp"
#include "motion/skeleton/skeleton.hpp"

#include <glm/gtc/quaternion.hpp>
#include <glm/vec3.hpp>

namespace raks::apps {
namespace {

using motion::Bone;
using motion::Pose;

// The direction in which the hips look on the whole; takes may face anything.
double heading_on_the_whole(const std::vector<Pose>& poses) {
    double sine = 0.0;
    double cosine = 0.0;
    for (const Pose& pose : poses) {
        const double heading = motion::heading_of(glm::dquat(pose.rotation(Bone::hips)));
        sine += std::sin(heading);
        cosine += std::cos(heading);
    }
    return std::atan2(sine, cosine);
}

}  // namespace

TakeFigure::TakeFigure(const motion::TrainingClip& clip)
    : poses_(clip.poses), frames_per_second_(clip.frames_per_second) {
    motion::bridge_faults(poses_, clip.faults);
    const glm::quat turn = glm::angleAxis(-static_cast<float>(heading_on_the_whole(poses_)),
                                          glm::vec3(0.0F, 1.0F, 0.0F));
    const float size = motion::mannequin_skeleton().hips_height() /
                       static_cast<float>(clip.hips_height > 0.0 ? clip.hips_height : 1.0);
    glm::vec3 middle{};
    for (Pose& pose : poses_) {
        pose.hips_position = turn * pose.hips_position * size;
        pose.rotation(Bone::hips) = turn * pose.rotation(Bone::hips);
        middle += pose.hips_position / static_cast<float>(poses_.size());
    }
    for (Pose& pose : poses_) {
        pose.hips_position.x -= middle.x;
        pose.hips_position.z -= middle.z;
    }
}

Pose TakeFigure::at(double seconds) const {
    return motion::pose_between(poses_, seconds * frames_per_second_);
}

double TakeFigure::seconds() const noexcept {
    return static_cast<double>(poses_.size() - 1) / frames_per_second_;
}

}  // namespace raks::apps
