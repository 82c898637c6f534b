// What a model file says: index-based, checked, in the file's own units and space.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <string>
#include <utility>
#include <vector>

#include "render/model/character.hpp"
#include "render/model/material.hpp"

#include <glm/gtc/quaternion.hpp>
#include <glm/mat4x4.hpp>
#include <glm/vec2.hpp>
#include <glm/vec3.hpp>
#include <glm/vec4.hpp>

/// The learning type of avatars: readers (render/import) make it, builders (render/avatar) turn it
/// into the running type. All indices are within their arrays or -1 (none), all numbers finite, all
/// parents acyclic: a reader refuses what is not so. Right-handed, y up.
namespace raks::render {

struct ModelNode {
    std::string name;
    int parent = -1;
    std::vector<int> children;
    glm::vec3 translation{0.0F};
    glm::quat rotation{1.0F, 0.0F, 0.0F, 0.0F};  ///< unit
    glm::vec3 scale{1.0F};
    int mesh = -1;
    int skin = -1;
    std::vector<float> morph_weights;  ///< at rest, instead of the mesh's; empty: the mesh's
};

/// What a morph target adds to the vertices named.
struct MorphTarget {
    std::vector<std::uint32_t> vertices;  ///< ascending; those that it moves
    std::vector<glm::vec3> positions;     ///< for each of them, added
    std::vector<glm::vec3> normals;       ///< the same, or empty
};

/// Triangles of one material. Arrays over vertices are as long as `positions`, or empty.
struct ModelPrimitive {
    int material = -1;  ///< -1: glTF's default material
    std::vector<glm::vec3> positions;
    std::vector<glm::vec3> normals;
    std::vector<glm::vec4> tangents;  ///< w: side of the bitangent
    std::array<std::vector<glm::vec2>, 2> uv;
    std::vector<glm::vec4> colours;  ///< linear
    /// Four influences: joints of the skin, weights that sum to 1. Of more, the four largest.
    std::vector<std::array<std::uint16_t, 4>> joints;
    std::vector<std::array<float, 4>> weights;
    std::size_t uneven_weights = 0;  ///< vertices whose weights in the file do not sum to 1 (0.001)
    std::vector<std::uint32_t> indices;  ///< triangles, counter-clockwise; three at a time
    std::vector<MorphTarget> morphs;     ///< as many for each primitive of a mesh
};

struct ModelMesh {
    std::string name;
    std::vector<ModelPrimitive> primitives;
    std::vector<std::string> morph_names;  ///< as many as morph targets; may be empty texts
    std::vector<float> morph_weights;      ///< at rest
};

struct ModelSkin {
    std::vector<int> joints;              ///< nodes
    std::vector<glm::mat4> inverse_bind;  ///< as many: joint from mesh, in the bind pose
};

enum class ChannelPath : std::uint8_t { translation, rotation, scale, weights };
enum class Interpolation : std::uint8_t { step, linear, cubic };

/// One thing that a clip moves.
struct AnimationChannel {
    int node = -1;
    ChannelPath path = ChannelPath::translation;
    Interpolation interpolation = Interpolation::linear;
    std::vector<float> times;  ///< seconds, ascending
    /// Values one after the other: 3, 4 or (weights) as many numbers a time as there are targets;
    /// cubic: in-tangent, value, out-tangent for each time.
    std::vector<float> values;
};

struct ModelAnimation {
    std::string name;
    std::vector<AnimationChannel> channels;
    std::string sound = {};  ///< file of what it is danced to, for people; written, and not read
};

/// VRMC_vrm_animation: nodes that stand for what is no node.
struct AnimatedFace {
    bool is_vrma = false;  ///< the file is one: its humanoid is what its animation moves
    std::vector<std::pair<std::string, int>> expressions;  ///< name, node: weight is translation x
    int look_at = -1;                                      ///< node: the gaze's target
};

struct Model {
    std::string name;    ///< of the file, for people
    std::string format;  ///< "3DS v3", "FBX"; empty: glTF and what is built on it
    std::vector<ModelNode> nodes;
    std::vector<int> roots;  ///< nodes of the scene that is shown
    std::vector<ModelMesh> meshes;
    std::vector<ModelSkin> skins;
    std::vector<ModelMaterial> materials;
    std::vector<ModelTexture> textures;
    std::vector<ModelImage> images;
    std::vector<ModelAnimation> animations;
    Character character;
    AnimatedFace animated_face;  ///< of VRMA files
    /// What was repaired, guessed or left out: one line each, printable.
    std::vector<std::string> warnings;
};

}  // namespace raks::render
