// What a model file says of the figure in it: which nodes are its bones, its face, where it looks,
// what swings, whose work it is. VRM 1.0's terms; VRM 0.x is brought onto them when it is read.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <string>
#include <utility>
#include <variant>
#include <vector>

#include "motion/skeleton/humanoid.hpp"

#include <glm/vec2.hpp>
#include <glm/vec3.hpp>
#include <glm/vec4.hpp>

namespace raks::render {

/// The 15 bones that VRM 1.0 asks for.
inline constexpr std::array<motion::Bone, 15> kRequiredBones = {
    motion::Bone::hips,
    motion::Bone::spine,
    motion::Bone::head,
    motion::Bone::left_upper_leg,
    motion::Bone::left_lower_leg,
    motion::Bone::left_foot,
    motion::Bone::left_upper_arm,
    motion::Bone::left_lower_arm,
    motion::Bone::left_hand,
    motion::Bone::right_upper_leg,
    motion::Bone::right_lower_leg,
    motion::Bone::right_foot,
    motion::Bone::right_upper_arm,
    motion::Bone::right_lower_arm,
    motion::Bone::right_hand,
};

/// How the node of a bone was found.
enum class BoneReason : std::uint8_t {
    none,     ///< it was not
    stated,   ///< the file says so
    label,    ///< a label file says so
    name,     ///< by the node's name
    shape,    ///< by the tree of nodes, where they are and what they move
    motion,   ///< by how the model's own clip moves
    swapped,  ///< by its name, on the other side than the name says
};

/// The humanoid bones of a file: node of each motion::Bone, -1 where it has none, and the bones
/// that dances do not move.
struct HumanoidMap {
    std::array<int, motion::kBoneCount> nodes = [] {
        std::array<int, motion::kBoneCount> none{};
        none.fill(-1);
        return none;
    }();
    std::array<BoneReason, motion::kBoneCount> reasons{};
    /// How sure each is: 0 (not found) to 1 (the file or a person says so). Below 0.7: the picture
    /// speaks against it.
    std::array<float, motion::kBoneCount> confidence{};
    /// Where bones point at rest, in the axes of their nodes, as a label file says; 0: it does not.
    std::array<glm::vec3, motion::kBoneCount> axes{};
    /// Rigid parts that no skin joins: one of them may be a whole limb, or trunk and head.
    bool is_of_parts = false;
    int left_eye = -1;
    int right_eye = -1;
    int jaw = -1;
};

/// The nearest bone above `bone` that is mapped; -1: none (hips).
[[nodiscard]] inline int mapped_parent(const HumanoidMap& humanoid, int bone) noexcept {
    while (bone != 0) {
        bone = motion::kBoneParents[static_cast<std::size_t>(bone)];
        if (humanoid.nodes[static_cast<std::size_t>(bone)] >= 0) {
            return bone;
        }
    }
    return -1;
}

/// A morph target that an expression moves.
struct MorphBind {
    int node = -1;  ///< whose mesh
    int target = 0;
    float weight = 1.0F;  ///< at expression weight 1; 0..1
};

enum class ColourBindKind : std::uint8_t {
    base,
    emission,
    shade,
    matcap,
    rim,
    outline,
};

/// A colour that an expression moves to its target.
struct ColourBind {
    int material = -1;
    ColourBindKind kind = ColourBindKind::base;
    glm::vec4 target{1.0F};
};

/// A texture transform that an expression moves to its target, for all textures of the material.
struct TextureBind {
    int material = -1;
    glm::vec2 scale{1.0F};
    glm::vec2 offset{0.0F};
};

enum class ExpressionOverride : std::uint8_t { none, block, blend };

/// A face. Names: VRM 1.0 presets ("happy", "aa", "blinkLeft"), else the maker's own.
struct Expression {
    std::string name;
    bool is_preset = false;
    bool is_binary = false;  ///< weights above 0.5 are 1, all others 0
    ExpressionOverride override_blink = ExpressionOverride::none;
    ExpressionOverride override_look_at = ExpressionOverride::none;
    ExpressionOverride override_mouth = ExpressionOverride::none;
    std::vector<MorphBind> morphs;
    std::vector<ColourBind> colours;
    std::vector<TextureBind> textures;
};

/// From an angle of the gaze to a turn of the eye or a weight of an expression:
/// min(angle, input_max) / input_max * output_scale.
struct LookAtRange {
    float input_max = 90.0F;     ///< degrees, above 0
    float output_scale = 10.0F;  ///< degrees (bones) or weight (expressions)
};

struct LookAt {
    bool is_by_bones = true;  ///< else by the expressions lookUp, lookDown, lookLeft, lookRight
    glm::vec3 offset_from_head{0.0F};  ///< where the gaze begins, in the head's space
    LookAtRange horizontal_inner;
    LookAtRange horizontal_outer;
    LookAtRange vertical_down;
    LookAtRange vertical_up;
};

enum class ColliderShape : std::uint8_t { sphere, capsule, inside_sphere, inside_capsule, plane };

/// What swinging joints do not pass. In the space of its node.
struct SpringCollider {
    int node = -1;
    ColliderShape shape = ColliderShape::sphere;
    glm::vec3 offset{0.0F};
    glm::vec3 tail{0.0F};                ///< capsules: the other end
    glm::vec3 normal{0.0F, 0.0F, 1.0F};  ///< plane
    float radius = 0.0F;                 ///< metres of the file
};

/// A joint that swings; the next one of its chain is its tail.
struct SpringJoint {
    int node = -1;
    float hit_radius = 0.0F;  ///< metres of the file
    float stiffness = 1.0F;
    float gravity_power = 0.0F;
    glm::vec3 gravity_direction{0.0F, -1.0F, 0.0F};
    float drag = 0.5F;  ///< 0..1
};

/// One chain: joints from root to tip. In VRM 1.0 the last is only the tail of the one before.
struct SpringChain {
    std::string name;
    std::vector<SpringJoint> joints;
    /// VRM 0.x: the last joint swings, too, about a tail 7 cm further on.
    bool has_virtual_tail = false;
    std::vector<int> colliders;  ///< in Character::colliders
    int center = -1;             ///< node whose motion adds no swing; -1: the world
};

enum class NodeAxis : std::uint8_t { x, y, z, minus_x, minus_y, minus_z };
enum class ConstraintKind : std::uint8_t { rotation, roll, aim };

/// VRMC_node_constraint: what a node takes of another's rotation.
struct NodeConstraint {
    int node = -1;
    int source = -1;
    ConstraintKind kind = ConstraintKind::rotation;
    NodeAxis axis = NodeAxis::x;  ///< roll: x, y or z; aim: any
    float weight = 1.0F;          ///< 0..1
};

/// Whose work it is, and what may be done with it.
struct Licence {
    std::string title;
    std::string version;
    std::vector<std::string> authors;
    std::string contact;
    std::string copyright;
    std::string name;  ///< licence in words, or its address
    bool is_credit_required = false;
    /// All that the file says of use, as (its own key, its own value), in the file's order.
    std::vector<std::pair<std::string, std::string>> terms;
    int thumbnail = -1;  ///< image: a picture of it
};

enum class VrmVersion : std::uint8_t { none, vrm0, vrm1 };

/// A figure.
struct Character {
    VrmVersion vrm = VrmVersion::none;
    HumanoidMap humanoid;
    std::vector<Expression> expressions;
    LookAt look_at;
    bool has_look_at = false;
    std::vector<SpringCollider> colliders;
    std::vector<SpringChain> springs;
    /// As the file counts them: chains in VRM 1.0, bone groups, of any number of chains, in 0.x.
    std::size_t stated_springs = 0;
    std::vector<NodeConstraint> constraints;
    Licence licence;
    /// Faces -z, as VRM 0.x does: turned about y by half a turn before anything else.
    bool faces_minus_z = false;
};

}  // namespace raks::render
