#include "render/import/standing_body.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <string>
#include <utility>

#include "render/import/bind_places.hpp"
#include "render/import/body_parents.hpp"
#include "render/import/humanoid_map.hpp"
#include "render/import/humanoid_shape.hpp"
#include "render/import/model_warnings.hpp"
#include "render/import/node_tree.hpp"
#include "render/model/model_survey.hpp"

#include <glm/geometric.hpp>

namespace raks::render {
namespace {

using motion::Bone;
using motion::Side;

constexpr float kNoTurn = 0.09F;  // radians, 5 degrees: a body that faces +z already

/// The shortest rotation from one direction to another, both of length 1.
glm::quat shortest_rotation(const glm::vec3& from, const glm::vec3& to) {
    const float cosine = glm::dot(from, to);
    if (cosine < -0.9999F) {  // the other way round: about any axis across
        const glm::vec3 other =
            std::abs(from.x) < 0.9F ? glm::vec3(1.0F, 0.0F, 0.0F) : glm::vec3(0.0F, 1.0F, 0.0F);
        const glm::vec3 axis = glm::normalize(glm::cross(from, other));
        return {0.0F, axis.x, axis.y, axis.z};
    }
    const glm::vec3 axis = glm::cross(from, to);
    return glm::normalize(glm::quat(1.0F + cosine, axis.x, axis.y, axis.z));
}

int node_of_bone(const HumanoidMap& humanoid, Bone bone) {
    return humanoid.nodes[motion::index_of(bone)];
}

glm::quat turn_to_front(const Model& model, std::span<const glm::vec3> places) {
    const Character& character = model.character;
    if (character.vrm != VrmVersion::none) {
        constexpr glm::quat kHalfTurn{0.0F, 0.0F, 1.0F, 0.0F};
        return character.faces_minus_z ? kHalfTurn : glm::quat(1.0F, 0.0F, 0.0F, 0.0F);
    }
    const glm::vec3 facing = facing_of(character.humanoid, places);
    const float yaw = std::atan2(facing.x, facing.z);
    return std::abs(yaw) < kNoTurn ? glm::quat(1.0F, 0.0F, 0.0F, 0.0F)
                                   : glm::angleAxis(-yaw, glm::vec3(0.0F, 1.0F, 0.0F));
}

/// Straightens the limbs of a body that faces +z.
class Straightener {
 public:
    Straightener(const Model& model, std::span<const glm::mat4> world)
        : humanoid_(model.character.humanoid), world_(world), places_(places_of(world)) {
        rotations_.fill(glm::quat(1.0F, 0.0F, 0.0F, 0.0F));
        const bool lacks_hand = node_of_bone(humanoid_, Bone::left_hand) < 0 ||
                                node_of_bone(humanoid_, Bone::right_hand) < 0;
        if (humanoid_.is_of_parts || lacks_hand) {
            flesh_ = flesh_directions(model, world);
        }
    }

    std::array<glm::quat, motion::kBoneCount> straighten() {
        for (const Side side : motion::kSides) {
            const glm::vec3 out(side == Side::left ? 1.0F : -1.0F, 0.0F, 0.0F);
            const glm::vec3 down(0.0F, -1.0F, 0.0F);
            const Bone upper_arm = on_side(Bone::left_upper_arm, side);
            const Bone lower_arm = on_side(Bone::left_lower_arm, side);
            const Bone hand = on_side(Bone::left_hand, side);
            align(upper_arm, lower_arm, upper_arm, out);
            align(lower_arm, hand, upper_arm, out);
            align(hand, on_side(Bone::left_middle_proximal, side), lower_arm, out);
            for (std::size_t finger = 0; finger < 15; ++finger) {
                const Bone first = on_side(Bone::left_thumb_metacarpal, side);
                rotation(static_cast<Bone>(motion::index_of(first) + finger)) = rotation(hand);
            }
            const Bone upper_leg = on_side(Bone::left_upper_leg, side);
            const Bone lower_leg = on_side(Bone::left_lower_leg, side);
            align(upper_leg, lower_leg, upper_leg, down);
            align(lower_leg, on_side(Bone::left_foot, side), upper_leg, down);
        }
        return rotations_;
    }

 private:
    glm::quat& rotation(Bone bone) { return rotations_[motion::index_of(bone)]; }

    /// Where a bone points, of any length; 0: nothing tells. A label does, then what hangs on it,
    /// then where a part that is a whole limb has its flesh, unless that is about right: flesh is
    /// not even about a bone.
    glm::vec3 pointing(Bone bone, Bone child, const glm::vec3& direction) const {
        const int node = node_of_bone(humanoid_, bone);
        const int next = node_of_bone(humanoid_, child);
        const glm::vec3& axis = humanoid_.axes[motion::index_of(bone)];
        if (node < 0 || axis != glm::vec3(0.0F)) {
            return node < 0 ? glm::vec3(0.0F)
                            : glm::mat3(world_[static_cast<std::size_t>(node)]) * axis;
        }
        if (next >= 0) {
            return places_[static_cast<std::size_t>(next)] -
                   places_[static_cast<std::size_t>(node)];
        }
        const bool is_hand = bone == Bone::left_hand || bone == Bone::right_hand;
        if (flesh_.empty() || is_hand) {
            return glm::vec3(0.0F);
        }
        constexpr float kAboutRight = 0.9F;  // cosine of 26 degrees
        const glm::vec3& flesh = flesh_[static_cast<std::size_t>(node)];
        return glm::dot(flesh, direction) < kAboutRight * glm::length(flesh) ? flesh
                                                                             : glm::vec3(0.0F);
    }

    /// Turns `bone` as `before` is turned, and then by the shortest way so that it points in
    /// `direction`. Where nothing tells where it points it goes along with `before`.
    void align(Bone bone, Bone child, Bone before, const glm::vec3& direction) {
        const glm::quat so_far = rotation(before);
        rotation(bone) = so_far;
        const glm::vec3 along = pointing(bone, child, glm::inverse(so_far) * direction);
        if (glm::length(along) > 1.0e-5F) {
            rotation(bone) = glm::normalize(
                shortest_rotation(so_far * glm::normalize(along), direction) * so_far);
        }
    }

    const HumanoidMap& humanoid_;
    std::span<const glm::mat4> world_;
    std::vector<glm::vec3> places_;
    std::vector<glm::vec3> flesh_;  // of parts, and for want of a hand (flesh_directions)
    std::array<glm::quat, motion::kBoneCount> rotations_{};
};

float height_of(const Model& model,
                std::span<const glm::mat4> world,
                std::span<const glm::vec3> places) {
    const MeshBox box = mesh_box(model, world);
    float height = box.highest.y - box.lowest.y;
    if (!(height > 0.0F)) {
        // What else there is, controls say, may be anywhere.
        float low = std::numeric_limits<float>::max();
        float high = std::numeric_limits<float>::lowest();
        for (const int node : model.character.humanoid.nodes) {
            if (node >= 0) {
                low = std::min(low, places[static_cast<std::size_t>(node)].y);
                high = std::max(high, places[static_cast<std::size_t>(node)].y);
            }
        }
        height = high - low;
    }
    return height > 0.0F && std::isfinite(height) ? height : 1.0F;
}

}  // namespace

StandingBody stand_up(Model& model, std::optional<float> height) {
    StandingBody body;
    const bool is_vrm = model.character.vrm != VrmVersion::none;
    BodyParents hung = body_parents(model);
    body.parents = std::move(hung.parents);
    for (const std::string& note : hung.notes) {
        warn(model, note);
    }
    body.world = is_vrm ? rest_world(model) : bind_world(model);
    body.turn = turn_to_front(model, places_of(body.world));
    const glm::mat4 turn = glm::mat4_cast(body.turn);
    for (glm::mat4& world : body.world) {
        world = turn * world;
    }
    const std::vector<glm::vec3> places = places_of(body.world);
    body.straighten.fill(glm::quat(1.0F, 0.0F, 0.0F, 0.0F));
    if (!is_vrm) {
        body.straighten = Straightener(model, body.world).straighten();
    }
    body.height = height_of(model, body.world, places);
    const bool is_usual = body.height >= kLeastHeight && body.height <= kMostHeight;
    body.scale = (height ? *height : (is_usual ? body.height : kUsualHeight)) / body.height;
    if (!height && !is_usual) {
        warn(model, fmt::format("it is {:.3g} m tall; scaled to {} m", body.height, kUsualHeight));
    }
    return body;
}

}  // namespace raks::render
