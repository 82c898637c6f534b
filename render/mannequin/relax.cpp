#include "render/mannequin/relax.hpp"

#include <algorithm>

#include <glm/geometric.hpp>

namespace raks::render {
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
