#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <vector>

#include "base/smooth_steps.hpp"
#include "render/mannequin/bind_pose.hpp"
#include "render/mannequin/body_primitives.hpp"
#include "render/model/mannequin_style.hpp"

#include <glm/vec3.hpp>

namespace raks::render {

/// A solid moved into the bind pose and made ready for many evaluations.
struct PreparedLoft {
    /// Between two stations, as cubics of the length from the first: half width, front, back, shift
    /// to the side, to the front; coefficients from the constant up.
    struct Segment {
        float start;
        std::array<std::array<float, 4>, 5> cubics;
    };
    std::vector<Segment> segments;
    float end = 0.0F;
    glm::vec3 origin{};
    SolidFrame frame{};
    float exponent = 2.0F;
    float cap_start = 1.0F;
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
    explicit BodyField(const BindFrames& frames, MannequinStyle style = {});

    /// Skin. About 0.3 us. Threads: any.
    [[nodiscard]] float distance(glm::vec3 p) const noexcept;
    /// Gradient by four points of a tetrahedron of that size; not normalized.
    [[nodiscard]] glm::vec3 gradient(glm::vec3 p, float step) const noexcept;

    [[nodiscard]] float core(glm::vec3 p) const noexcept;
    [[nodiscard]] float leg(glm::vec3 p) const noexcept;
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

    void add(const Primitive& primitive, const BindFrames& frames, MannequinStyle style);
    static Solid prepare(const Primitive& primitive, const BindFrames& frames);
    static void enclose(SolidGroup& group) noexcept;
    static float solid_distance(const Solid& solid, glm::vec3 p) noexcept;
    /// `distance` with all solids of the group joined to it by smooth minimum, in their order.
    [[nodiscard]] float fold(Group group, glm::vec3 p, float distance) const noexcept;
    [[nodiscard]] float hand(glm::vec3 p) const noexcept;
    [[nodiscard]] const SolidGroup& solids(Group group) const noexcept {
        return groups_[static_cast<std::size_t>(group)];
    }

    std::array<SolidGroup, kGroupCount> groups_;
    glm::vec3 sole_point_{};
    glm::vec3 sole_normal_{};
    glm::vec3 foot_forward_{};
    bool has_arch_;  // under the shoe
};

/// The underside of the dance shoe: flat at heel and ball, arched between. All in the T-pose,
/// metres; `z` from the ankle's column to the toes (heel -0.075, toe tip 0.178).
inline constexpr float kArch = 0.015F;
inline constexpr float kHeelBreast = -0.020F;  // front face of the heel

/// Height of the underside over the floor.
[[nodiscard]] constexpr float sole_height(float z) noexcept {
    return kArch * smoothstep(kHeelBreast - 0.006F, kHeelBreast + 0.008F, z) *
           (1.0F - smoothstep(0.020F, 0.085F, z));
}

/// Height up to which the shoe is sole or heel: a heel of 16 mm, a thin sole in front.
[[nodiscard]] constexpr float sole_top(float z) noexcept {
    constexpr float kHeel = 0.018F;
    constexpr float kSole = 0.006F;
    const float in_front = smoothstep(kHeelBreast - 0.006F, kHeelBreast + 0.010F, z);
    return kHeel + (sole_height(z) + kSole - kHeel) * in_front;
}

}  // namespace raks::render
