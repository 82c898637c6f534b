// Pose tuning: a figure turned by hand, over what moves it.
#pragma once

#include <array>
#include <cstddef>
#include <string>
#include <vector>

#include "apps/xbody/shown_model.hpp"
#include "motion/skeleton/humanoid.hpp"

#include <glm/vec2.hpp>
#include <glm/vec3.hpp>

namespace raks::apps {

/// What sliders say. At rest: nothing is changed.
struct PoseTuning {
    static constexpr float kMostTurn = 180.0F;  ///< degrees
    static constexpr float kMostGaze = 60.0F;   ///< degrees

    std::array<glm::vec3, motion::kBoneCount>
        turns{};                     ///< by bone, about x, then y, then z; degrees
    std::vector<float> expressions;  ///< weights by expression of the avatar; missing ones are 0
    glm::vec2 gaze{0.0F};            ///< to its left, up; degrees
    friend bool operator==(const PoseTuning&, const PoseTuning&) = default;
};

/// Names of the expressions of a model, in the order of the tuning.
[[nodiscard]] std::vector<std::string> expression_names(const ShownModel& model);

/// show_frame, then the tuning: bones are turned further, about their own axes (the T-pose has the
/// world's);
/// expressions are at least as strong; a gaze that is not 0 is in the place of the clip's.
/// Threads: one. Real-time: no.
void show_tuned_frame(const ShownModel& model,
                      std::size_t frame,
                      const PoseTuning& tuning,
                      ShownPose& shown);

}  // namespace raks::apps
