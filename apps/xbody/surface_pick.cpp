#include "apps/xbody/surface_pick.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <iterator>
#include <limits>

#include "render/avatar/skin_vertices.hpp"
#include "render/import/bind_places.hpp"

#include <glm/geometric.hpp>
#include <glm/mat4x4.hpp>
#include <glm/vec3.hpp>
#include <glm/vec4.hpp>

namespace raks::apps {
namespace {

using render::ModelPrimitive;

/// A line of sight.
struct Ray {
    glm::vec3 from;
    glm::vec3 along;  // not of length 1
};

Ray ray_through(const glm::vec2& place, const render::Camera& camera, const render::Box& box) {
    const glm::mat4 world_from_clip = glm::inverse(camera.clip_from_world(box.width / box.height));
    const glm::vec4 clip(2.0F * (place.x - box.x) / box.width - 1.0F,
                         1.0F - 2.0F * (place.y - box.y) / box.height,
                         0.5F,
                         1.0F);
    const glm::vec4 world = world_from_clip * clip;
    const glm::vec3 from = camera.position();
    return {from, glm::vec3(world) / world.w - from};
}

/// Where a ray meets a triangle: how far along, and the shares of its corners.
struct Meeting {
    float at = 0.0F;
    std::array<float, 3> shares{};
};

// Moeller and Trumbore 1997, "Fast, minimum storage ray/triangle intersection"; either side counts.
std::optional<Meeting> meeting_of(const Ray& ray, const std::array<glm::vec3, 3>& corners) {
    const glm::vec3 one = corners[1] - corners[0];
    const glm::vec3 two = corners[2] - corners[0];
    const glm::vec3 across = glm::cross(ray.along, two);
    const float volume = glm::dot(one, across);
    if (!(std::abs(volume) > 0.0F)) {
        return std::nullopt;
    }
    const glm::vec3 off = ray.from - corners[0];
    const float u = glm::dot(off, across) / volume;
    const glm::vec3 turned = glm::cross(off, one);
    const float v = glm::dot(ray.along, turned) / volume;
    const float at = glm::dot(two, turned) / volume;
    if (!(u >= 0.0F && v >= 0.0F && u + v <= 1.0F && at > 0.0F)) {
        return std::nullopt;
    }
    return Meeting{at, {1.0F - u - v, u, v}};
}

/// The nearest surface that a ray meets.
class NearestSurface {
 public:
    NearestSurface(const ShownModel& model, const ShownPose& shown, const Ray& ray)
        : model_(model.figure.model),
          tree_(model.avatar->rig->tree),
          joints_(shown.state.joints),
          ray_(ray) {}

    void look_at(int node) {
        const render::ModelNode& one = model_.nodes[static_cast<std::size_t>(node)];
        if (one.mesh < 0) {
            return;
        }
        matrices_.resize(render::matrix_count(model_, node));
        render::skinning_matrices(model_, tree_, joints_, node, matrices_);
        const render::ModelMesh& mesh = model_.meshes[static_cast<std::size_t>(one.mesh)];
        for (const ModelPrimitive& primitive : mesh.primitives) {
            render::pose_vertices(primitive, mesh.morph_weights, matrices_, posed_);
            look_at(node, primitive);
        }
    }

    [[nodiscard]] std::optional<int> node() const { return node_; }

 private:
    void look_at(int node, const ModelPrimitive& primitive) {
        for (std::size_t i = 0; i + 2 < primitive.indices.size(); i += 3) {
            std::array<glm::vec3, 3> corners;
            for (std::size_t k = 0; k < corners.size(); ++k) {
                corners[k] = posed_.positions[primitive.indices[i + k]];
            }
            const auto meeting = meeting_of(ray_, corners);
            if (meeting && meeting->at < nearest_) {
                nearest_ = meeting->at;
                const auto corner =
                    std::distance(meeting->shares.begin(),
                                  std::max_element(meeting->shares.begin(), meeting->shares.end()));
                node_ = render::mover_of(model_,
                                         primitive,
                                         primitive.indices[i + static_cast<std::size_t>(corner)],
                                         node);
            }
        }
    }

    const render::Model& model_;
    const render::JointTree& tree_;
    const render::JointState& joints_;
    Ray ray_;
    std::vector<glm::mat4> matrices_;
    render::PosedVertices posed_;
    float nearest_ = std::numeric_limits<float>::max();
    std::optional<int> node_;
};

}  // namespace

std::optional<int> node_at(const glm::vec2& place,
                           const ShownModel& model,
                           const ShownPose& shown,
                           const std::vector<bool>& is_hidden,
                           const render::Camera& camera,
                           const render::Box& box) {
    NearestSurface nearest(model, shown, ray_through(place, camera, box));
    for (std::size_t node = 0; node < model.figure.model.nodes.size(); ++node) {
        if (is_hidden.empty() || !is_hidden[node]) {
            nearest.look_at(static_cast<int>(node));
        }
    }
    return nearest.node();
}

}  // namespace raks::apps
