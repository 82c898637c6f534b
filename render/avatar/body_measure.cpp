#include "render/avatar/body_measure.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <memory>

#include "base/statistics.hpp"
#include "render/avatar/skinned_mesh.hpp"

#include <glm/geometric.hpp>

namespace raks::render {
namespace {

using motion::Bone;
using motion::index_of;
using motion::Side;

// Fewer points than this measure nothing.
constexpr std::size_t kLeastPoints = 8;
// The skin lies where this share of the points lies farther in. The rest may stand out from it, as
// buckles and pockets do.
constexpr double kSkinShare = 0.9;

glm::vec3 mirrored(glm::vec3 place) noexcept { return {-place.x, place.y, place.z}; }

/// The value, kept between half and 8 times the usual one, and the usual one where it is not
/// finite. (Bodies with short legs and a round trunk reach 5 times.)
float sane(float value, float usual) noexcept {
    return std::isfinite(value) ? std::clamp(value, 0.5F * usual, 8.0F * usual) : usual;
}

/// One body while it is measured. Left and right limbs are measured together.
class Measure {
 public:
    Measure(std::span<const FleshPoint> flesh, const BonePlaces& bones)
        : flesh_(flesh), bones_(bones) {}

    [[nodiscard]] MeasuredBody body();

 private:
    [[nodiscard]] const glm::vec3& place(Bone bone) const noexcept {
        return bones_.places[index_of(bone)];
    }
    [[nodiscard]] float soles() const;
    [[nodiscard]] float top() const;
    void set_offsets(motion::Skeleton& skeleton) const;
    void set_feet(motion::Skeleton& skeleton) const;
    void set_trunk(motion::Girth& girth) const;
    void set_head(motion::Girth& girth) const;
    [[nodiscard]] float limb_radius(Bone upper, Bone lower, float from, float usual) const;
    [[nodiscard]] float hand_radius(float usual) const;
    /// Calls `take(place, bone)` for all flesh of a bone of the left, and for that of the right
    /// mirrored.
    template <typename Take>
    void each_of(Bone left, const Take& take) const;

    std::span<const FleshPoint> flesh_;
    const BonePlaces& bones_;
    float soles_ = 0.0F;
    float pelvis_ = 0.0F;  // its height
    float size_ = 1.0F;    // against the mannequin
};

template <typename Take>
void Measure::each_of(Bone left, const Take& take) const {
    const std::size_t own = index_of(left);
    const std::size_t other = index_of(motion::mirrored(left));
    for (const FleshPoint& point : flesh_) {
        if (point.bone == own) {
            take(point.place - bones_.places[own]);
        } else if (point.bone == other) {
            take(mirrored(point.place - bones_.places[other]));
        }
    }
}

/// The lowest of what the feet move; 0 where that is nothing.
float Measure::soles() const {
    float lowest = std::numeric_limits<float>::max();
    for (const Bone bone : {Bone::left_foot, Bone::left_toes, Bone::right_foot, Bone::right_toes}) {
        for (const FleshPoint& point : flesh_) {
            if (point.bone == index_of(bone)) {
                lowest = std::min(lowest, point.place.y);
            }
        }
    }
    return lowest == std::numeric_limits<float>::max() ? 0.0F : lowest;
}

float Measure::top() const {
    float highest = soles_;
    for (const FleshPoint& point : flesh_) {
        highest = std::max(highest, point.place.y);
    }
    return highest;
}

/// A finger or a toe that the body lacks is where the mannequin has it; any other bone that it
/// lacks lies on the one that it hangs from.
void Measure::set_offsets(motion::Skeleton& skeleton) const {
    std::array<glm::vec3, motion::kBoneCount> places = bones_.places;
    places[0] = {0.0F, place(Bone::hips).y - soles_, 0.0F};
    for (std::size_t i = 1; i < places.size(); ++i) {
        const std::size_t parent = motion::kBoneParents[i];
        const auto bone = static_cast<Bone>(i);
        const Bone left = std::min(bone, motion::mirrored(bone));
        const bool is_tip = left >= Bone::left_thumb_metacarpal || left == Bone::left_toes;
        if (bones_.is_there[i]) {
            places[i] = bones_.places[i] - bones_.places[0] + places[0];
        } else {
            places[i] = is_tip ? places[parent] + skeleton.offsets[i] : places[parent];
        }
        // The mannequin's is used above, before it is overwritten.
        skeleton.offsets[i] = places[i] - places[parent];
    }
    skeleton.offsets[0] = places[0];
}

/// Tip and heel of the soles, from what lies near the floor.
void Measure::set_feet(motion::Skeleton& skeleton) const {
    const float sole = soles_ - place(Bone::left_foot).y;
    for (glm::vec3* const point : {&skeleton.ball, &skeleton.toe_tip, &skeleton.heel}) {
        point->y = sole;
    }
    const float near_floor = sole + 0.03F * size_;
    std::vector<double> ahead;
    std::vector<double> aside;
    const auto take_from = [&](const glm::vec3& from_foot) {
        if (from_foot.y < near_floor) {
            ahead.push_back(static_cast<double>(from_foot.z));
            aside.push_back(static_cast<double>(from_foot.x));
        }
    };
    const glm::vec3 toes_from_foot = place(Bone::left_toes) - place(Bone::left_foot);
    each_of(Bone::left_foot, take_from);
    each_of(Bone::left_toes, [&](const glm::vec3& from) { take_from(from + toes_from_foot); });
    if (ahead.size() >= kLeastPoints) {
        const auto [back, front] = std::minmax_element(ahead.begin(), ahead.end());
        skeleton.heel.z = std::min(static_cast<float>(*back), -0.01F * size_);
        skeleton.toe_tip.z = std::max(static_cast<float>(*front), 0.03F * size_);
        // The edges by most of the sole: its ends are rounded.
        const double width = percentile(aside, kSkinShare) - percentile(aside, 1.0 - kSkinShare);
        skeleton.sole_half = std::min(static_cast<float>(0.5 * width), 0.08F * size_);
        skeleton.toe_tip.x = skeleton.heel.x = static_cast<float>(
            0.5 * (percentile(aside, kSkinShare) + percentile(aside, 1.0 - kSkinShare)));
    }
    const float least_toes = 0.012F * size_;
    glm::vec3& toes = skeleton.offsets[index_of(Bone::left_toes)];
    if (bones_.is_there[index_of(Bone::left_toes)]) {
        skeleton.ball.z = std::min(toes.z, skeleton.toe_tip.z - least_toes);
        skeleton.ball.x = toes.x;
        return;
    }
    // The whole foot is stiff: it turns about its tip.
    skeleton.ball.z = skeleton.toe_tip.z - least_toes;
    toes = {skeleton.ball.x, 0.7F * sole, skeleton.ball.z};
    skeleton.offsets[index_of(Bone::right_toes)] = mirrored(toes);
}

/// The trunk in slices from the pelvis to the upper chest: half its width and depth in each.
void Measure::set_trunk(motion::Girth& girth) const {
    constexpr std::size_t kSlices = 6;
    const float low = pelvis_;
    const float high = place(Bone::upper_chest).y + girth.chest_height;
    // Under the armpits; what lies far beyond the shoulders is none of it.
    const float within = 2.0F * std::abs(place(Bone::left_upper_arm).x);
    std::array<std::vector<double>, kSlices> aside;
    std::array<std::vector<double>, kSlices> ahead;
    for (const FleshPoint& point : flesh_) {
        const glm::vec3 from = point.place - place(Bone::hips);
        const float share = (point.place.y - low) / std::max(high - low, 1e-3F);
        if (point.bone <= index_of(Bone::upper_chest) && share >= 0.0F && share < 1.0F &&
            std::abs(from.x) < within) {
            const auto slice = static_cast<std::size_t>(share * static_cast<float>(kSlices));
            aside[slice].push_back(std::abs(static_cast<double>(from.x)));
            ahead[slice].push_back(static_cast<double>(from.z));
        }
    }
    std::vector<double> widths;
    std::vector<double> fronts;
    std::vector<double> backs;
    for (std::size_t i = 0; i < kSlices; ++i) {
        if (aside[i].size() >= kLeastPoints) {
            widths.push_back(percentile(aside[i], kSkinShare));
            fronts.push_back(percentile(ahead[i], kSkinShare));
            backs.push_back(percentile(ahead[i], 1.0 - kSkinShare));
        }
    }
    if (widths.empty()) {
        return;
    }
    const double front = percentile(fronts, 0.5);
    const double back = percentile(backs, 0.5);
    const float depth = sane(static_cast<float>(0.5 * (front - back)), girth.trunk);
    const float width =
        sane(static_cast<float>(percentile(widths, 0.5)), girth.trunk + girth.flank);
    girth.trunk = std::min(depth, width);
    girth.flank = width - girth.trunk;
    girth.trunk_ahead = static_cast<float>(0.5 * (front + back));
}

void Measure::set_head(motion::Girth& girth) const {
    std::vector<double> aside;
    float highest = 0.0F;
    for (const FleshPoint& point : flesh_) {
        if (point.bone == index_of(Bone::head)) {
            const glm::vec3 from = point.place - place(Bone::head);
            aside.push_back(std::abs(static_cast<double>(from.x)));
            highest = std::max(highest, from.y);
        }
    }
    if (aside.size() >= kLeastPoints) {
        girth.head = sane(static_cast<float>(percentile(aside, kSkinShare)), girth.head);
        girth.head_height = sane(highest - girth.head, girth.head_height);
    }
}

/// The radius of a limb: how far three quarters of a bone's points at most lie from the line to the
/// next joint. Of the way to that joint, the part from `from` to 0.9 is looked at.
float Measure::limb_radius(Bone upper, Bone lower, float from, float usual) const {
    const glm::vec3 line = place(lower) - place(upper);
    const float length = std::max(glm::length(line), 1e-3F);
    std::vector<double> away;
    each_of(upper, [&](const glm::vec3& point) {
        const float along = glm::dot(point, line) / (length * length);
        if (along > from && along < 0.9F) {
            away.push_back(static_cast<double>(glm::length(point - along * line)));
        }
    });
    return away.size() < kLeastPoints ? usual
                                      : sane(static_cast<float>(percentile(away, 0.75)), usual);
}

/// Half the thickness of the palm, which faces the floor.
float Measure::hand_radius(float usual) const {
    std::vector<double> heights;
    each_of(Bone::left_hand,
            [&](const glm::vec3& point) { heights.push_back(static_cast<double>(point.y)); });
    if (heights.size() < kLeastPoints) {
        return usual;
    }
    const double thickness =
        percentile(heights, kSkinShare) - percentile(heights, 1.0 - kSkinShare);
    return sane(static_cast<float>(0.5 * thickness), usual);
}

MeasuredBody Measure::body() {
    soles_ = soles();
    const motion::Skeleton& mannequin = motion::mannequin_skeleton();
    // Steps go by the legs: the hips' joint may lie anywhere in the belly.
    const float legs = std::max(place(Bone::left_upper_leg).y - soles_, 1e-3F);
    size_ = legs / (mannequin.hips_height() + mannequin.offsets[index_of(Bone::left_upper_leg)].y);
    pelvis_ = soles_ + size_ * mannequin.hips_height();
    motion::Skeleton skeleton = motion::scaled(mannequin, size_);
    set_offsets(skeleton);
    set_feet(skeleton);
    motion::Girth& girth = skeleton.girth;
    set_trunk(girth);
    set_head(girth);
    girth.thigh = limb_radius(Bone::left_upper_leg, Bone::left_lower_leg, 0.4F, girth.thigh);
    girth.shin = limb_radius(Bone::left_lower_leg, Bone::left_foot, 0.1F, girth.shin);
    girth.forearm = limb_radius(Bone::left_lower_arm, Bone::left_hand, 0.5F, girth.forearm);
    girth.hand = hand_radius(girth.hand);
    return {.skeleton = skeleton,
            .soles = soles_,
            .height = top() - soles_,
            .pelvis_drop = place(Bone::hips).y - pelvis_};
}

}  // namespace

std::vector<FleshPoint> flesh_of(const Avatar& avatar) {
    motion::Pose t_pose;
    t_pose.hips_position = avatar.skeleton.offsets[0];
    SkinnedMesh mesh(avatar);
    std::unique_ptr<RigState> state;
    if (avatar.rig != nullptr) {
        t_pose.hips_position = avatar.rig->humanoid.rest_hips();
        state = std::make_unique<RigState>(*avatar.rig);
        pose_joints(*avatar.rig, t_pose, 1.0F, *state);
    }
    mesh.set_pose(t_pose, state.get());
    std::vector<FleshPoint> flesh;
    flesh.reserve(mesh.size());
    for (std::size_t i = 0; i < mesh.size(); ++i) {
        flesh.push_back({mesh.place(i), mesh.bone(i)});
    }
    return flesh;
}

MeasuredBody measure_body(std::span<const FleshPoint> flesh, const BonePlaces& bones) {
    return Measure(flesh, bones).body();
}

}  // namespace raks::render
