#include "render/model/model_survey.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <set>

#include <glm/geometric.hpp>
#include <glm/gtc/quaternion.hpp>

namespace raks::render {
namespace {

std::size_t at(int index) { return static_cast<std::size_t>(index); }

glm::mat4 parent_from_node(const ModelNode& node) {
    glm::mat4 matrix = glm::mat4_cast(node.rotation);
    for (int axis = 0; axis < 3; ++axis) {
        matrix[axis] *= node.scale[axis];
    }
    matrix[3] = glm::vec4(node.translation, 1.0F);
    return matrix;
}

/// Nodes of the scene, parents first.
std::vector<int> shown_nodes(const Model& model) {
    std::vector<int> nodes(model.roots.begin(), model.roots.end());
    for (std::size_t i = 0; i < nodes.size(); ++i) {
        const std::vector<int>& children = model.nodes[at(nodes[i])].children;
        nodes.insert(nodes.end(), children.begin(), children.end());
    }
    return nodes;
}

/// Grows a box by points.
class BoxMaker {
 public:
    void add(const glm::vec3& point) {
        box_.low = is_empty_ ? point : glm::min(box_.low, point);
        box_.high = is_empty_ ? point : glm::max(box_.high, point);
        is_empty_ = false;
    }
    [[nodiscard]] std::optional<ModelBox> box() const {
        return is_empty_ ? std::nullopt : std::optional(box_);
    }

 private:
    ModelBox box_;
    bool is_empty_ = true;
};

/// World from mesh for each joint of a skin.
std::vector<glm::mat4> skin_matrices(const ModelSkin& skin, const std::vector<glm::mat4>& world) {
    std::vector<glm::mat4> matrices(skin.joints.size());
    for (std::size_t j = 0; j < matrices.size(); ++j) {
        matrices[j] = world[at(skin.joints[j])] * skin.inverse_bind[j];
    }
    return matrices;
}

glm::vec3 skinned(const ModelPrimitive& primitive,
                  std::size_t vertex,
                  const std::vector<glm::mat4>& matrices) {
    glm::vec4 place(0.0F);
    for (std::size_t i = 0; i < 4; ++i) {
        const float weight = primitive.weights[vertex][i];
        if (weight > 0.0F) {
            place += weight * (matrices[primitive.joints[vertex][i]] *
                               glm::vec4(primitive.positions[vertex], 1.0F));
        }
    }
    return place;
}

/// The boxes of a node's primitives.
void add_parts(const Model& model,
               int index,
               const std::vector<glm::mat4>& world,
               std::vector<RestPart>& parts) {
    const ModelNode& node = model.nodes[at(index)];
    const std::vector<glm::mat4> matrices = node.skin >= 0
                                                ? skin_matrices(model.skins[at(node.skin)], world)
                                                : std::vector<glm::mat4>();
    const auto& primitives = model.meshes[at(node.mesh)].primitives;
    for (std::size_t i = 0; i < primitives.size(); ++i) {
        const ModelPrimitive& primitive = primitives[i];
        const bool is_skinned = node.skin >= 0 && !primitive.joints.empty();
        std::vector<bool> is_done(primitive.positions.size());
        BoxMaker box;
        for (const std::uint32_t vertex : primitive.indices) {
            if (!is_done[vertex]) {
                is_done[vertex] = true;
                box.add(is_skinned ? skinned(primitive, vertex, matrices)
                                   : glm::vec3(world[at(index)] *
                                               glm::vec4(primitive.positions[vertex], 1.0F)));
            }
        }
        parts.push_back({index, i, box.box()});
    }
}

/// How far joints are from their bind places, seen from the first joint of the skin.
float rest_minus_bind_of(const ModelSkin& skin, const std::vector<glm::mat4>& world) {
    const std::vector<glm::mat4> matrices = skin_matrices(skin, world);
    float farthest = 0.0F;
    for (std::size_t j = 0; j < matrices.size(); ++j) {
        const glm::vec4 bind = glm::inverse(skin.inverse_bind[j])[3];
        farthest = std::max(farthest, glm::length(glm::vec3((matrices[j] - matrices[0]) * bind)));
    }
    return farthest;
}

std::string axis_of(const glm::vec3& direction) {
    int axis = 0;
    for (int i = 1; i < 3; ++i) {
        axis = std::abs(direction[i]) > std::abs(direction[axis]) ? i : axis;
    }
    constexpr float kNear = 0.97F;
    const float share = std::abs(direction[axis]);
    std::string text = {direction[axis] < 0.0F ? '-' : '+', "XYZ"[axis]};
    return share > kNear ? text : text + fmt::format("({:.2f})", share);
}

/// "+Z" of the level part of a direction; empty where there is none.
std::string level_axis_of(glm::vec3 direction) {
    direction.y = 0.0F;
    constexpr float kShort = 1e-6F;
    return glm::length(direction) > kShort ? axis_of(glm::normalize(direction)) : std::string();
}

void survey_bones(const Model& model, const std::vector<glm::mat4>& world, ModelSurvey& survey) {
    using motion::Bone;
    const HumanoidMap& humanoid = model.character.humanoid;
    const auto node = [&](Bone bone) { return humanoid.nodes[motion::index_of(bone)]; };
    const auto place = [&](Bone bone) { return glm::vec3(world[at(node(bone))][3]); };
    if (node(Bone::left_upper_leg) >= 0 && node(Bone::right_upper_leg) >= 0) {
        glm::vec3 across = place(Bone::left_upper_leg) - place(Bone::right_upper_leg);
        across.y = 0.0F;
        const glm::vec3 ahead = glm::cross(across, glm::vec3(0.0F, 1.0F, 0.0F));
        survey.facing = level_axis_of(ahead);
        if (!survey.facing.empty()) {
            survey.facing_degrees = glm::degrees(
                std::atan2(static_cast<double>(ahead.x), static_cast<double>(ahead.z)));
        }
    }
    if (node(Bone::left_foot) >= 0 && node(Bone::left_toes) >= 0) {
        survey.toe_direction = level_axis_of(place(Bone::left_toes) - place(Bone::left_foot));
    }
    for (const int bone : humanoid.nodes) {
        survey.humanoid_bones += bone >= 0 ? 1 : 0;
    }
    for (const int bone : {humanoid.left_eye, humanoid.right_eye, humanoid.jaw}) {
        survey.humanoid_bones += bone >= 0 ? 1 : 0;
    }
}

std::string format_of(const Model& model) {
    if (!model.format.empty()) {
        return model.format;
    }
    switch (model.character.vrm) {
        case VrmVersion::vrm0:
            return "VRM 0.x";
        case VrmVersion::vrm1:
            return "VRM 1.0";
        case VrmVersion::none:
            break;
    }
    return model.animated_face.is_vrma ? "VRMA 1.0" : "glTF 2.0";
}

}  // namespace

std::vector<glm::mat4> rest_world(const Model& model) {
    std::vector<glm::mat4> world(model.nodes.size(), glm::mat4(1.0F));
    std::vector<int> open;
    for (std::size_t i = 0; i < model.nodes.size(); ++i) {
        if (model.nodes[i].parent < 0) {
            open.push_back(static_cast<int>(i));
        }
    }
    for (std::size_t i = 0; i < open.size(); ++i) {
        const ModelNode& node = model.nodes[at(open[i])];
        const glm::mat4 local = parent_from_node(node);
        world[at(open[i])] = node.parent >= 0 ? world[at(node.parent)] * local : local;
        open.insert(open.end(), node.children.begin(), node.children.end());
    }
    return world;
}

std::vector<RestPart> rest_parts(const Model& model) {
    const std::vector<glm::mat4> world = rest_world(model);
    std::vector<RestPart> parts;
    for (const int index : shown_nodes(model)) {
        if (model.nodes[at(index)].mesh >= 0) {
            add_parts(model, index, world, parts);
        }
    }
    return parts;
}

std::optional<ModelBox> rest_box(const Model& model) {
    BoxMaker box;
    for (const RestPart& part : rest_parts(model)) {
        if (part.box) {
            box.add(part.box->low);
            box.add(part.box->high);
        }
    }
    return box.box();
}

ModelSurvey survey(const Model& model) {
    ModelSurvey survey;
    survey.format = format_of(model);
    survey.nodes = model.nodes.size();
    survey.skins = model.skins.size();
    survey.meshes = model.meshes.size();
    survey.images = model.images.size();
    survey.animations = model.animations.size();
    survey.springs = model.character.stated_springs;
    survey.spring_chains = model.character.springs.size();
    survey.expressions = model.character.expressions.size();
    for (const ModelMesh& mesh : model.meshes) {
        survey.primitives += mesh.primitives.size();
        survey.max_morphs = std::max(survey.max_morphs, mesh.morph_weights.size());
        for (const ModelPrimitive& primitive : mesh.primitives) {
            survey.vertices += primitive.positions.size();
            survey.triangles += primitive.indices.size() / 3;
        }
    }
    const std::vector<glm::mat4> world = rest_world(model);
    std::set<int> joints;
    for (const ModelSkin& skin : model.skins) {
        joints.insert(skin.joints.begin(), skin.joints.end());
        survey.rest_minus_bind =
            std::max(survey.rest_minus_bind.value_or(0.0F), rest_minus_bind_of(skin, world));
    }
    survey.joints = joints.size();
    survey.box = rest_box(model);
    survey_bones(model, world, survey);
    return survey;
}

}  // namespace raks::render
