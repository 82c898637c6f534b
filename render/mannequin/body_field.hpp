#pragma once

#include <array>
#include <cstddef>
#include <vector>

#include "render/mannequin/bind_pose.hpp"
#include "render/mannequin/body_primitives.hpp"

#include <glm/vec3.hpp>

namespace raks::render {

/// A solid moved into the bind pose and made ready for many evaluations.
struct PreparedLoft {
    /// The loft between two stations: five cubics of the length u from the first station (metres),
    /// in the order half width, half front, half back, shift to the side, shift to the front.
    struct Segment {
        /// Place of the first station along the axis, metres.
        float start;
        /// Coefficients of 1, u, u^2, u^3.
        std::array<std::array<float, 4>, 5> cubics;
    };
    /// In rising order of `start`, never empty once prepared.
    std::vector<Segment> segments;
    /// Place of the last station along the axis, metres.
    float end = 0.0F;
    /// In the world, bind pose.
    glm::vec3 origin{};
    /// Unit vectors in the world, bind pose.
    SolidFrame frame{};
    /// Of the superellipse, as in Loft.
    float exponent = 2.0F;
    /// Length of the rounded end before the first station, metres.
    float cap_start = 1.0F;
    /// Length of the rounded end behind the last station, metres.
    float cap_end = 1.0F;
};

/// Signed distance to the mannequin's skin in the bind pose: negative inside, metres, about right
/// near the surface. Symmetric in x.
///
///     core    = trunk and head, folded by smooth minimum, less the carved parts, plus details
///     hand    = min over fingers of smooth_min(palm, finger): fingers never grow together
///     arm     = smooth_min(arm, hand)
///     surface = min(smooth_min(core, leg), smooth_min(core, arm)): nor do limbs
///
/// Farther than 6 cm from a group, its bounding sphere stands for it: a lower bound, so do not use
/// `core`, `leg`, `arm`, `finger` as numbers beyond 5 cm.
class BodyField {
 public:
    /// Moves every primitive into the bind pose of `frames`, which is not kept.
    explicit BodyField(const BindFrames& frames);

    /// Distance to the whole skin; about 0.3 us. Threads: any, as for all functions here.
    [[nodiscard]] float distance(glm::vec3 p) const noexcept;
    /// Gradient from differences between the four corners of a tetrahedron around `p`, whose
    /// coordinates are `step` metres off; not normalized.
    [[nodiscard]] glm::vec3 gradient(glm::vec3 p, float step) const noexcept;

    /// Trunk and head, without limbs.
    [[nodiscard]] float core(glm::vec3 p) const noexcept;
    /// The leg on the side of `p`, with the flat shoe sole cut.
    [[nodiscard]] float leg(glm::vec3 p) const noexcept;
    /// The arm on the side of `p`, with its hand.
    [[nodiscard]] float arm(glm::vec3 p) const noexcept;
    /// One of thumb .. little alone, without the palm.
    [[nodiscard]] float finger(Group finger, glm::vec3 p) const noexcept;

 private:
    struct Solid {
        std::variant<PreparedLoft, RoundCone, Ellipsoid> shape;
        glm::vec3 sphere_center{};
        float sphere_radius = 0.0F;
        float blend = 0.0F;
        Fold fold = Fold::one_side;
    };
    struct SolidGroup {
        std::vector<Solid> solids;
        glm::vec3 sphere_center{};
        float sphere_radius = 0.0F;
    };

    static Solid prepare(const Primitive& primitive, const BindFrames& frames);
    static void enclose(SolidGroup& group) noexcept;
    static float solid_distance(const Solid& solid, glm::vec3 p) noexcept;
    /// Joins the group's solids to what is at `distance` already.
    [[nodiscard]] float fold(Group group, glm::vec3 p, float distance) const noexcept;
    [[nodiscard]] float hand(glm::vec3 p) const noexcept;
    [[nodiscard]] const SolidGroup& solids(Group group) const noexcept {
        return groups_[static_cast<std::size_t>(group)];
    }

    std::array<SolidGroup, kGroupCount> groups_;
    glm::vec3 sole_point_{};
    glm::vec3 sole_normal_{};
    glm::vec3 foot_forward_{};
};

}  // namespace raks::render
