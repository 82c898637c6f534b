// A model's body as it stands: in its T-pose, turned to +z, in metres.
#pragma once

#include <array>
#include <optional>
#include <vector>

#include "motion/skeleton/humanoid.hpp"
#include "render/model/model.hpp"

#include <glm/gtc/quaternion.hpp>
#include <glm/mat4x4.hpp>

namespace raks::render {

/// What a builder needs to stand a model up.
///
/// Joint matrices are as glTF has them: world x inverse bind. The pose in which all rotations of a
/// motion are the identity is `world` with `straighten` applied bone by bone.
struct StandingBody {
    /// Parent of each node (body_parents). Acyclic.
    std::vector<int> parents;
    /// World from each node, in the file's unit, turned so that the body faces +z. VRM: the
    /// nodes as stored, which is the T-pose; all others: as the skin was bound.
    std::vector<glm::mat4> world;
    /// The turn about y that `world` holds already; what is in the file's world must be turned by
    /// it, too.
    glm::quat turn{1.0F, 0.0F, 0.0F, 0.0F};
    /// For each bone the rotation, in the turned world, from `world` to the T-pose: arms along +x
    /// and -x, legs down, by what hangs on them, or as a label says; a rigid part that is a whole
    /// limb, and a forearm without a hand, by their flesh. The identity for trunk, head, shoulders,
    /// feet and toes, for bones that are not there, and for all of VRM.
    std::array<glm::quat, motion::kBoneCount> straighten;
    /// Of the mesh, else of the joints, in the file's unit; above 0.
    float height = 1.0F;
    /// Metres from the file's unit: 1 of a body 0.5 to 2.5 m high, else what makes it 1.7 m.
    float scale = 1.0F;
};

inline constexpr float kUsualHeight = 1.7F;  ///< metres
inline constexpr float kLeastHeight = 0.5F;  ///< metres, of a body that is taken as it is
inline constexpr float kMostHeight = 2.5F;   ///< metres

/// Stands up a model whose humanoid is mapped (map_humanoid, or VRM's own). `height`: metres that
/// it shall have, instead of its own. A body whose parts hang elsewhere, or that is scaled, gets
/// a warning that says so.
/// Threads: workers. Real-time: no.
[[nodiscard]] StandingBody stand_up(Model& model, std::optional<float> height = std::nullopt);

}  // namespace raks::render
