#include "render/avatar/skin_split.hpp"

#include <array>
#include <map>
#include <memory>
#include <set>
#include <utility>

namespace raks::render {
namespace {

/// Takes the elements of an array over vertices that `chosen` names; an empty array stays empty.
template <typename T>
std::vector<T> taken(const std::vector<T>& from, const std::vector<std::uint32_t>& chosen) {
    std::vector<T> to;
    for (const std::uint32_t vertex : chosen) {
        if (!from.empty()) {
            to.push_back(from[vertex]);
        }
    }
    return to;
}

MorphTarget taken(const MorphTarget& from, const std::map<std::uint32_t, std::uint32_t>& place) {
    MorphTarget to;
    for (std::size_t i = 0; i < from.vertices.size(); ++i) {
        const auto found = place.find(from.vertices[i]);
        if (found != place.end()) {
            to.vertices.push_back(found->second);
            to.positions.push_back(from.positions[i]);
            if (!from.normals.empty()) {
                to.normals.push_back(from.normals[i]);
            }
        }
    }
    return to;
}

/// Collects triangles until their joints are too many.
class Piece {
 public:
    explicit Piece(const ModelPrimitive& whole) : whole_(whole) {}

    /// Whether the joints of a triangle still fit.
    [[nodiscard]] bool has_room_for(const std::array<std::uint32_t, 3>& triangle,
                                    std::size_t most) const {
        std::set<std::uint16_t> more;
        for (const std::uint32_t vertex : triangle) {
            for (std::size_t k = 0; k < 4; ++k) {
                if (whole_.weights[vertex][k] > 0.0F &&
                    !joint_place_.contains(whole_.joints[vertex][k])) {
                    more.insert(whole_.joints[vertex][k]);
                }
            }
        }
        return joints_.size() + more.size() <= most;
    }

    void add(const std::array<std::uint32_t, 3>& triangle) {
        for (const std::uint32_t vertex : triangle) {
            const auto [place, is_new] =
                place_.try_emplace(vertex, static_cast<std::uint32_t>(chosen_.size()));
            if (is_new) {
                chosen_.push_back(vertex);
                add_joints(vertex);
            }
            indices_.push_back(place->second);
        }
    }

    [[nodiscard]] bool is_empty() const noexcept { return indices_.empty(); }

    [[nodiscard]] SkinnedPiece finished() const {
        SkinnedPiece piece;
        ModelPrimitive& made = piece.primitive;
        made.material = whole_.material;
        made.positions = taken(whole_.positions, chosen_);
        made.normals = taken(whole_.normals, chosen_);
        made.tangents = taken(whole_.tangents, chosen_);
        for (std::size_t set = 0; set < made.uv.size(); ++set) {
            made.uv[set] = taken(whole_.uv[set], chosen_);
        }
        made.colours = taken(whole_.colours, chosen_);
        made.weights = taken(whole_.weights, chosen_);
        made.joints = vertex_joints_;
        made.indices = indices_;
        for (const MorphTarget& morph : whole_.morphs) {
            made.morphs.push_back(taken(morph, place_));
        }
        piece.joints = joints_;
        return piece;
    }

 private:
    void add_joints(std::uint32_t vertex) {
        std::array<std::uint16_t, 4> local{};
        for (std::size_t k = 0; k < local.size(); ++k) {
            if (whole_.weights[vertex][k] > 0.0F) {
                const auto [place, is_new] = joint_place_.try_emplace(
                    whole_.joints[vertex][k], static_cast<std::uint16_t>(joints_.size()));
                if (is_new) {
                    joints_.push_back(whole_.joints[vertex][k]);
                }
                local[k] = place->second;
            }
        }
        vertex_joints_.push_back(local);
    }

    const ModelPrimitive& whole_;
    std::map<std::uint32_t, std::uint32_t> place_;  // of the whole's vertices
    std::map<std::uint16_t, std::uint16_t> joint_place_;
    std::vector<std::uint32_t> chosen_;
    std::vector<std::uint32_t> indices_;
    std::vector<std::uint16_t> joints_;
    std::vector<std::array<std::uint16_t, 4>> vertex_joints_;
};

}  // namespace

std::vector<SkinnedPiece> split_by_joints(const ModelPrimitive& primitive, std::size_t most) {
    std::vector<SkinnedPiece> pieces;
    auto piece = std::make_unique<Piece>(primitive);
    for (std::size_t i = 0; i + 2 < primitive.indices.size(); i += 3) {
        const std::array<std::uint32_t, 3> triangle = {
            primitive.indices[i], primitive.indices[i + 1], primitive.indices[i + 2]};
        if (!piece->has_room_for(triangle, most)) {
            pieces.push_back(piece->finished());
            piece = std::make_unique<Piece>(primitive);
        }
        piece->add(triangle);
    }
    if (!piece->is_empty()) {
        pieces.push_back(piece->finished());
    }
    return pieces;
}

}  // namespace raks::render
