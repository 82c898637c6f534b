#include "engine/show/standing_model.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <vector>

#include "render/avatar/joint_tree.hpp"
#include "render/import/body_parents.hpp"
#include "render/import/standing_body.hpp"
#include "render/model/model_survey.hpp"

#include <glm/geometric.hpp>
#include <glm/matrix.hpp>

namespace raks::engine {
namespace {

using render::Model;
using render::ModelNode;
using render::StandingBody;

void set_local(ModelNode& node, const glm::mat4& local) {
    const render::NodePlace place = render::place_of(local);
    node.translation = place.translation;
    node.rotation = place.rotation;
    node.scale = place.scale;
}

void set_parents(Model& model, const std::vector<int>& parents) {
    for (ModelNode& node : model.nodes) {
        node.children.clear();
    }
    for (std::size_t i = 0; i < model.nodes.size(); ++i) {
        model.nodes[i].parent = parents[i];
        if (parents[i] >= 0) {
            model.nodes[static_cast<std::size_t>(parents[i])].children.push_back(
                static_cast<int>(i));
        }
    }
    std::erase_if(model.roots,
                  [&](int root) { return parents[static_cast<std::size_t>(root)] >= 0; });
}

/// Local rotations of the T-pose: bones as straightened in the world, all else as it hangs.
std::vector<glm::quat> t_pose_of(const Model& model,
                                 const StandingBody& body,
                                 const std::vector<std::size_t>& order) {
    std::vector<glm::quat> world(model.nodes.size());
    std::vector<glm::quat> local(model.nodes.size());
    std::vector<const glm::quat*> straightened(model.nodes.size(), nullptr);
    for (std::size_t bone = 0; bone < body.straighten.size(); ++bone) {
        const int node = model.character.humanoid.nodes[bone];
        if (node >= 0) {
            straightened[static_cast<std::size_t>(node)] = &body.straighten[bone];
        }
    }
    for (const std::size_t node : order) {
        const int parent = model.nodes[node].parent;
        const glm::quat above = parent < 0 ? glm::quat(1.0F, 0.0F, 0.0F, 0.0F)
                                           : world[static_cast<std::size_t>(parent)];
        world[node] = straightened[node] != nullptr
                          ? *straightened[node] * render::rotation_of(body.world[node])
                          : above * model.nodes[node].rotation;
        local[node] = glm::normalize(glm::inverse(above) * world[node]);
    }
    return local;
}

}  // namespace

render::RigOptions stand_model(Model& model, std::optional<float> height) {
    const StandingBody body = render::stand_up(model, height);
    render::RigOptions options{.scale = body.scale, .t_pose = {}};
    if (model.character.vrm != render::VrmVersion::none) {
        return options;  // stored in its T-pose; the rig turns it to the front
    }
    const std::vector<std::size_t> order = render::parents_first(body.parents);
    set_parents(model, body.parents);
    for (const std::size_t node : order) {
        const int parent = body.parents[node];
        set_local(model.nodes[node],
                  parent < 0 ? body.world[node]
                             : glm::inverse(body.world[static_cast<std::size_t>(parent)]) *
                                   body.world[node]);
    }
    model.character.faces_minus_z = false;  // `world` is turned already
    options.t_pose = t_pose_of(model, body, order);
    return options;
}

render::RigOptions stand_thing(Model& model) {
    const auto box = render::rest_box(model);
    if (!box) {
        return {};
    }
    const glm::vec3 size = box->high - box->low;
    const float largest = std::max({size.x, size.y, size.z});
    if (!(largest > 0.0F && std::isfinite(largest))) {
        return {};
    }
    const glm::vec3 middle(
        0.5F * (box->low.x + box->high.x), box->low.y, 0.5F * (box->low.z + box->high.z));
    for (const int root : model.roots) {
        model.nodes[static_cast<std::size_t>(root)].translation -= middle;
    }
    return {.scale = render::kUsualHeight / largest, .t_pose = {}};
}

}  // namespace raks::engine
