// Body links: a body as the chain of its turning bones, and where its markers sit on them.
#pragma once

#include <cstddef>
#include <vector>

#include "motion/capture/solving/body_model.hpp"

#include <glm/vec3.hpp>

namespace raks::capture {

/// A bone that turns. Bones that do not turn are part of the one that carries them.
struct BodyLink {
    std::size_t parent = 0;  ///< its link; the first has itself
    std::size_t joint = 0;   ///< of the model
    glm::dvec3 offset{};     ///< of its joint, in the frame of the parent; metres
    double share = 1.0;      ///< of the joint's turn
};

/// A point fixed to a link.
struct LinkedPoint {
    std::size_t link = 0;
    glm::dvec3 place{};  ///< in its frame; metres
};

/// The links of a body, parents before their children, as many and in the order of the model's
/// parts' bones.
struct BodyLinks {
    std::vector<BodyLink> links;
    std::vector<LinkedPoint> markers;  ///< by marker of the shape

    /// Whether a joint's turn moves a marker.
    [[nodiscard]] bool moves(std::size_t joint, std::size_t marker) const noexcept;
};

/// The links of a body. `marker_bones`: by marker of the shape.
[[nodiscard]] BodyLinks links_of(const BodyModel& model,
                                 const BodyShape& shape,
                                 const std::vector<motion::Bone>& marker_bones);

/// Some joints of a body that are sought together, and what tells of them.
struct JointGroup {
    std::vector<std::size_t> joints;     ///< that are sought, of the model
    std::vector<std::size_t> variables;  ///< of these joints, and of the hips' place
    std::vector<std::size_t> links;      ///< to be placed for its markers, in order
    std::vector<std::size_t> markers;    ///< that tell of them
};

/// How a body is divided: its trunk with the head, then each limb, and all of it. Markers of the
/// trunk's bones and the head tell of the trunk, also where a limb's joint moves them, as a
/// collarbone does; each limb has those that it moves.
struct BodyDivision {
    JointGroup trunk;
    std::vector<JointGroup> limbs;  ///< left arm, right arm, left leg, right leg
    JointGroup whole;
};

/// Divides a body.
[[nodiscard]] BodyDivision divide(const BodyModel& model,
                                  const BodyLinks& links,
                                  const std::vector<motion::Bone>& marker_bones);

}  // namespace raks::capture
