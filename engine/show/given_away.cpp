#include "engine/show/given_away.hpp"

#include <cstddef>
#include <utility>

#include "render/dress.hpp"
#include "render/export/scaled_model.hpp"
#include "render/mannequin/mannequin_model.hpp"
#include "render/scene/scene.hpp"

#include <glm/geometric.hpp>
#include <glm/gtc/quaternion.hpp>

namespace raks::engine {
namespace {

using render::Model;
using render::ModelNode;

/// Turns all of it by half a turn, so that it faces +z.
void turn_round(Model& model) {
    const glm::quat half_turn(0.0F, 0.0F, 1.0F, 0.0F);
    for (ModelNode& node : model.nodes) {
        if (node.parent < 0) {
            node.translation = half_turn * node.translation;
            node.rotation = half_turn * node.rotation;
        }
    }
    for (render::SpringChain& chain : model.character.springs) {
        for (render::SpringJoint& joint : chain.joints) {
            joint.gravity_direction = half_turn * joint.gravity_direction;
        }
    }
    model.character.faces_minus_z = false;
}

/// VRM 1.0 has no tails but joints: those that VRM 0.x thinks of become nodes.
void make_tails(Model& model) {
    constexpr float kTail = 0.07F;  // metres, UniVRM's
    for (render::SpringChain& chain : model.character.springs) {
        if (!chain.has_virtual_tail || chain.joints.empty()) {
            continue;
        }
        const int last = chain.joints.back().node;
        const auto index = static_cast<int>(model.nodes.size());
        ModelNode& carrier = model.nodes[static_cast<std::size_t>(last)];
        const float length = glm::length(carrier.translation);
        ModelNode tail;
        tail.name = carrier.name + " tail";
        tail.parent = last;
        tail.translation =
            length > 0.0F ? carrier.translation * (kTail / length) : glm::vec3(0.0F, -kTail, 0.0F);
        carrier.children.push_back(index);
        model.nodes.push_back(std::move(tail));
        render::SpringJoint joint = chain.joints.back();
        joint.node = index;
        chain.joints.push_back(joint);
        chain.has_virtual_tail = false;
    }
}

}  // namespace

Expected<Model> load_to_give_away(const std::filesystem::path& file, const AvatarOptions& options) {
    auto loaded = load_avatar_model(file, options);
    if (!loaded) {
        return fail(loaded.error());
    }
    Model& model = loaded->model;
    for (std::size_t i = 0; i < loaded->options.t_pose.size(); ++i) {
        model.nodes[i].rotation = loaded->options.t_pose[i];
    }
    if (model.character.faces_minus_z) {
        turn_round(model);
    }
    make_tails(model);
    render::scale_model(model, loaded->options.scale);
    return std::move(model);
}

Model mannequin_to_give_away() {
    render::Scene scene;
    scene.dress = render::Dress::dancer;
    const render::DressColours dress = render::dress_colours(scene, 0);
    render::PaintColours colours{};
    for (std::size_t i = 0; i < colours.size(); ++i) {
        colours[i] = glm::vec3(dress.colours[i]);
    }
    return render::mannequin_model(colours);
}

}  // namespace raks::engine
