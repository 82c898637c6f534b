#include "engine/trials/mirror_mates.hpp"

#include <array>
#include <cmath>
#include <cstdint>
#include <map>

#include "motion/skeleton/humanoid.hpp"

#include <glm/geometric.hpp>

namespace raks::engine {
namespace {

constexpr float kNear = 0.002F;  // metres
constexpr double kSymmetric = 0.95;

using Cell = std::array<std::int32_t, 3>;

Cell cell_of(const glm::vec3& place) noexcept {
    const auto index = [](float value) {
        return static_cast<std::int32_t>(std::floor(value / kNear));
    };
    return {index(place.x), index(place.y), index(place.z)};
}

std::size_t mirrored_bone(std::size_t bone) noexcept {
    return bone < motion::kBoneCount ? index_of(motion::mirrored(static_cast<motion::Bone>(bone)))
                                     : bone;
}

/// Vertices by the cell of space in which they lie.
class Grid {
 public:
    Grid(const render::SkinnedMesh& mesh, std::span<const glm::vec3> at_rest)
        : mesh_(mesh), at_rest_(at_rest) {
        for (std::size_t i = 0; i < at_rest.size(); ++i) {
            cells_[cell_of(at_rest[i])].push_back(i);
        }
    }

    /// The vertex nearest to a place that the bone carries, at most kNear away.
    [[nodiscard]] std::optional<std::size_t> nearest(const glm::vec3& place,
                                                     std::size_t bone) const {
        const Cell middle = cell_of(place);
        std::optional<std::size_t> found;
        float best = kNear;
        for (std::int32_t n = 0; n < 27; ++n) {
            const auto cell = cells_.find(
                {middle[0] + n % 3 - 1, middle[1] + n / 3 % 3 - 1, middle[2] + n / 9 - 1});
            if (cell == cells_.end()) {
                continue;
            }
            for (const std::size_t i : cell->second) {
                const float away = glm::distance(at_rest_[i], place);
                if (away <= best && mesh_.bone(i) == bone) {
                    best = away;
                    found = i;
                }
            }
        }
        return found;
    }

 private:
    const render::SkinnedMesh& mesh_;
    std::span<const glm::vec3> at_rest_;
    std::map<Cell, std::vector<std::size_t>> cells_;
};

}  // namespace

std::optional<std::vector<MirrorMate>> mirror_mates(const render::SkinnedMesh& mesh,
                                                    std::span<const glm::vec3> at_rest) {
    const Grid grid(mesh, at_rest);
    std::vector<MirrorMate> mates;
    std::size_t asked = 0;
    for (std::size_t i = 0; i < at_rest.size(); ++i) {
        if (mesh.bone(i) == render::SkinnedMesh::kNoBone) {
            continue;
        }
        ++asked;
        const glm::vec3 image(-at_rest[i].x, at_rest[i].y, at_rest[i].z);
        if (const auto mate = grid.nearest(image, mirrored_bone(mesh.bone(i)))) {
            mates.push_back({i, *mate});
        }
    }
    if (static_cast<double>(mates.size()) < kSymmetric * static_cast<double>(asked) ||
        mates.empty()) {
        return std::nullopt;
    }
    return mates;
}

}  // namespace raks::engine
