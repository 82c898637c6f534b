#include "engine/trials/avatar_measures.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <limits>
#include <memory>
#include <numbers>
#include <utility>
#include <vector>

#include "base/statistics.hpp"
#include "engine/trials/mirror_mates.hpp"
#include "engine/trials/trunk_profile.hpp"
#include "render/avatar/avatar_rig.hpp"
#include "render/avatar/skinned_mesh.hpp"

#include <glm/geometric.hpp>

namespace raks::engine {
namespace {

using motion::Bone;
using motion::index_of;
using motion::Side;

constexpr double kNearFloor = 0.01;    // metres
constexpr float kInside = 0.02F;       // metres; a hand deeper than that is seen
constexpr float kTailInside = 0.005F;  // metres
constexpr double kPicturesPerSecond = 10.0;
constexpr std::size_t kMirroredPoses = 24;
constexpr double kMirroredShare = 0.99;

/// The T-pose of the avatar's own body.
motion::Pose t_pose_of(const render::Avatar& avatar) {
    motion::Pose pose;
    pose.hips_position = avatar.skeleton.offsets[0];
    return pose;
}

/// How often a triangle was so many times as large as at rest.
class AreaRatios {
 public:
    void add(float ratio) noexcept {
        const float bin = std::clamp(ratio * kPerOne, 0.0F, static_cast<float>(kBins - 1));
        ++counts_[static_cast<std::size_t>(bin)];
        ++total_;
    }
    /// The ratio that `share` of all lie below; at most that of the last bin.
    [[nodiscard]] double percentile(double share) const noexcept {
        auto left = static_cast<double>(total_) * share;
        for (std::size_t i = 0; i < kBins; ++i) {
            left -= static_cast<double>(counts_[i]);
            if (left < 0.0) {
                return (static_cast<double>(i) + 0.5) / static_cast<double>(kPerOne);
            }
        }
        return static_cast<double>(kBins) / static_cast<double>(kPerOne);
    }

 private:
    static constexpr float kPerOne = 100.0F;
    static constexpr std::size_t kBins = 5'000;  // 50 times as large
    std::vector<std::uint64_t> counts_ = std::vector<std::uint64_t>(kBins, 0);
    std::uint64_t total_ = 0;
};

/// The avatar in one pose after the other.
class AvatarTrial {
 public:
    explicit AvatarTrial(const render::Avatar& avatar);

    [[nodiscard]] AvatarMeasures measure(std::span<const motion::Pose> poses, double rate);

 private:
    void wear(const motion::Pose& pose, render::RigState* state);
    void swing(std::span<const motion::Pose> poses, double rate, std::size_t at);
    void look_at_feet(const motion::Pose& pose);
    void look_at_tails(double seconds);
    void look_at_skin();
    void look_at_hands(const motion::Pose& pose);
    [[nodiscard]] std::optional<double> mirrored(std::span<const motion::Pose> poses);

    const render::Avatar& avatar_;
    render::SkinnedMesh mesh_;
    std::unique_ptr<render::RigState> state_;
    std::vector<glm::vec3> places_;                 // of all vertices, in the last picture
    std::vector<glm::vec3> at_rest_;                // the same in the T-pose
    std::vector<float> areas_;                      // of the triangles in the T-pose; m^2
    std::array<std::vector<std::size_t>, 2> feet_;  // vertices by Side
    std::vector<std::size_t> hands_;                // of palms and halves of forearms
    TrunkProfile trunk_;
    // What has been seen.
    AvatarMeasures result_;
    std::vector<double> planted_;
    AreaRatios ratios_;
    std::size_t pictures_ = 0;
    std::size_t pictures_inside_ = 0;
    std::vector<double> inside_since_;  // by swing: seconds
};

float area_of(const std::vector<glm::vec3>& places, const std::uint32_t* corners) noexcept {
    const glm::vec3& a = places[corners[0]];
    return 0.5F * glm::length(glm::cross(places[corners[1]] - a, places[corners[2]] - a));
}

AvatarTrial::AvatarTrial(const render::Avatar& avatar) : avatar_(avatar), mesh_(avatar) {
    if (avatar.rig != nullptr) {
        state_ = std::make_unique<render::RigState>(*avatar.rig);
        inside_since_.assign(avatar.rig->springs.size(), 0.0);
    }
    places_.resize(mesh_.size());
    wear(t_pose_of(avatar), state_.get());
    at_rest_ = places_;
    for (std::size_t i = 0; i + 2 < mesh_.triangles().size(); i += 3) {
        areas_.push_back(area_of(at_rest_, &mesh_.triangles()[i]));
    }
    const motion::WorldPose bones = motion::world_pose(avatar.skeleton, t_pose_of(avatar));
    trunk_ = TrunkProfile(mesh_, at_rest_, bones);
    for (std::size_t i = 0; i < mesh_.size(); ++i) {
        for (const Side side : motion::kSides) {
            const auto is_of = [&](Bone left) {
                return mesh_.bone(i) == index_of(on_side(left, side));
            };
            if (is_of(Bone::left_foot) || is_of(Bone::left_toes)) {
                feet_[static_cast<std::size_t>(side)].push_back(i);
            }
            const glm::vec3 elbow = bones.position(on_side(Bone::left_lower_arm, side));
            const glm::vec3 wrist = bones.position(on_side(Bone::left_hand, side));
            const bool is_outer =
                glm::distance(at_rest_[i], wrist) < glm::distance(at_rest_[i], elbow);
            if (is_of(Bone::left_hand) || (is_of(Bone::left_lower_arm) && is_outer)) {
                hands_.push_back(i);
            }
        }
    }
}

/// All vertices in a pose.
void AvatarTrial::wear(const motion::Pose& pose, render::RigState* state) {
    if (state != nullptr) {
        render::pose_avatar(*avatar_.rig, pose, {}, 1.0F, *state);
    }
    mesh_.set_pose(pose, state);
    for (std::size_t i = 0; i < places_.size(); ++i) {
        places_[i] = mesh_.place(i);
    }
}

/// Poses joints and tails as they are drawn at a moment.
void AvatarTrial::swing(std::span<const motion::Pose> poses, double rate, std::size_t at) {
    const auto pose_at = [&](StreamTime time) {
        return motion::pose_between(poses, to_seconds(time.time_since_epoch()) * rate);
    };
    const StreamTime time = stream_time_from_seconds(static_cast<double>(at) / rate);
    render::advance(*avatar_.rig, time, 1.0F, pose_at, *state_);
    render::pose_avatar(*avatar_.rig, poses[at], {}, 1.0F, *state_);
}

void AvatarTrial::look_at_feet(const motion::Pose& pose) {
    for (const Side side : motion::kSides) {
        float lowest = std::numeric_limits<float>::max();
        for (const std::size_t vertex : feet_[static_cast<std::size_t>(side)]) {
            lowest = std::min(lowest, mesh_.place(vertex).y);
        }
        if (feet_[static_cast<std::size_t>(side)].empty()) {
            continue;
        }
        result_.lowest_sole = std::min(result_.lowest_sole, static_cast<double>(lowest));
        if (pose.foot_contact[static_cast<std::size_t>(side)]) {
            planted_.push_back(std::abs(static_cast<double>(lowest)));
        }
    }
}

void AvatarTrial::look_at_tails(double seconds) {
    const render::SpringRig& springs = avatar_.rig->springs;
    if (springs.size() == 0) {
        return;
    }
    TailMeasures& tails = result_.tails ? *result_.tails : result_.tails.emplace();
    for (std::size_t i = 0; i < springs.size(); ++i) {
        const glm::vec3 joint(state_->joints.world[springs.joint(i)][3]);
        const glm::vec3 tail = springs.tail_place(i, state_->joints);
        const double length = static_cast<double>(glm::distance(joint, tail));
        const double own = std::max(static_cast<double>(springs.length(i)), 1e-6);
        if (!std::isfinite(length)) {
            tails.is_finite = false;
            continue;
        }
        tails.stretch = std::max(tails.stretch, std::abs(length / own - 1.0));
        const bool is_inside = springs.depth(i, state_->joints) > kTailInside;
        inside_since_[i] = is_inside ? inside_since_[i] + seconds : 0.0;
        tails.longest_inside = std::max(tails.longest_inside, inside_since_[i]);
    }
}

void AvatarTrial::look_at_skin() {
    constexpr float kLeastArea = 1e-8F;  // m^2; smaller ones are seams
    for (std::size_t i = 0; i < areas_.size(); ++i) {
        if (areas_[i] > kLeastArea) {
            ratios_.add(area_of(places_, &mesh_.triangles()[3 * i]) / areas_[i]);
        }
    }
}

void AvatarTrial::look_at_hands(const motion::Pose& pose) {
    const motion::WorldPose bones = motion::world_pose(avatar_.skeleton, pose);
    float deepest = 0.0F;
    for (const std::size_t vertex : hands_) {
        deepest = std::max(deepest, trunk_.depth(places_[vertex], bones));
    }
    ++pictures_;
    pictures_inside_ += deepest > kInside ? 1U : 0U;
    result_.hands.deepest = std::max(result_.hands.deepest, static_cast<double>(deepest));
}

/// Tails hang at rest: they need not swing alike.
std::optional<double> AvatarTrial::mirrored(std::span<const motion::Pose> poses) {
    const auto mates = mirror_mates(mesh_, at_rest_);
    if (!mates) {
        return std::nullopt;
    }
    std::vector<double> apart;
    const std::size_t step = std::max<std::size_t>(poses.size() / kMirroredPoses, 1);
    for (std::size_t at = 0; at < poses.size(); at += step) {
        std::unique_ptr<render::RigState> state;
        if (avatar_.rig != nullptr) {
            state = std::make_unique<render::RigState>(*avatar_.rig);
        }
        wear(poses[at], state.get());
        const std::vector<glm::vec3> one = places_;
        wear(motion::mirrored(poses[at]), state.get());
        for (const MirrorMate& mate : *mates) {
            const glm::vec3& place = one[mate.vertex];
            apart.push_back(static_cast<double>(
                glm::distance(places_[mate.mate], glm::vec3(-place.x, place.y, place.z))));
        }
    }
    return percentile(std::move(apart), kMirroredShare);
}

AvatarMeasures AvatarTrial::measure(std::span<const motion::Pose> poses, double rate) {
    result_.lowest_sole = std::numeric_limits<double>::max();
    const auto step =
        static_cast<std::size_t>(std::max(std::lround(rate / kPicturesPerSecond), 1L));
    for (std::size_t i = 0; i < poses.size(); ++i) {
        if (state_ != nullptr) {
            swing(poses, rate, i);
            look_at_tails(1.0 / rate);
        }
        mesh_.set_pose(poses[i], state_.get());
        look_at_feet(poses[i]);
        if (i % step == 0) {
            for (std::size_t v = 0; v < places_.size(); ++v) {
                places_[v] = mesh_.place(v);
            }
            look_at_skin();
            look_at_hands(poses[i]);
        }
    }
    if (result_.lowest_sole == std::numeric_limits<double>::max()) {
        result_.lowest_sole = 0.0;
    }
    if (!planted_.empty()) {
        const auto near = std::count_if(
            planted_.begin(), planted_.end(), [](double away) { return away <= kNearFloor; });
        result_.planted_share = static_cast<double>(near) / static_cast<double>(planted_.size());
        result_.planted_p99 = percentile(std::move(planted_), 0.99);
    }
    result_.hands.inside_share = static_cast<double>(pictures_inside_) /
                                 static_cast<double>(std::max<std::size_t>(pictures_, 1));
    result_.stretch_p995 = ratios_.percentile(0.995);
    result_.mirrored_p99 = mirrored(poses);
    return result_;
}

}  // namespace

AvatarMeasures measure_avatar(const render::Avatar& avatar,
                              std::span<const motion::Pose> poses,
                              double rate) {
    return poses.empty() ? AvatarMeasures() : AvatarTrial(avatar).measure(poses, rate);
}

}  // namespace raks::engine
