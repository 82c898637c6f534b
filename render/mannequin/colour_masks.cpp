#include "render/mannequin/colour_masks.hpp"

#include <algorithm>
#include <array>
#include <cmath>

#include "base/smooth_steps.hpp"
#include "render/mannequin/body_field.hpp"
#include "render/mannequin/costume_shape.hpp"

#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <glm/vec2.hpp>

namespace raks::render {
namespace {

using motion::Bone;

constexpr glm::vec3 kEar{0.0765F, 1.5870F, -0.0130F};  // as in head_primitives.cpp
constexpr float kHipHeight = 0.86F;     // metres: above, the trunk's rules hold; below, the leg's
constexpr float kAnkleZ = -0.022F;      // of the foot bone in T-pose
constexpr float kAnkleHeight = 0.078F;  // of the foot bone over the sole
constexpr float kFlatSole = 0.024F;     // metres that a sole without a heel is high
constexpr float kStripeEdge = 0.2F * kMaskRange;  // as in materials.glsl

/// Linear interpolation.
float mix(float a, float b, float t) noexcept { return a + (b - a) * t; }

/// Point of the segment a..b nearest to p.
glm::vec3 nearest_on_segment(glm::vec3 p, glm::vec3 a, glm::vec3 b) noexcept {
    const glm::vec3 ab = b - a;
    return a + ab * std::clamp(glm::dot(p - a, ab) / glm::dot(ab, ab), 0.0F, 1.0F);
}

/// First-order distance to the edge of an ellipse about the origin, positive inside.
float within_ellipse(glm::vec2 p, glm::vec2 radii) noexcept {
    const glm::vec2 scaled = p / radii;
    const float length = std::max(glm::length(scaled), 1e-4F);
    return (1.0F - length) * length / std::max(glm::length(scaled / radii), 1e-4F);
}

/// Positive between two planes, each given by a point and a normal from the first to the second.
float between(
    glm::vec3 p, glm::vec3 from, glm::vec3 n_from, glm::vec3 to, glm::vec3 n_to) noexcept {
    return std::min(glm::dot(p - from, glm::normalize(n_from)),
                    glm::dot(to - p, glm::normalize(n_to)));
}

/// Where the leg of tights or trousers ends, metres below the knee: tights and trousers that are
/// tied above the ankle, others on the shoe.
float leg_length(MannequinStyle style) noexcept {
    if (style.costume == Costume::oriental) {
        return 0.355F;
    }
    const bool is_wide = style.costume == Costume::street || style.build == MannequinBuild::lead;
    return is_wide ? 0.372F : 0.335F;
}

}  // namespace

ColourMasks::ColourMasks(const BodyField& field,
                         const BindFrames& frames,
                         MannequinStyle style) noexcept
    : field_(field),
      style_(style),
      below_knee_(leg_length(style)),
      shoulder_(frames.joint(Bone::left_upper_arm)),
      elbow_(frames.joint(Bone::left_lower_arm)),
      wrist_(frames.joint(Bone::left_hand)),
      hip_(frames.joint(Bone::left_upper_leg)),
      knee_(frames.joint(Bone::left_lower_leg)),
      ankle_(frames.joint(Bone::left_foot)),
      along_upper_arm_(glm::normalize(elbow_ - shoulder_)),
      along_forearm_(glm::normalize(wrist_ - elbow_)),
      along_thigh_(glm::normalize(knee_ - hip_)),
      along_shank_(glm::normalize(ankle_ - knee_)),
      along_hand_(frames.direction(Bone::left_hand, {1.0F, 0.0F, 0.0F})),
      foot_from_world_(glm::conjugate(frames.bind().rotation(Bone::left_foot))) {}

/// Outside of an ellipse about the neck's root: deep in front, high behind.
float ColourMasks::neckline(glm::vec3 p) noexcept {
    // The ellipse is twice as deep at the front of the neck as behind it.
    const float half_height = mix(0.060F, 0.118F, smoothstep(-0.06F, 0.04F, p.z));
    const float inside = within_ellipse({p.x, p.y - 1.440F}, {0.072F, half_height});
    // A slanted plane over it ends the suit on the shoulders: nothing of the suit on neck and head.
    return std::min(-inside, 1.452F - p.y + 0.3F * p.x);
}

/// A collar: round the neck, higher behind than in front.
float ColourMasks::collar(glm::vec3 p) noexcept {
    return 1.446F - p.y - 0.30F * (p.z + 0.03F) + 0.15F * p.x;
}

/// Grows where the arm is farther than the rest of the body: there it wins over a plane across the
/// arm, which goes on through the trunk.
float ColourMasks::off_arm(glm::vec3 p) const noexcept {
    const float other = std::min(field_.core(p), field_.leg(p));
    const float off = std::max(0.0F, field_.arm(p) - other - 0.004F);
    return 1.6F * off + 300.0F * off * off;
}

/// Positive where trunk or leg is nearer than the arm: what hangs beside them is not meant.
float ColourMasks::beside_arm(glm::vec3 p) const noexcept {
    return 20.0F * (field_.arm(p) - std::min(field_.core(p), field_.leg(p)));
}

/// Its edge runs round the arm where arm and trunk are apart, `length` metres from the shoulder.
float ColourMasks::cap_sleeve(glm::vec3 p, float length) const noexcept {
    const glm::vec3 along = glm::normalize(along_upper_arm_ + glm::vec3{0.10F, 0.0F, 0.0F});
    return length - glm::dot(p - shoulder_, along) + off_arm(p);
}

/// Of what has no sleeve: the edge runs where the arm grows out of the trunk.
float ColourMasks::armhole(glm::vec3 p) const noexcept {
    constexpr float kOntoArm = 0.010F;
    return 0.5F * (field_.arm(p) - field_.core(p)) + kOntoArm;
}

/// Its edge runs round the forearm, so many metres from the elbow.
float ColourMasks::long_sleeve(glm::vec3 p, float along_forearm) const noexcept {
    return glm::dot(elbow_ + along_forearm * along_forearm_ - p, along_forearm_) + off_arm(p);
}

/// End of the trouser leg: a plane across the shank; above the knee always inside.
float ColourMasks::leg_end(glm::vec3 p) const noexcept {
    if (p.y >= 0.8F) {
        return 0.05F;
    }
    return glm::dot(knee_ + below_knee_ * along_shank_ - p, along_shank_);
}

/// From the nearest point of the line hip - knee - ankle.
glm::vec3 ColourMasks::from_leg_line(glm::vec3 p) const noexcept {
    const glm::vec3 thigh = p - nearest_on_segment(p, hip_, knee_);
    const glm::vec3 shank = p - nearest_on_segment(p, knee_, ankle_);
    return glm::dot(thigh, thigh) < glm::dot(shank, shank) ? thigh : shank;
}

/// Skin that hair grows on: a plane from the forehead down to the ear leaves the face free, a
/// second one the nape; their corner in front of the ear is rounded.
float ColourMasks::hair(glm::vec3 p) noexcept {
    constexpr float kCorner = 0.030F;
    const glm::vec3 forehead{0.0F, 1.668F, 0.075F};
    const glm::vec3 up_and_back{0.0F, 0.440F, -0.898F};
    // A notch in the hairline at the middle of the forehead.
    const float parting = 0.009F * (1.0F - smoothstep(0.0F, 0.030F, p.x));
    const float cap = glm::dot(p - forehead, up_and_back) + 1.2F * p.x * p.x - parting;
    const float nape = p.y - 1.533F - 0.25F * std::max(0.0F, p.z + 0.06F);
    // Quadratic smooth minimum of the two planes, as in body_field.cpp.
    const float h = std::max(kCorner - std::abs(cap - nape), 0.0F) / kCorner;
    const float drawn_back = std::min(cap, nape) - 0.25F * kCorner * h * h;
    // Before the ear it ends at the ear's middle; ears are bare.
    const float side = std::max(p.y - 1.588F, -0.026F - p.z);
    const float off_ear = glm::length((p - kEar) / glm::vec3{1.0F, 1.0F, 0.75F}) - 0.037F;
    return std::min({drawn_back, side, off_ear});
}

/// Upper edge of the shoe: higher at the heel, lower toward the toes. `foot`: from the ankle, in
/// the foot bone's frame.
float ColourMasks::shoe(glm::vec3 foot) noexcept {
    const float height = foot.y + kAnkleHeight;
    return 0.052F + 0.018F * smoothstep(0.06F, -0.04F, foot.z) -
           0.022F * smoothstep(0.0F, 0.07F, foot.z) - height;
}

/// Joint bands of the plain mannequin: the skin between two planes, at elbow, wrist, knee, ankle,
/// waist and neck.
float ColourMasks::bands(glm::vec3 p) const noexcept {
    const auto ring = [&](glm::vec3 joint, glm::vec3 n1, float before, glm::vec3 n2, float after) {
        // Only near the joint: the planes go on through the whole body.
        const float near = 0.11F - glm::length(p - joint);
        return std::min(near, between(p, joint - before * n1, n1, joint + after * n2, n2));
    };
    const float limbs = std::max({
        ring(elbow_, along_upper_arm_, 0.028F, along_forearm_, 0.028F),
        ring(wrist_, along_forearm_, 0.016F, along_hand_, 0.004F),
        ring(knee_, along_thigh_, 0.040F, along_shank_, 0.040F),
        ring(ankle_, along_shank_, 0.034F, along_shank_, -0.012F),
    });
    const float waist = std::min(0.22F - p.x,
                                 between(p,
                                         {0.0F, 1.005F, 0.0F},
                                         {0.0F, 1.0F, 0.10F},
                                         {0.0F, 1.085F, 0.0F},
                                         {0.0F, 1.0F, -0.12F}));
    const float neck = std::min(0.12F - p.x,
                                between(p,
                                        {0.0F, 1.428F, -0.02F},
                                        {0.0F, 1.0F, 0.30F},
                                        {0.0F, 1.500F, -0.01F},
                                        {0.0F, 1.0F, 0.30F}));
    // Positive where the trunk is nearer: the waist's band must not colour an arm beside it.
    const float arm_beside_waist = 20.0F * (field_.arm(p) - field_.core(p));
    return std::max({limbs, std::min(waist, arm_beside_waist), neck});
}

float ColourMasks::unitard(glm::vec3 p) const noexcept {
    constexpr float kLength = 0.088F;
    return std::min({neckline(p), cap_sleeve(p, kLength), leg_end(p)});
}

/// Hoodie or coat, and trousers.
float ColourMasks::sleeved(glm::vec3 p) const noexcept {
    const float sleeve = style_.costume == Costume::street ? 0.228F : 0.203F;
    return std::min({collar(p), long_sleeve(p, sleeve), leg_end(p)});
}

/// A top without sleeves, and trousers from the hips down.
float ColourMasks::two_pieces(glm::vec3 p) const noexcept {
    const float top = std::min({neckline(p), armhole(p), p.y - 1.178F});
    const float waist = 0.945F - p.y - 0.20F * p.z;
    return std::max(top, std::min({waist, leg_end(p), beside_arm(p)}));
}

float ColourMasks::suit(glm::vec3 p) const noexcept {
    switch (style_.costume) {
        case Costume::unitard:
            return unitard(p);
        case Costume::street:
            return sleeved(p);
        case Costume::oriental:
            return two_pieces(p);
        case Costume::ballroom:
            break;
    }
    return style_.build == MannequinBuild::lead ? sleeved(p)
                                                : std::min({neckline(p), armhole(p), leg_end(p)});
}

/// What is of another cloth than the rest of the suit: the trousers under a hoodie; the shirt that
/// a coat shows.
float ColourMasks::second_cloth(glm::vec3 p) const noexcept {
    if (style_.costume == Costume::street) {
        return std::min(0.846F - p.y, beside_arm(p));
    }
    if (has_coat(style_)) {
        // A wedge from the waist to the shoulders, and a band round the neck.
        const float front =
            std::min({0.006F + 0.19F * (p.y - 1.06F) - p.x, p.z + 0.01F, p.y - 1.06F});
        return std::max(front, p.y + 0.30F * (p.z + 0.03F) - 1.418F);
    }
    return -kMaskRange;
}

std::array<float, kMaskCount> ColourMasks::at(glm::vec3 p) const noexcept {
    const glm::vec3 off_leg = from_leg_line(p);
    // The shoe is given in the foot's own frame, which is turned in the bind pose.
    const glm::vec3 foot = foot_from_world_ * (p - ankle_);
    const bool has_shoes = style_.costume != Costume::oriental;
    // Of a sneaker, and of a sock, it is under the trousers.
    const bool is_high = style_.costume == Costume::street || has_coat(style_);
    const float upper = is_high ? 0.125F - (foot.y + kAnkleHeight) : shoe(foot);
    const float shoe_edge = has_shoes ? upper : -kMaskRange;

    std::array<float, kMaskCount> masks{};
    const auto set = [&](AvatarMask mask, float value) {
        masks[static_cast<std::size_t>(mask)] = value;
    };
    set(AvatarMask::suit, suit(p));
    if (style_.costume == Costume::unitard) {
        // The stripe follows the side of the trunk above the hip and the leg's own line below.
        const float stripe_shift = mix(-0.009F, -0.012F, smoothstep(0.76F, kHipHeight, p.y));
        set(AvatarMask::stripe, p.y > kHipHeight ? p.z + 0.012F : off_leg.z - stripe_shift);
        set(AvatarMask::outer, p.y > kHipHeight ? p.x - 0.06F : off_leg.x);
    } else {
        // As wide as a stripe is where it begins.
        set(AvatarMask::stripe, std::max(kStripeEdge - second_cloth(p), 0.0F));
        set(AvatarMask::outer, kMaskRange);
    }
    set(AvatarMask::hair, hair(p));
    set(AvatarMask::shoe, shoe_edge);
    const float upper_edge = has_arch(style_.costume) ? sole_top(foot.z + kAnkleZ) : kFlatSole;
    const float sole = upper_edge - (foot.y + kAnkleHeight);
    set(AvatarMask::accent, std::min(shoe_edge, sole));
    set(AvatarMask::band, bands(p));
    return masks;
}

}  // namespace raks::render
