#include "tests/render/avatar/tiny_model.hpp"

#include <cmath>

#include "base/random.hpp"

namespace raks::render::test {

int add_node(Model& model,
             const std::string& name,
             int parent,
             const glm::vec3& translation,
             const glm::quat& rotation) {
    const int index = static_cast<int>(model.nodes.size());
    ModelNode node;
    node.name = name;
    node.parent = parent;
    node.translation = translation;
    node.rotation = rotation;
    model.nodes.push_back(node);
    if (parent < 0) {
        model.roots.push_back(index);
    } else {
        model.nodes[static_cast<std::size_t>(parent)].children.push_back(index);
    }
    return index;
}

glm::quat turn_about_x(float angle) { return glm::angleAxis(angle, glm::vec3(1, 0, 0)); }
glm::quat turn_about_y(float angle) { return glm::angleAxis(angle, glm::vec3(0, 1, 0)); }
glm::quat turn_about_z(float angle) { return glm::angleAxis(angle, glm::vec3(0, 0, 1)); }

Model humanoid_model() {
    Model model;
    for (std::size_t i = 0; i < motion::kBoneCount; ++i) {
        const int parent = i == 0 ? -1 : static_cast<int>(motion::kBoneParents[i]);
        const int node = add_node(model,
                                  std::string(motion::kBoneNames[i]),
                                  parent,
                                  motion::mannequin_skeleton().offsets[i]);
        model.character.humanoid.nodes[i] = node;
    }
    return model;
}

Model crooked_humanoid_model() {
    Model model = humanoid_model();
    const CounterRandom random(7);
    std::vector<glm::quat> worlds;
    for (std::size_t i = 0; i < model.nodes.size(); ++i) {
        ModelNode& node = model.nodes[i];
        const glm::quat world =
            glm::normalize(glm::quat(static_cast<float>(random.normal(4 * i)),
                                     static_cast<float>(random.normal(4 * i + 1)),
                                     static_cast<float>(random.normal(4 * i + 2)),
                                     static_cast<float>(random.normal(4 * i + 3))));
        const glm::quat above =
            node.parent < 0 ? motion::kNoRotation : worlds[static_cast<std::size_t>(node.parent)];
        node.rotation = glm::inverse(above) * world;
        node.translation = glm::inverse(above) * node.translation;
        worlds.push_back(world);
    }
    return model;
}

Model hanging_chain(const glm::vec3& start, const glm::vec3& offset, int count) {
    Model model;
    int node = add_node(model, "root", -1, start);
    SpringChain chain;
    chain.name = "chain";
    for (int i = 0; i < count; ++i) {
        node =
            add_node(model, "joint " + std::to_string(i), node, i == 0 ? glm::vec3(0.0F) : offset);
        SpringJoint joint;
        joint.node = node;
        chain.joints.push_back(joint);
    }
    model.character.springs.push_back(chain);
    return model;
}

bool is_same_rotation(const glm::quat& a, const glm::quat& b, float radians) {
    const glm::quat difference = glm::inverse(a) * b;
    const float half = std::hypot(difference.x, difference.y, difference.z);
    return 2.0F * half < radians;
}

}  // namespace raks::render::test
