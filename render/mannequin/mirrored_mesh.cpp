#include "render/mannequin/mirrored_mesh.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "base/assert.hpp"
#include "render/mannequin/surface_cells.hpp"

#include <glm/geometric.hpp>

namespace raks::render {
namespace {

// Newton steps that bring a vertex onto the surface.
constexpr int kProjections = 4;
constexpr float kProjectionStep = 0.0015F;  // metres, of the gradient's tetrahedron

/// Connects the leaves' vertices: one quad for every minimal edge that crosses the surface.
class Contouring {
 public:
    Contouring(const BodyField& field, const BindFrames& frames)
        : field_(field), cells_(field, frames) {}

    // Vertices come first: `connect` needs those of all neighbours. Its list of leaves does not
    // grow, while a leaf without vertex may still get one there.
    MirroredMesh run() {
        place_vertices();
        const std::size_t count = cells_.leaves().size();
        for (std::size_t i = 0; i < count; ++i) {
            connect(cells_.leaves()[i]);
        }
        project_all();
        return std::move(mesh_);
    }

 private:
    // An edge of a cell: its lower end, the axis it is parallel to, its length in finest cells.
    struct Edge {
        GridPoint low;
        int axis;
        int length;
    };

    /// Where the field, taken as linear between two grid points of different sign, is zero.
    [[nodiscard]] glm::vec3 crossing(GridPoint a, GridPoint b) {
        const float at_a = cells_.value_at(a);
        const float at_b = cells_.value_at(b);
        const float share = at_a / (at_a - at_b);
        return glm::mix(SurfaceCells::position(a), SurfaceCells::position(b), share);
    }

    /// Each group of inside corners of a leaf gets a vertex at the mean of its edges' crossings.
    void place_vertices() {
        for (SurfaceCell& cell : cells_.leaves()) {
            if (cell.group_count == 0) {
                continue;
            }
            std::array<glm::vec3, 8> sums{};
            std::array<float, 8> counts{};
            for (const auto& edge : kCellEdges) {
                const int a = cell.corner_groups[static_cast<std::size_t>(edge[0])];
                const int b = cell.corner_groups[static_cast<std::size_t>(edge[1])];
                // Only an edge with one end inside crosses the surface.
                if ((a < 0) == (b < 0)) {
                    continue;
                }
                const auto group = static_cast<std::size_t>(std::max(a, b));
                sums[group] += crossing(corner_of(cell, edge[0]), corner_of(cell, edge[1]));
                counts[group] += 1.0F;
            }
            cell.first_vertex = static_cast<int>(mesh_.positions.size());
            for (std::size_t g = 0; g < static_cast<std::size_t>(cell.group_count); ++g) {
                mesh_.positions.push_back(sums[g] / counts[g]);
            }
        }
    }

    /// Makes the quads around all edges of a leaf that cross the surface.
    void connect(const SurfaceCell& cell) {
        for (const auto& ends : kCellEdges) {
            const int a = cell.corner_groups[static_cast<std::size_t>(ends[0])];
            const int b = cell.corner_groups[static_cast<std::size_t>(ends[1])];
            if ((a < 0) == (b < 0)) {
                continue;
            }
            // Corner numbers are three bits x, y, z: their difference along an edge is 1, 2 or 4.
            const int axis = ends[1] - ends[0] == 1 ? 0 : ends[1] - ends[0] == 2 ? 1 : 2;
            connect_around(cell, {corner_of(cell, ends[0]), axis, cell.size});
        }
    }

    /// Makes the quad around an edge of `cell`, unless a smaller cell touches the edge (that one
    /// has the minimal edge) or an equal one that comes first.
    void connect_around(const SurfaceCell& cell, const Edge& edge) {
        const auto axis = static_cast<std::size_t>(edge.axis);
        const std::size_t b = (axis + 1) % 3;
        const std::size_t c = (axis + 2) % 3;
        // The four cells around the edge, in turning order about its axis.
        constexpr std::array<std::array<int, 2>, 4> kAround = {
            {{-1, -1}, {0, -1}, {0, 0}, {-1, 0}}};
        std::array<SurfaceCell*, 4> around{};
        std::array<std::uint32_t, 4> is_mirrored{};
        for (std::size_t k = 0; k < 4; ++k) {
            GridPoint place = edge.low;
            // A finest cell beside the middle of the edge; `leaf_at` finds the leaf that holds it.
            place[axis] += edge.length / 2;
            place[b] += kAround[k][0];
            place[c] += kAround[k][1];
            // Right of the mirror plane lies the image of a stored cell; its vertices have odd
            // numbers.
            if (place[0] < 0) {
                place[0] = -1 - place[0];
                is_mirrored[k] = 1;
            }
            around[k] = cells_.leaf_at(place);
            RAKS_ASSERT(around[k] != nullptr);
            const bool is_taken = around[k] == nullptr || around[k]->size < cell.size ||
                                  (around[k]->size == cell.size && around[k] < &cell);
            if (is_taken) {
                return;
            }
        }
        std::array<std::uint32_t, 4> quad{};
        for (std::size_t k = 0; k < 4; ++k) {
            quad[k] = 2 * vertex_of(*around[k], edge) + is_mirrored[k];
        }
        // Triangles run counter-clockwise seen from outside: the surface faces the outside end.
        if (cells_.value_at(edge.low) >= 0.0F) {
            std::reverse(quad.begin(), quad.end());
        }
        // Such a quad holds its own mirror image, so `add_triangle` does not add it a second time.
        const bool spans_the_mirror = is_mirrored != std::array<std::uint32_t, 4>{};
        add_quad(quad, spans_the_mirror);
    }

    [[nodiscard]] static GridPoint high_end(const Edge& edge) noexcept {
        GridPoint high = edge.low;
        high[static_cast<std::size_t>(edge.axis)] += edge.length;
        return high;
    }

    /// The vertex of `cell` that belongs to the surface crossing `edge`: that of the edge's inside
    /// corner, or, in a larger cell, the nearest; one is made where the cell has none.
    std::uint32_t vertex_of(SurfaceCell& cell, const Edge& edge) {
        const GridPoint high = high_end(edge);
        const GridPoint inside = cells_.value_at(edge.low) < 0.0F ? edge.low : high;
        if (cell.first_vertex >= 0) {
            // The cell has the inside corner among its own corners when it is of the edge's size.
            for (int k = 0; k < 8; ++k) {
                const int group = cell.corner_groups[static_cast<std::size_t>(k)];
                if (group >= 0 && corner_of(cell, k) == inside) {
                    return static_cast<std::uint32_t>(cell.first_vertex + group);
                }
            }
        }
        // A larger cell may hold the crossing although none of its own corners is inside.
        const glm::vec3 place = crossing(edge.low, high);
        if (cell.first_vertex < 0) {
            cell.first_vertex = static_cast<int>(mesh_.positions.size());
            cell.group_count = 1;
            mesh_.positions.push_back(place);
        }
        return nearest_vertex(cell, place);
    }

    /// Number (left half) of the cell's vertex nearest to `place`.
    [[nodiscard]] std::uint32_t nearest_vertex(const SurfaceCell& cell, glm::vec3 place) const {
        int best = cell.first_vertex;
        float best_distance = std::numeric_limits<float>::max();
        for (int v = cell.first_vertex; v < cell.first_vertex + cell.group_count; ++v) {
            const float distance =
                glm::length(mesh_.positions[static_cast<std::size_t>(v)] - place);
            if (distance < best_distance) {
                best = v;
                best_distance = distance;
            }
        }
        return static_cast<std::uint32_t>(best);
    }

    /// Splits along the shorter diagonal; equal neighbours leave one triangle or none.
    void add_quad(const std::array<std::uint32_t, 4>& q, bool spans_the_mirror) {
        const float d02 = glm::length(mesh_.position(q[0]) - mesh_.position(q[2]));
        const float d13 = glm::length(mesh_.position(q[1]) - mesh_.position(q[3]));
        if (d02 <= d13) {
            add_triangle({q[0], q[1], q[2]}, spans_the_mirror);
            add_triangle({q[0], q[2], q[3]}, spans_the_mirror);
        } else {
            add_triangle({q[1], q[2], q[3]}, spans_the_mirror);
            add_triangle({q[1], q[3], q[0]}, spans_the_mirror);
        }
    }

    /// Adds a triangle and its mirror image, whose corners run the other way round.
    void add_triangle(const std::array<std::uint32_t, 3>& t, bool spans_the_mirror) {
        // Between cells of different size two corners of a quad can be the same vertex.
        if (t[0] == t[1] || t[1] == t[2] || t[2] == t[0]) {
            return;
        }
        mesh_.triangles.push_back(t);
        if (!spans_the_mirror) {
            mesh_.triangles.push_back({t[0] ^ 1U, t[2] ^ 1U, t[1] ^ 1U});
        }
    }

    /// Newton's method along the gradient: p -= g d / |g|^2.
    void project_all() {
        for (glm::vec3& p : mesh_.positions) {
            for (int i = 0; i < kProjections; ++i) {
                const float distance = field_.distance(p);
                if (std::abs(distance) < 1e-6F) {
                    break;
                }
                const glm::vec3 gradient = field_.gradient(p, kProjectionStep);
                // The floor of 0.05 keeps the step short where the gradient nearly vanishes
                // (creases).
                p -= gradient * (distance / std::max(glm::dot(gradient, gradient), 0.05F));
            }
        }
    }

    const BodyField& field_;
    SurfaceCells cells_;
    MirroredMesh mesh_;
};

}  // namespace

MirroredMesh extract_surface(const BodyField& field, const BindFrames& frames) {
    return Contouring(field, frames).run();
}

namespace {

// Few passes: triangles get even, and moving on would only wear off vertices from fine cells.
constexpr int kPasses = 5;
constexpr int kRenewNormalsAt = 3;
constexpr float kTowardMean = 0.6F;
constexpr float kNormalStep = 0.0025F;  // metres; also the detail that normals smooth away

/// Normals from the field, not from the triangles: the mesh is coarser than the shape.
void set_normals(const BodyField& field, MirroredMesh& mesh) {
    mesh.normals.resize(mesh.positions.size());
    for (std::size_t i = 0; i < mesh.positions.size(); ++i) {
        mesh.normals[i] = glm::normalize(field.gradient(mesh.positions[i], kNormalStep));
    }
}

}  // namespace

Neighbours::Neighbours(const MirroredMesh& mesh) {
    // Every edge of a closed surface runs once each way: the next corner of each triangle is
    // enough.
    // Counts, then prefix sums, then places: a compressed list of neighbours for each left vertex.
    first_.assign(mesh.positions.size() + 1, 0);
    for (const auto& triangle : mesh.triangles) {
        for (const std::uint32_t corner : triangle) {
            first_[corner / 2 + 1] += corner % 2 == 0 ? 1U : 0U;
        }
    }
    for (std::size_t i = 1; i < first_.size(); ++i) {
        first_[i] += first_[i - 1];
    }
    list_.resize(first_.back());
    std::vector<std::size_t> next(first_.begin(), first_.end() - 1);
    for (const auto& triangle : mesh.triangles) {
        for (std::size_t k = 0; k < 3; ++k) {
            if (triangle[k] % 2 == 0) {
                list_[next[triangle[k] / 2]++] = triangle[(k + 1) % 3];
            }
        }
    }
}

void relax(const BodyField& field, const Neighbours& neighbours, MirroredMesh& mesh) {
    set_normals(field, mesh);
    std::vector<glm::vec3> moved(mesh.positions.size());
    for (int pass = 0; pass < kPasses; ++pass) {
        // Normals cost four evaluations a vertex; they turn little while vertices slide.
        if (pass == kRenewNormalsAt) {
            set_normals(field, mesh);
        }
        for (std::size_t i = 0; i < mesh.positions.size(); ++i) {
            const auto around = neighbours.of(i);
            glm::vec3 mean{0.0F};
            for (const std::uint32_t neighbour : around) {
                mean += mesh.position(neighbour);
            }
            mean /= static_cast<float>(around.size());
            const glm::vec3 normal = mesh.normals[i];
            glm::vec3 step = kTowardMean * (mean - mesh.positions[i]);
            // Only the tangential part moves the vertex; the field then puts it back on the
            // surface.
            step -= normal * glm::dot(step, normal);
            moved[i] = mesh.positions[i] + step;
            moved[i] -= normal * field.distance(moved[i]);
        }
        std::swap(mesh.positions, moved);
    }
    set_normals(field, mesh);
}

}  // namespace raks::render
