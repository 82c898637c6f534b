#include "motion/capture/markerless/keypoint_markers.hpp"

#include <array>
#include <string>

#include "motion/skeleton/skeleton.hpp"

namespace raks::capture {
namespace {

using motion::Bone;

constexpr std::array<BodyPoint, 23> kFollowed = {BodyPoint::nose,
                                                 BodyPoint::left_ear,
                                                 BodyPoint::right_ear,
                                                 BodyPoint::left_shoulder,
                                                 BodyPoint::right_shoulder,
                                                 BodyPoint::left_elbow,
                                                 BodyPoint::right_elbow,
                                                 BodyPoint::left_wrist,
                                                 BodyPoint::right_wrist,
                                                 BodyPoint::left_pinky,
                                                 BodyPoint::right_pinky,
                                                 BodyPoint::left_index,
                                                 BodyPoint::right_index,
                                                 BodyPoint::left_hip,
                                                 BodyPoint::right_hip,
                                                 BodyPoint::left_knee,
                                                 BodyPoint::right_knee,
                                                 BodyPoint::left_ankle,
                                                 BodyPoint::right_ankle,
                                                 BodyPoint::left_heel,
                                                 BodyPoint::right_heel,
                                                 BodyPoint::left_foot_index,
                                                 BodyPoint::right_foot_index};

// Skin over the sole where heel and toes are seen, metres.
constexpr float kOverSole = 0.02F;

/// A keypoint of the left side or the middle on the mannequin: its bone, and where on it.
struct OnBody {
    Bone bone;
    glm::vec3 place;
};

OnBody on_left(BodyPoint point) {
    const motion::Skeleton& body = motion::mannequin_skeleton();
    // A joint that two bones share is fixed to the one before it, which keeps still when the other
    // turns.
    const auto joint = [&body](Bone before, Bone bone) {
        return OnBody{before, body.offsets[motion::index_of(bone)]};
    };
    switch (point) {
        case BodyPoint::nose:
            return {Bone::head, {0.0F, 0.085F, 0.115F}};
        case BodyPoint::left_ear:
            return {Bone::head, {0.075F, 0.10F, 0.01F}};
        case BodyPoint::left_shoulder:
            return joint(Bone::left_shoulder, Bone::left_upper_arm);
        case BodyPoint::left_elbow:
            return joint(Bone::left_upper_arm, Bone::left_lower_arm);
        case BodyPoint::left_wrist:
            return joint(Bone::left_lower_arm, Bone::left_hand);
        case BodyPoint::left_pinky:
            return joint(Bone::left_hand, Bone::left_little_proximal);
        case BodyPoint::left_index:
            return joint(Bone::left_hand, Bone::left_index_proximal);
        case BodyPoint::left_hip:
            return joint(Bone::hips, Bone::left_upper_leg);
        case BodyPoint::left_knee:
            return joint(Bone::left_upper_leg, Bone::left_lower_leg);
        case BodyPoint::left_ankle:
            return joint(Bone::left_lower_leg, Bone::left_foot);
        case BodyPoint::left_heel:
            return {Bone::left_foot, body.heel + glm::vec3(0.0F, kOverSole, 0.0F)};
        default:  // the toes
            return {Bone::left_foot,
                    0.5F * (body.ball + body.toe_tip) + glm::vec3(0.0F, kOverSole, 0.0F)};
    }
}

// From there to where networks take a point of the left side to be, in its bone's frame: hips are
// lower than a skeleton's, knees behind them. Means of four takes of salsa and belly dance; no take
// was off by more than 15 mm along an axis.
glm::vec3 seen_off(BodyPoint left) {
    switch (left) {
        case BodyPoint::left_ear:
            return {-0.015F, -0.015F, 0.017F};
        case BodyPoint::left_shoulder:
            return {0.017F, 0.014F, 0.003F};
        case BodyPoint::left_elbow:
            return {0.0F, -0.007F, -0.009F};
        case BodyPoint::left_wrist:
            return {-0.004F, -0.011F, -0.015F};
        case BodyPoint::left_pinky:
            return {-0.013F, -0.007F, 0.003F};
        case BodyPoint::left_index:
            return {-0.011F, -0.009F, -0.026F};
        case BodyPoint::left_hip:
            return {0.010F, -0.011F, 0.010F};
        case BodyPoint::left_knee:
            return {0.012F, 0.005F, -0.014F};
        case BodyPoint::left_ankle:
            return {0.007F, 0.021F, 0.008F};
        default:
            return {};
    }
}

bool is_right(BodyPoint point) { return name_of(point).substr(0, 5) == "right"; }

// All followed points on their bones, each moved by `off` of its left one.
MarkerSet set_of(glm::vec3 (*off)(BodyPoint left)) {
    MarkerSet set;
    for (const BodyPoint point : kFollowed) {
        const BodyPoint left_point = is_right(point) ? other_side(point) : point;
        const OnBody left = on_left(left_point);
        const glm::vec3 place = left.place + off(left_point);
        Marker marker;
        marker.name = name_of(point);
        marker.colour = "keypoint";
        marker.bone = is_right(point) ? motion::mirrored(left.bone) : left.bone;
        marker.place = {is_right(point) ? -place.x : place.x, place.y, place.z};
        set.markers.push_back(std::move(marker));
    }
    return set;
}

}  // namespace

std::span<const BodyPoint> followed_points() noexcept { return kFollowed; }

BodyPoint other_side(BodyPoint point) noexcept {
    const auto index = static_cast<std::size_t>(point);
    if (point == BodyPoint::nose) {
        return point;
    }
    // Eyes have three points a side, all others follow as left, right.
    if (index <= static_cast<std::size_t>(BodyPoint::right_eye_outer)) {
        return static_cast<BodyPoint>(index <= 3 ? index + 3 : index - 3);
    }
    return static_cast<BodyPoint>(index % 2 == 1 ? index + 1 : index - 1);
}

MarkerSet keypoint_markers() {
    return set_of([](BodyPoint) { return glm::vec3(0.0F); });
}

MarkerSet network_markers() { return set_of(seen_off); }

}  // namespace raks::capture
