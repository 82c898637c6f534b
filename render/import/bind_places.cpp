#include "render/import/bind_places.hpp"

#include <Eigen/Eigenvalues>
#include <algorithm>
#include <cmath>
#include <iterator>
#include <limits>
#include <utility>

#include "render/import/node_tree.hpp"
#include "render/model/finite.hpp"
#include "render/model/model_survey.hpp"

#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <glm/gtc/matrix_transform.hpp>
#include <glm/matrix.hpp>
#include <glm/vec2.hpp>

namespace raks::render {
namespace {

glm::mat4 local_of(const ModelNode& node) {
    return glm::translate(glm::mat4(1.0F), node.translation) * glm::mat4_cast(node.rotation) *
           glm::scale(glm::mat4(1.0F), node.scale);
}

/// Where the skin's own space has each joint; empty where it does not say.
std::vector<glm::mat4> bound_joints(const ModelSkin& skin) {
    std::vector<glm::mat4> bound;
    bool says_something = false;
    for (const glm::mat4& inverse : skin.inverse_bind) {
        const glm::mat4 joint = glm::inverse(inverse);
        if (!is_finite(joint)) {
            return {};
        }
        says_something = says_something || inverse != skin.inverse_bind.front();
        bound.push_back(joint);
    }
    return says_something && bound.size() == skin.joints.size() ? bound : std::vector<glm::mat4>();
}

/// The first joint of a skin above which no other of its joints lies; of several the one that
/// carries the most of them, or the first that is bound already: `is_bound`, by node.
std::size_t root_joint(const Model& model,
                       const ModelSkin& skin,
                       const std::vector<bool>& is_bound) {
    std::vector<int> place_in_skin(model.nodes.size(), -1);
    for (std::size_t j = skin.joints.size(); j-- > 0;) {
        place_in_skin[static_cast<std::size_t>(skin.joints[j])] = static_cast<int>(j);
    }
    std::vector<std::size_t> carried(skin.joints.size(), 0);
    for (const int joint : skin.joints) {
        int top = joint;
        for (int up = joint; up >= 0; up = node_of(model, up).parent) {
            top = place_in_skin[static_cast<std::size_t>(up)] >= 0 ? up : top;
        }
        ++carried[static_cast<std::size_t>(place_in_skin[static_cast<std::size_t>(top)])];
    }
    for (const int joint : skin.joints) {
        if (is_bound[static_cast<std::size_t>(joint)]) {
            return static_cast<std::size_t>(place_in_skin[static_cast<std::size_t>(joint)]);
        }
    }
    return static_cast<std::size_t>(std::max_element(carried.begin(), carried.end()) -
                                    carried.begin());
}

/// The mean length of a matrix's axes: how much larger it makes things.
float size_of(const glm::mat4& matrix) {
    return std::cbrt(std::abs(glm::determinant(glm::mat3(matrix))));
}

/// Whether every joint of a skin is where it was bound, but for rounding, if `from_skin` brings the
/// skin's space into the world: the nodes are then not in some pose of an animation.
bool is_at_rest(const ModelSkin& skin,
                std::span<const glm::mat4> bound,
                std::span<const glm::mat4> world,
                const glm::mat4& from_skin) {
    constexpr float kRounding = 1e-3F;  // of what the skin spans
    float span = 0.0F;
    float farthest = 0.0F;
    const glm::vec3 first(from_skin * bound.front()[3]);
    for (std::size_t j = 0; j < bound.size(); ++j) {
        const glm::vec3 place(from_skin * bound[j][3]);
        const glm::mat4& now = world[static_cast<std::size_t>(skin.joints[j])];
        span = std::max(span, glm::distance(first, place));
        farthest = std::max(farthest, glm::distance(place, glm::vec3(now[3])));
    }
    return farthest <= kRounding * span;
}

/// Whether two ways from a skin's space into the world differ by no more than the pose of one
/// joint: the same size, and up is up to within half a right angle.
bool is_same_space(const glm::mat4& posed, const glm::mat4& unposed) {
    constexpr float kSameSize = 0.02F;
    constexpr float kLeastUpright = 0.7F;  // cosine
    const glm::mat3 turn = glm::mat3(posed) * glm::inverse(glm::mat3(unposed));
    const float size = size_of(glm::mat4(turn));
    return std::abs(size - 1.0F) < kSameSize && turn[1].y > kLeastUpright * size;
}

/// `from_skin`, turned about a place by the shortest way so that an axis of the skin's space points
/// up: figures are drawn along an axis, whatever pose their root joint is in.
glm::mat4 stood_up(const glm::mat4& from_skin, const glm::vec3& about) {
    const glm::vec3 up(0.0F, 1.0F, 0.0F);
    glm::vec3 nearest = up;
    float highest = -1.0F;
    for (int axis = 0; axis < 3; ++axis) {
        const glm::vec3 along = glm::normalize(glm::vec3(from_skin[axis]));
        if (std::abs(along.y) > highest) {
            highest = std::abs(along.y);
            nearest = along.y < 0.0F ? -along : along;
        }
    }
    const glm::vec3 across = glm::cross(nearest, up);
    if (!(glm::length(across) > 1e-6F)) {
        return from_skin;
    }
    const float angle = std::atan2(glm::length(across), glm::dot(nearest, up));
    return glm::translate(glm::mat4(1.0F), about) *
           glm::rotate(glm::mat4(1.0F), angle, glm::normalize(across)) *
           glm::translate(glm::mat4(1.0F), -about) * from_skin;
}

/// World from the skin's space, which no file states: the one that leaves the root joint where it
/// is at rest. Where the nodes stand in some pose of an animation, that of the root joint is taken
/// off: the skin was bound in the world, or in the space of what carries the root joint, if one of
/// them has the same size and the same up; else an axis of the skin's space points up.
/// `world`: of the nodes at rest, or as bound already.
glm::mat4 world_from_skin(const Model& model,
                          const ModelSkin& skin,
                          std::span<const glm::mat4> bound,
                          std::span<const glm::mat4> world,
                          const std::vector<bool>& is_bound) {
    const std::size_t root = root_joint(model, skin, is_bound);
    const auto node = static_cast<std::size_t>(skin.joints[root]);
    const glm::mat4 from_skin = world[node] * skin.inverse_bind[root];
    if (!is_finite(from_skin) || !(size_of(from_skin) > 0.0F)) {
        return glm::mat4(1.0F);  // a root that is scaled away says nothing
    }
    if (is_bound[node] || is_at_rest(skin, bound, world, from_skin)) {
        return from_skin;
    }
    const int carrier = model.nodes[node].parent;
    const glm::mat4 carried =
        carrier >= 0 ? world[static_cast<std::size_t>(carrier)] : glm::mat4(1.0F);
    float least = std::numeric_limits<float>::infinity();
    glm::mat4 best = stood_up(from_skin, glm::vec3(world[node][3]));
    for (const glm::mat4& space : {glm::mat4(1.0F), carried}) {
        const float away =
            glm::distance(glm::vec3(space * bound[root][3]), glm::vec3(world[node][3]));
        if (away < least * 0.999F && is_finite(space) && is_same_space(from_skin, space)) {
            least = away;
            best = space;
        }
    }
    return best;
}

/// The skin of the most joints says first how a figure stands.
std::vector<const ModelSkin*> largest_first(const std::vector<ModelSkin>& skins) {
    std::vector<const ModelSkin*> sorted;
    sorted.reserve(skins.size());
    for (const ModelSkin& skin : skins) {
        sorted.push_back(&skin);
    }
    std::stable_sort(sorted.begin(), sorted.end(), [](const ModelSkin* a, const ModelSkin* b) {
        return a->joints.size() > b->joints.size();
    });
    return sorted;
}

/// Whether a skin was bound in the pose of those before: joints that it shares with them are where
/// it has them, too, but for a little of what it spans. `bound`: world of its joints.
bool is_same_stance(const ModelSkin& skin,
                    std::span<const glm::mat4> bound,
                    std::span<const glm::mat4> world,
                    const std::vector<bool>& is_bound) {
    constexpr float kSlack = 0.02F;
    glm::vec3 lowest(bound.front()[3]);
    glm::vec3 highest = lowest;
    float farthest = 0.0F;
    for (std::size_t j = 0; j < bound.size(); ++j) {
        const auto node = static_cast<std::size_t>(skin.joints[j]);
        const glm::vec3 place(bound[j][3]);
        lowest = glm::min(lowest, place);
        highest = glm::max(highest, place);
        if (is_bound[node]) {
            farthest = std::max(farthest, glm::distance(place, glm::vec3(world[node][3])));
        }
    }
    return farthest <= kSlack * glm::distance(lowest, highest);
}

/// Puts all nodes that are not bound where they are stored against their parents.
void hang_on_parents(const Model& model,
                     std::span<const int> order,
                     const std::vector<bool>& is_bound,
                     std::vector<glm::mat4>& world) {
    for (const int node : order) {
        const int parent = node_of(model, node).parent;
        if (!is_bound[static_cast<std::size_t>(node)] && parent >= 0) {
            world[static_cast<std::size_t>(node)] =
                world[static_cast<std::size_t>(parent)] * local_of(node_of(model, node));
        }
    }
}

/// Where a vertex is: by its joints, or by the node that shows it.
glm::vec3 vertex_place(const ModelPrimitive& primitive,
                       std::size_t vertex,
                       std::span<const glm::mat4> skinning,
                       const glm::mat4& rigid) {
    const glm::vec4 position(primitive.positions[vertex], 1.0F);
    if (skinning.empty() || primitive.joints.empty() || primitive.weights.empty()) {
        return glm::vec3(rigid * position);
    }
    glm::vec4 place(0.0F);
    for (std::size_t k = 0; k < 4; ++k) {
        const float weight = primitive.weights[vertex][k];
        if (weight > 0.0F) {
            place += weight * (skinning[primitive.joints[vertex][k]] * position);
        }
    }
    return glm::vec3(place);
}

}  // namespace

std::vector<glm::mat4> bind_world(const Model& model) {
    std::vector<glm::mat4> world = rest_world(model);
    std::vector<bool> is_bound(model.nodes.size(), false);
    const std::vector<int> order = parents_first(model);
    for (const ModelSkin* skin : largest_first(model.skins)) {
        std::vector<glm::mat4> bound = bound_joints(*skin);
        if (bound.empty()) {
            continue;
        }
        const glm::mat4 from_skin = world_from_skin(model, *skin, bound, world, is_bound);
        for (glm::mat4& joint : bound) {
            joint = from_skin * joint;
        }
        if (!is_same_stance(*skin, bound, world, is_bound)) {
            continue;
        }
        for (std::size_t j = 0; j < bound.size(); ++j) {
            const auto node = static_cast<std::size_t>(skin->joints[j]);
            if (!is_bound[node]) {
                is_bound[node] = true;
                world[node] = bound[j];
            }
        }
        hang_on_parents(model, order, is_bound, world);
    }
    return world;
}

void for_each_vertex(const Model& model,
                     std::span<const glm::mat4> world,
                     const std::function<void(int, const glm::vec3&)>& see) {
    for (std::size_t node = 0; node < model.nodes.size(); ++node) {
        if (model.nodes[node].mesh < 0) {
            continue;
        }
        std::vector<glm::mat4> skinning;
        if (const int skin = model.nodes[node].skin; skin >= 0) {
            const ModelSkin& joints = model.skins[static_cast<std::size_t>(skin)];
            for (std::size_t j = 0; j < joints.joints.size(); ++j) {
                skinning.push_back(world[static_cast<std::size_t>(joints.joints[j])] *
                                   joints.inverse_bind[j]);
            }
        }
        const ModelMesh& mesh = model.meshes[static_cast<std::size_t>(model.nodes[node].mesh)];
        for (const ModelPrimitive& primitive : mesh.primitives) {
            for (std::size_t vertex = 0; vertex < primitive.positions.size(); ++vertex) {
                see(mover_of(model, primitive, vertex, static_cast<int>(node)),
                    vertex_place(primitive, vertex, skinning, world[node]));
            }
        }
    }
}

std::vector<glm::vec3> places_of(std::span<const glm::mat4> world) {
    std::vector<glm::vec3> places;
    places.reserve(world.size());
    for (const glm::mat4& matrix : world) {
        places.emplace_back(matrix[3]);
    }
    return places;
}

MeshBox mesh_box(const Model& model, std::span<const glm::mat4> world) {
    constexpr float kFar = std::numeric_limits<float>::infinity();
    MeshBox box{glm::vec3(kFar), glm::vec3(-kFar)};
    for_each_vertex(model, world, [&box](int, const glm::vec3& place) {
        box.lowest = glm::min(box.lowest, place);
        box.highest = glm::max(box.highest, place);
    });
    return box.lowest.x <= box.highest.x ? box : MeshBox();
}

std::vector<glm::vec3> mean_offsets(const Model& model, std::span<const glm::mat4> world) {
    std::vector<glm::vec3> sums(model.nodes.size(), glm::vec3(0.0F));
    std::vector<float> counts(model.nodes.size(), 0.0F);
    for_each_vertex(model, world, [&](int node, const glm::vec3& place) {
        const auto at = static_cast<std::size_t>(node);
        sums[at] += place - glm::vec3(world[at][3]);
        counts[at] += 1.0F;
    });
    for (std::size_t i = 0; i < sums.size(); ++i) {
        sums[i] /= std::max(counts[i], 1.0F);
    }
    return sums;
}

int mover_of(const Model& model, const ModelPrimitive& primitive, std::size_t vertex, int node) {
    const int skin = node_of(model, node).skin;
    if (skin < 0 || primitive.joints.empty() || primitive.weights.empty()) {
        return node;
    }
    const auto& weights = primitive.weights[vertex];
    const auto largest = static_cast<std::size_t>(std::max_element(weights.begin(), weights.end()) -
                                                  weights.begin());
    return model.skins[static_cast<std::size_t>(skin)].joints[primitive.joints[vertex][largest]];
}

namespace {

/// The unit axis along which vertices lie, by the sum of the squares of their places about their
/// middle; 0: they are about as broad as long.
glm::vec3 longest_axis(const Eigen::Matrix3d& squares) {
    constexpr double kLongerThanBroad = 2.0;  // of the squares of lengths
    if (!squares.allFinite()) {
        return glm::vec3(0.0F);
    }
    const Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d> solver(squares);
    const Eigen::Vector3d axis = solver.eigenvectors().col(2);
    return solver.eigenvalues()[2] > kLongerThanBroad * solver.eigenvalues()[1]
               ? glm::vec3(glm::dvec3(axis.x(), axis.y(), axis.z()))
               : glm::vec3(0.0F);
}

}  // namespace

std::vector<glm::vec3> flesh_directions(const Model& model, std::span<const glm::mat4> world) {
    std::vector<glm::vec3> directions = mean_offsets(model, world);
    std::vector<Eigen::Matrix3d> squares(directions.size(), Eigen::Matrix3d::Zero());
    for_each_vertex(model, world, [&](int node, const glm::vec3& place) {
        const auto at = static_cast<std::size_t>(node);
        const glm::vec3 off = place - glm::vec3(world[at][3]) - directions[at];
        const Eigen::Vector3d from_middle(off.x, off.y, off.z);
        squares[at] += from_middle * from_middle.transpose();
    });
    std::vector<glm::vec3> axes;
    std::transform(squares.begin(), squares.end(), std::back_inserter(axes), longest_axis);
    // How far they reach from the joint to either end.
    std::vector<glm::vec2> reaches(axes.size(), glm::vec2(0.0F));
    for_each_vertex(model, world, [&](int node, const glm::vec3& place) {
        const auto at = static_cast<std::size_t>(node);
        const float along = glm::dot(place - glm::vec3(world[at][3]), axes[at]);
        reaches[at] = glm::max(reaches[at], glm::vec2(along, -along));
    });
    for (std::size_t i = 0; i < directions.size(); ++i) {
        constexpr float kClearly = 1.2F;
        const auto [ahead, back] = std::pair(reaches[i].x, reaches[i].y);
        if (std::max(ahead, back) > kClearly * std::min(ahead, back)) {
            directions[i] = (ahead > back ? 1.0F : -1.0F) * glm::length(directions[i]) * axes[i];
        }
    }
    return directions;
}

}  // namespace raks::render
