// Keypoint jumps: where a network takes something else for a joint, or somebody else for the
// dancer, found by views and time.
#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <vector>

#include "motion/capture/camera/rig.hpp"
#include "motion/capture/markerless/keypoint_take.hpp"
#include "motion/capture/markers/tracks.hpp"

namespace raks::capture {

/// A stretch in which a camera's network was elsewhere.
struct KeypointJump {
    std::optional<std::size_t> camera{};  ///< none: one of them, nobody knows which
    std::optional<BodyPoint> point{};     ///< none: the whole body, which is another person
    std::size_t first = 0;                ///< frame of the take
    std::size_t last = 0;                 ///< likewise, included

    friend bool operator==(const KeypointJump&, const KeypointJump&) = default;
};

/// Other people, by each camera alone: its trunk is where the dancer's cannot have got to since the
/// frame before, and until it is back, or for 3 s, when it is believed. `errors`: by camera,
/// usual_error(). Result: by camera, then first frame.
[[nodiscard]] std::vector<KeypointJump> find_other_people(const std::vector<double>& errors,
                                                          const KeypointTake& take);

/// Joints that jump. By time: out by more than six usual errors within 1/30 s and back within
/// 0.2 s, which nobody can. By views, for 0.1 s or longer: the views contradict one another, and
/// one of them alone is far from where the joint was and will be. Where half of a camera's joints
/// do, it is another person. Result: other people first, then joints by camera, point and first
/// frame. Cost: a triangulation for each joint of each frame.
[[nodiscard]] std::vector<KeypointJump> find_jumps(const Rig& rig,
                                                   const std::vector<double>& errors,
                                                   const KeypointTake& take);

/// Takes these sights out of the take: visibility 0.
void hide_jumps(const std::vector<KeypointJump>& jumps, KeypointTake& take);

/// Flags them: a joint as jumped, another person as person at the nose, both with their camera.
/// `names`: of the cameras; `tracks`: of the same take.
void add_flags(const std::vector<KeypointJump>& jumps,
               const std::vector<std::string>& names,
               Tracks& tracks);

/// What jumped, a line a camera.
[[nodiscard]] std::vector<std::string> words_of(const std::vector<KeypointJump>& jumps,
                                                const std::vector<std::string>& names,
                                                const Tracks& tracks);

}  // namespace raks::capture
