#include "render/mannequin/body_field.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>

#include "render/mannequin/build_shape.hpp"
#include "render/mannequin/costume_shape.hpp"

#include <glm/geometric.hpp>

namespace raks::render {
namespace {

constexpr float kNothing = std::numeric_limits<float>::max();
constexpr float kFar = 0.06F;  // beyond it a bounding sphere stands for what it holds
// Blend radii, in metres, of the smooth minima that join the groups.
constexpr float kCoreLegBlend = 0.035F;
constexpr float kCoreArmBlend = 0.045F;
constexpr float kArmHandBlend = 0.020F;
constexpr float kPalmFingerBlend = 0.0075F;
constexpr float kPalmThumbBlend = 0.016F;
constexpr float kSoleBlend = 0.008F;

constexpr std::array kFingerGroups = {
    Group::thumb, Group::index, Group::middle, Group::ring, Group::little};

/// Quadratic smooth minimum: equals min(a, b) where they differ by more than k.
float smooth_min(float a, float b, float k) noexcept {
    const float h = std::max(k - std::abs(a - b), 0.0F) / k;
    return std::min(a, b) - h * h * k * 0.25F;
}
/// Smooth maximum of the same radius.
float smooth_max(float a, float b, float k) noexcept { return -smooth_min(-a, -b, k); }

/// Distance to a bounding sphere: at most the distance to what the sphere holds.
float sphere_bound(glm::vec3 p, glm::vec3 center, float radius) noexcept {
    return glm::length(p - center) - radius;
}

/// Coordinates of a world vector in an orthonormal frame.
glm::vec3 to_frame(const SolidFrame& frame, glm::vec3 d) noexcept {
    return {glm::dot(d, frame.side), glm::dot(d, frame.axis), glm::dot(d, frame.front)};
}

/// First-order distance k0 (k0 - 1) / k1 of a scaled sphere.
float distance_to(const Ellipsoid& solid, glm::vec3 p) noexcept {
    const glm::vec3 scaled = to_frame(solid.frame, p - solid.center) / solid.radii;
    const float k0 = glm::length(scaled);
    const float k1 = glm::length(scaled / solid.radii);
    // At the centre the quotient is 0 / 0; the distance there is the smallest radius.
    if (k1 < 1e-9F) {
        return -std::min({solid.radii.x, solid.radii.y, solid.radii.z});
    }
    return k0 * (k0 - 1.0F) / k1;
}

/// Exact distance to the hull of two spheres (Quilez, "Round cone").
float distance_to(const RoundCone& solid, glm::vec3 p) noexcept {
    const glm::vec3 ba = solid.b - solid.a;
    const float l2 = glm::dot(ba, ba);
    const float rr = solid.radius_a - solid.radius_b;
    const float a2 = l2 - rr * rr;
    const float il2 = 1.0F / l2;
    const glm::vec3 pa = p - solid.a;
    // Everything is scaled by the length of the axis, so that only the result needs a square root.
    const float y = glm::dot(pa, ba);
    const float z = y - l2;
    const glm::vec3 across = pa * l2 - ba * y;
    const float x2 = glm::dot(across, across);
    const float y2 = y * y * l2;
    const float z2 = z * z * l2;
    const float k = std::copysign(rr * rr * x2, rr);
    // Beyond the cone's slanted side on either end the nearest point lies on a sphere.
    if (std::copysign(a2 * z2, z) > k) {
        return std::sqrt(x2 + z2) * il2 - solid.radius_b;
    }
    if (std::copysign(a2 * y2, y) < k) {
        return std::sqrt(x2 + y2) * il2 - solid.radius_a;
    }
    return (std::sqrt(x2 * a2 * il2) + y * rr) * il2 - solid.radius_a;
}

/// Horner's scheme.
float cubic(const std::array<float, 4>& c, float u) noexcept {
    return c[0] + u * (c[1] + u * (c[2] + u * c[3]));
}

/// Linear search: a loft has at most 13 segments.
const PreparedLoft::Segment& segment_at(const PreparedLoft& solid, float t) noexcept {
    std::size_t i = 0;
    while (i + 1 < solid.segments.size() && t >= solid.segments[i + 1].start) {
        ++i;
    }
    return solid.segments[i];
}

/// (k0 - 1) / |grad k0| of the superellipse at the nearest station, its slope along the axis
/// ignored; beyond the ends k0 grows with the overshoot over the cap.
float distance_to(const PreparedLoft& solid, glm::vec3 p) noexcept {
    const glm::vec3 local = to_frame(solid.frame, p - solid.origin);
    const float start = solid.segments.front().start;
    const float t = std::clamp(local.y, start, solid.end);
    const PreparedLoft::Segment& segment = segment_at(solid, t);
    const float u = t - segment.start;

    // Half-axes and centre of the cross-section; front and back half have different depths.
    const float width = cubic(segment.cubics[0], u);
    const float to_front = local.z - cubic(segment.cubics[4], u);
    const float depth = cubic(segment.cubics[to_front >= 0.0F ? 1 : 2], u);
    const float x = std::abs(local.x - cubic(segment.cubics[3], u)) / width;
    const float z = std::abs(to_front) / depth;
    const float overshoot = local.y - t;
    const float cap = overshoot < 0.0F ? solid.cap_start : solid.cap_end;
    const float e = std::abs(overshoot) / cap;

    // q is the superellipse norm of (x, z): 1 on the profile. Most solids are ellipses, which need
    // no power function.
    const float n = solid.exponent;
    const bool is_ellipse = n == 2.0F;
    const float xn = is_ellipse ? x * x : std::pow(x, n);
    const float zn = is_ellipse ? z * z : std::pow(z, n);
    const float qn = xn + zn;
    const float q = is_ellipse ? std::sqrt(qn) : std::pow(qn, 1.0F / n);
    const float k0 = std::sqrt(q * q + e * e);
    if (k0 < 1e-4F) {
        return -std::min(width, depth);
    }
    // Gradient of k0 by the chain rule; the guards stand for 0 / 0 on the axes, where the term is
    // 0.
    const float dq = q < 1e-6F ? 0.0F : q / k0;
    const float share_x = x < 1e-6F ? 0.0F : xn / qn * (q / x);
    const float share_z = z < 1e-6F ? 0.0F : zn / qn * (q / z);
    const glm::vec3 slope{dq * share_x / width, dq * share_z / depth, e / k0 / cap};
    return (k0 - 1.0F) / glm::length(slope);
}

/// Slope of one column at a station by finite differences, one-sided at the ends.
float slope(std::span<const Station> stations, std::size_t i, float Station::*column) noexcept {
    const Station& before = stations[i == 0 ? 0 : i - 1];
    const Station& after = stations[std::min(i + 1, stations.size() - 1)];
    return (after.*column - before.*column) / (after.t - before.t);
}

/// Cubic Hermite interpolation of the five columns between station i and i + 1.
PreparedLoft::Segment prepare_segment(std::span<const Station> stations, std::size_t i) noexcept {
    constexpr std::array kColumns = {&Station::half_width,
                                     &Station::half_front,
                                     &Station::half_back,
                                     &Station::shift_side,
                                     &Station::shift_front};
    PreparedLoft::Segment segment{.start = stations[i].t, .cubics = {}};
    const float length = stations[i + 1].t - stations[i].t;
    for (std::size_t c = 0; c < kColumns.size(); ++c) {
        const float v0 = stations[i].*kColumns[c];
        const float v1 = stations[i + 1].*kColumns[c];
        const float m0 = slope(stations, i, kColumns[c]);
        const float m1 = slope(stations, i + 1, kColumns[c]);
        const float chord = (v1 - v0) / length;
        segment.cubics[c] = {v0,
                             m0,
                             (3.0F * chord - 2.0F * m0 - m1) / length,
                             (m0 + m1 - 2.0F * chord) / (length * length)};
    }
    return segment;
}

/// Turns a solid's axes with its bone from the T-pose into the bind pose.
SolidFrame ride(const SolidFrame& frame, motion::Bone bone, const BindFrames& frames) noexcept {
    return {frames.direction(bone, frame.side),
            frames.direction(bone, frame.axis),
            frames.direction(bone, frame.front)};
}

/// A loft in the bind pose, its columns turned into cubics once instead of at every evaluation.
PreparedLoft ride(const Loft& loft, motion::Bone bone, const BindFrames& frames) {
    PreparedLoft prepared;
    for (std::size_t i = 0; i + 1 < loft.stations.size(); ++i) {
        prepared.segments.push_back(prepare_segment(loft.stations, i));
    }
    prepared.end = loft.stations.back().t;
    prepared.origin = frames.point(bone, loft.origin);
    prepared.frame = ride(loft.frame, bone, frames);
    prepared.exponent = loft.exponent;
    prepared.cap_start = loft.cap_start;
    prepared.cap_end = loft.cap_end;
    return prepared;
}

/// Radius about the middle of the axis that holds every station and both caps.
float loft_radius(const Loft& loft, float middle) noexcept {
    constexpr float kSquareMargin = 1.15F;  // corners of a superellipse, overshoot of the cubics
    float radius = 0.0F;
    for (const Station& s : loft.stations) {
        const float across = kSquareMargin * std::max({s.half_width, s.half_front, s.half_back}) +
                             std::hypot(s.shift_side, s.shift_front);
        const float cap = &s == &loft.stations.front()  ? loft.cap_start
                          : &s == &loft.stations.back() ? loft.cap_end
                                                        : 0.0F;
        radius = std::max(radius, std::hypot(std::abs(s.t - middle) + cap, across));
    }
    return radius;
}

}  // namespace

/// Moves a solid into the bind pose and gives it a bounding sphere.
BodyField::Solid BodyField::prepare(const Primitive& primitive, const BindFrames& frames) {
    Solid solid;
    solid.blend = primitive.blend;
    solid.fold = primitive.fold;
    const motion::Bone bone = primitive.bone;
    if (const auto* loft = std::get_if<Loft>(&primitive.shape)) {
        PreparedLoft prepared = ride(*loft, bone, frames);
        const float middle = 0.5F * (loft->stations.front().t + loft->stations.back().t);
        solid.sphere_center = prepared.origin + prepared.frame.axis * middle;
        solid.sphere_radius = loft_radius(*loft, middle);
        solid.shape = std::move(prepared);
    } else if (const auto* cone = std::get_if<RoundCone>(&primitive.shape)) {
        RoundCone moved = *cone;
        moved.a = frames.point(bone, cone->a);
        moved.b = frames.point(bone, cone->b);
        solid.sphere_center = 0.5F * (moved.a + moved.b);
        solid.sphere_radius =
            0.5F * glm::length(moved.b - moved.a) + std::max(moved.radius_a, moved.radius_b);
        solid.shape = moved;
    } else {
        Ellipsoid moved = std::get<Ellipsoid>(primitive.shape);
        moved.center = frames.point(bone, moved.center);
        moved.frame = ride(moved.frame, bone, frames);
        solid.sphere_center = moved.center;
        solid.sphere_radius = std::max({moved.radii.x, moved.radii.y, moved.radii.z});
        solid.shape = moved;
    }
    return solid;
}

/// Bounding sphere of a group, about the middle of the box that holds its solids' sphere centres.
void BodyField::enclose(SolidGroup& group) noexcept {
    glm::vec3 low{std::numeric_limits<float>::max()};
    glm::vec3 high{std::numeric_limits<float>::lowest()};
    for (const Solid& solid : group.solids) {
        low = glm::min(low, solid.sphere_center);
        high = glm::max(high, solid.sphere_center);
    }
    group.sphere_center = 0.5F * (low + high);
    for (const Solid& solid : group.solids) {
        const float reach =
            glm::length(solid.sphere_center - group.sphere_center) + solid.sphere_radius;
        group.sphere_radius = std::max(group.sphere_radius, reach);
    }
}

void BodyField::add(const Primitive& primitive, const BindFrames& frames, MannequinStyle style) {
    std::optional<ShapedPrimitive> made = shaped(primitive, style);
    if (!made) {
        return;
    }
    if (!made->stations.empty()) {
        std::get<Loft>(made->primitive.shape).stations = made->stations;
    }
    groups_[static_cast<std::size_t>(primitive.group)].solids.push_back(
        prepare(made->primitive, frames));
}

BodyField::BodyField(const BindFrames& frames, MannequinStyle style)
    : has_arch_(has_arch(style.costume)) {
    for (const auto part :
         {trunk_primitives(), head_primitives(), leg_primitives(), arm_primitives()}) {
        for (const Primitive& primitive : part) {
            add(primitive, frames, style);
        }
    }
    for (const Primitive& primitive : costume_primitives(style.costume)) {
        add(primitive, frames, style);
    }
    for (SolidGroup& group : groups_) {
        enclose(group);
    }
    // The sole is given in the foot bone's frame: the T-pose's origin, which lies on the floor, and
    // the T-pose's axes ride on the foot.
    sole_point_ = frames.point(motion::Bone::left_foot, glm::vec3{0.0F});
    foot_forward_ = frames.direction(motion::Bone::left_foot, {0.0F, 0.0F, 1.0F});
    sole_normal_ = frames.direction(motion::Bone::left_foot, {0.0F, 1.0F, 0.0F});
}

float BodyField::solid_distance(const Solid& solid, glm::vec3 p) noexcept {
    if (const auto* loft = std::get_if<PreparedLoft>(&solid.shape)) {
        return distance_to(*loft, p);
    }
    if (const auto* cone = std::get_if<RoundCone>(&solid.shape)) {
        return distance_to(*cone, p);
    }
    const auto* ellipsoid = std::get_if<Ellipsoid>(&solid.shape);
    return ellipsoid != nullptr ? distance_to(*ellipsoid, p) : kNothing;
}

float BodyField::fold(Group group, glm::vec3 p, float distance) const noexcept {
    for (const Solid& solid : solids(group).solids) {
        // A solid farther away than `distance` by its blend radius changes nothing: skip it.
        const float bound = sphere_bound(p, solid.sphere_center, solid.sphere_radius);
        if (bound < distance + solid.blend) {
            const float own = bound > kFar ? bound : solid_distance(solid, p);
            distance = smooth_min(distance, own, solid.blend);
        }
        // The mirror image of a solid at p is the solid itself at the mirror image of p.
        const glm::vec3 image{-p.x, p.y, p.z};
        if (solid.fold == Fold::both_sides &&
            sphere_bound(image, solid.sphere_center, solid.sphere_radius) <
                distance + solid.blend) {
            distance = smooth_min(distance, solid_distance(solid, image), solid.blend);
        }
    }
    return distance;
}

/// Trunk and head: joined solids, minus the carved ones, plus the details.
float BodyField::core(glm::vec3 p) const noexcept {
    p.x = std::abs(p.x);
    const SolidGroup& group = solids(Group::core);
    const float bound = sphere_bound(p, group.sphere_center, group.sphere_radius);
    if (bound > kFar) {
        return bound;
    }
    float distance = fold(Group::core, p, kNothing);
    // A carved solid subtracts: maximum with its negated distance. That is at most -`away`, so a
    // carve whose sphere is farther than that changes nothing.
    for (const Solid& carve : solids(Group::carve).solids) {
        const float away = sphere_bound(p, carve.sphere_center, carve.sphere_radius);
        if (-away + carve.blend > distance) {
            distance = smooth_max(distance, -solid_distance(carve, p), carve.blend);
        }
    }
    return fold(Group::detail, p, distance);
}

float BodyField::leg(glm::vec3 p) const noexcept {
    p.x = std::abs(p.x);
    const SolidGroup& group = solids(Group::leg);
    const float bound = sphere_bound(p, group.sphere_center, group.sphere_radius);
    if (bound > kFar) {
        return bound;
    }
    // Height over the sole's underside; the smooth maximum cuts the foot off below it.
    const glm::vec3 from_sole = p - sole_point_;
    const float below_sole = (has_arch_ ? sole_height(glm::dot(from_sole, foot_forward_)) : 0.0F) -
                             glm::dot(from_sole, sole_normal_);
    return smooth_max(fold(Group::leg, p, kNothing), below_sole, kSoleBlend);
}

float BodyField::finger(Group finger, glm::vec3 p) const noexcept {
    p.x = std::abs(p.x);
    const SolidGroup& group = solids(finger);
    const float bound = sphere_bound(p, group.sphere_center, group.sphere_radius);
    return bound > kFar ? bound : fold(finger, p, kNothing);
}

/// Each finger is joined with the palm alone, then the plain minimum taken: this leaves clefts
/// between the fingers, where a common smooth minimum would web them.
float BodyField::hand(glm::vec3 p) const noexcept {
    const float palm = fold(Group::palm, p, kNothing);
    float distance = palm;
    for (const Group group : kFingerGroups) {
        const float blend = group == Group::thumb ? kPalmThumbBlend : kPalmFingerBlend;
        distance = std::min(distance, smooth_min(palm, finger(group, p), blend));
    }
    return distance;
}

float BodyField::arm(glm::vec3 p) const noexcept {
    p.x = std::abs(p.x);
    const SolidGroup& upper = solids(Group::arm);
    const SolidGroup& palm = solids(Group::palm);
    constexpr float kFingerReach = 0.13F;  // from the palm's sphere to the farthest fingertip
    const float arm_bound = sphere_bound(p, upper.sphere_center, upper.sphere_radius);
    // The hand is looked at only where it can reach into the blend with the arm.
    const float hand_bound = sphere_bound(p, palm.sphere_center, palm.sphere_radius + kFingerReach);
    const float bare = arm_bound > kFar ? arm_bound : fold(Group::arm, p, kNothing);
    if (hand_bound > bare + kArmHandBlend) {
        return bare;
    }
    return smooth_min(bare, hand_bound > kFar ? hand_bound : hand(p), kArmHandBlend);
}

/// The plain minimum at the end keeps arm and leg from blending with each other.
float BodyField::distance(glm::vec3 p) const noexcept {
    const float trunk = core(p);
    float distance = trunk;
    distance = std::min(distance, smooth_min(trunk, leg(p), kCoreLegBlend));
    distance = std::min(distance, smooth_min(trunk, arm(p), kCoreArmBlend));
    return distance;
}

// Four evaluations instead of the six of central differences along the axes.
glm::vec3 BodyField::gradient(glm::vec3 p, float step) const noexcept {
    constexpr std::array<glm::vec3, 4> kCorners = {{
        {1.0F, -1.0F, -1.0F},
        {-1.0F, -1.0F, 1.0F},
        {-1.0F, 1.0F, -1.0F},
        {1.0F, 1.0F, 1.0F},
    }};
    glm::vec3 sum{0.0F};
    for (const glm::vec3& corner : kCorners) {
        sum += corner * distance(p + step * corner);
    }
    return sum / (4.0F * step);
}

}  // namespace raks::render
