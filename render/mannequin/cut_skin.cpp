#include "render/mannequin/cut_skin.hpp"

#include <cmath>
#include <cstddef>
#include <cstdint>
#include <map>
#include <utility>

#include <glm/geometric.hpp>

namespace raks::render {
namespace {

// As in materials.glsl.
constexpr float kHalfTrim = 0.14F;
constexpr float kHalfStripe = 0.2F;

/// A signed function of a point whose zero is an edge between colours.
struct ColourEdge {
    AvatarMask mask;
    float at;
};

constexpr std::array kEdges = {ColourEdge{AvatarMask::suit, kHalfTrim},
                               ColourEdge{AvatarMask::suit, -kHalfTrim},
                               ColourEdge{AvatarMask::hair, 0.0F},
                               ColourEdge{AvatarMask::shoe, 0.0F},
                               ColourEdge{AvatarMask::accent, 0.0F},
                               ColourEdge{AvatarMask::outer, 0.0F},
                               ColourEdge{AvatarMask::stripe, kHalfStripe},
                               ColourEdge{AvatarMask::stripe, -kHalfStripe}};

float mask_of(const SkinPoint& point, AvatarMask mask) noexcept {
    return point.masks[static_cast<std::size_t>(mask)];
}

SkinPoint point_of(const AvatarVertex& vertex) noexcept {
    SkinPoint point;
    point.position = {vertex.position[0], vertex.position[1], vertex.position[2]};
    for (int axis = 0; axis < 3; ++axis) {
        point.normal[axis] = static_cast<float>(vertex.normal[static_cast<std::size_t>(axis)]);
    }
    point.normal = glm::normalize(point.normal);
    for (std::size_t i = 0; i < point.masks.size(); ++i) {
        point.masks[i] = static_cast<float>(vertex.masks[i]) / 127.0F;
    }
    for (std::size_t i = 0; i < vertex.joints.size(); ++i) {
        point.shares[vertex.joints[i]] += static_cast<float>(vertex.weights[i]) / 255.0F;
    }
    return point;
}

SkinPoint between(const SkinPoint& a, const SkinPoint& b, float t) noexcept {
    SkinPoint point;
    const auto mix = [t](const auto& from, const auto& to, auto& mixed) {
        for (std::size_t i = 0; i < mixed.size(); ++i) {
            mixed[i] = (1.0F - t) * from[i] + t * to[i];
        }
    };
    point.position = (1.0F - t) * a.position + t * b.position;
    point.normal = glm::normalize((1.0F - t) * a.normal + t * b.normal);
    mix(a.masks, b.masks, point.masks);
    mix(a.shares, b.shares, point.shares);
    return point;
}

/// Cuts all triangles of a skin along one edge.
class EdgeCut {
 public:
    EdgeCut(CutSkin& skin, const ColourEdge& edge) : skin_(skin) {
        // Points so near to the edge lie on it: no slivers.
        constexpr float kNear = 0.03F;
        for (const SkinPoint& point : skin.points) {
            const float value = mask_of(point, edge.mask) - edge.at;
            values_.push_back(std::abs(value) < kNear ? 0.0F : value);
        }
    }

    void run() {
        std::vector<std::uint32_t> indices;
        indices.swap(skin_.indices);
        for (std::size_t i = 0; i + 2 < indices.size(); i += 3) {
            cut(&indices[i]);
        }
    }

 private:
    void cut(const std::uint32_t* triangle) {
        std::vector<std::uint32_t> inside;
        std::vector<std::uint32_t> outside;
        bool has_inside = false;
        for (std::size_t k = 0; k < 3; ++k) {
            const std::uint32_t a = triangle[k];
            const std::uint32_t b = triangle[(k + 1) % 3];
            has_inside = has_inside || values_[a] > 0.0F;
            if (values_[a] >= 0.0F) {
                inside.push_back(a);
            }
            if (values_[a] <= 0.0F) {
                outside.push_back(a);
            }
            if (values_[a] * values_[b] < 0.0F) {
                const std::uint32_t middle = crossing(a, b);
                inside.push_back(middle);
                outside.push_back(middle);
            }
        }
        if (has_inside) {
            add(inside);
        }
        if (!has_inside || outside.size() > 2) {
            add(outside);
        }
    }

    /// The point where the edge crosses a side of a triangle, the same for both its triangles.
    std::uint32_t crossing(std::uint32_t a, std::uint32_t b) {
        if (a > b) {
            std::swap(a, b);
        }
        const auto [place, is_new] = crossings_.try_emplace(
            std::pair(a, b), static_cast<std::uint32_t>(skin_.points.size()));
        if (is_new) {
            const float t = values_[a] / (values_[a] - values_[b]);
            skin_.points.push_back(between(skin_.points[a], skin_.points[b], t));
            values_.push_back(0.0F);
        }
        return place->second;
    }

    /// A convex polygon.
    void add(const std::vector<std::uint32_t>& corners) {
        for (std::size_t k = 2; k < corners.size(); ++k) {
            skin_.indices.insert(skin_.indices.end(), {corners[0], corners[k - 1], corners[k]});
        }
    }

    CutSkin& skin_;
    std::vector<float> values_;
    std::map<std::pair<std::uint32_t, std::uint32_t>, std::uint32_t> crossings_;
};

/// The colour of a point, as materials.glsl has it; the last that covers it wins.
Paint paint_at(const std::array<float, kMaskCount>& masks) noexcept {
    const auto mask = [&](AvatarMask which) { return masks[static_cast<std::size_t>(which)]; };
    const float suit = mask(AvatarMask::suit);
    if (std::abs(suit) < kHalfTrim) {
        return Paint::trim;
    }
    if (suit > 0.0F) {
        const bool is_stripe = std::abs(mask(AvatarMask::stripe)) < kHalfStripe;
        return is_stripe && mask(AvatarMask::outer) > 0.0F ? Paint::stripe : Paint::suit;
    }
    if (mask(AvatarMask::accent) > 0.0F) {
        return Paint::sole;
    }
    if (mask(AvatarMask::shoe) > 0.0F) {
        return Paint::shoes;
    }
    return mask(AvatarMask::hair) > 0.0F ? Paint::hair : Paint::skin;
}

Paint paint_of(const CutSkin& skin, std::size_t first_index) noexcept {
    std::array<float, kMaskCount> middle{};
    for (std::size_t k = 0; k < 3; ++k) {
        const SkinPoint& point = skin.points[skin.indices[first_index + k]];
        for (std::size_t i = 0; i < middle.size(); ++i) {
            middle[i] += point.masks[i] / 3.0F;
        }
    }
    return paint_at(middle);
}

}  // namespace

CutSkin cut_skin(const Avatar& mannequin) {
    CutSkin skin;
    for (const AvatarVertex& vertex : mannequin.vertices) {
        skin.points.push_back(point_of(vertex));
    }
    skin.indices.assign(mannequin.indices.begin(), mannequin.indices.end());
    for (const ColourEdge& edge : kEdges) {
        EdgeCut(skin, edge).run();
    }
    for (std::size_t i = 0; i + 2 < skin.indices.size(); i += 3) {
        skin.paints.push_back(paint_of(skin, i));
    }
    return skin;
}

}  // namespace raks::render
