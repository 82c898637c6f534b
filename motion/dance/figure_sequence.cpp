#include "motion/dance/figure_sequence.hpp"

#include <algorithm>
#include <cmath>

#include "motion/dance/easing.hpp"
#include "motion/dance/leg_ik.hpp"

namespace raks::motion {
namespace {

// A foot that two figures plant farther apart than this would be seen to slide, metres.
constexpr float kGatherFrom = 0.03F;
// The left one gathers before the change, the right one after it; beats from it.
constexpr double kGatherNearest = 0.1;
constexpr double kGatherFarthest = 0.7;
constexpr float kGatherLift = 0.05F;  // metres, at the middle of the step

/// How far a foot has gone over from one figure to the next, and how high it is lifted for that.
struct FootShare {
    float share = 0.0F;
    float lift = 0.0F;  // metres
};

/// Of a step of its own, `beats` from the change of figures that has `margin` beats on either side.
FootShare gathering_step(Side side, double beats, double margin) noexcept {
    const double scale = margin / FigurePassage::kMargin;
    const double first = scale * (side == Side::left ? -kGatherFarthest : kGatherNearest);
    const double length = scale * (kGatherFarthest - kGatherNearest);
    const float share = smootherstep(static_cast<float>((beats - first) / length));
    return {share, kGatherLift * 4.0F * share * (1.0F - share)};
}

/// Between two poses, feet by their places in the world: rotations averaged down a leg would carry
/// a foot that both have planted off its place. The paper plants none.
Pose average(const DanceContent& content,
             const Pose& from,
             const Pose& to,
             float share,
             const std::array<FootShare, 2>& feet) noexcept {
    Pose pose = interpolate(from, to, share);
    if (content.generator == Generator::frames) {
        return pose;
    }
    const Skeleton& skeleton = content.skeleton;
    const WorldPose a = world_pose(skeleton, from);
    const WorldPose b = world_pose(skeleton, to);
    for (const Side side : kSides) {
        const Bone foot = on_side(Bone::left_foot, side);
        const FootShare& own = feet[static_cast<std::size_t>(side)];
        FootTarget target{glm::mix(a.position(foot), b.position(foot), own.share),
                          glm::slerp(a.rotation(foot), b.rotation(foot), own.share)};
        if (own.lift > 0.0F) {
            target.ankle.y += own.lift;
            pose.foot_contact[static_cast<std::size_t>(side)] = false;
        }
        const float standing = -lowest_of_sole(
            skeleton, side, target.rotation, pose.rotation(on_side(Bone::left_toes, side)));
        target.ankle.y = std::max(target.ankle.y, standing);
        solve_leg(skeleton, side, target, pose);
    }
    return pose;
}

}  // namespace

FloorMove floor_of(const DanceContent& content, const FloorMove& stage, bool is_turned) noexcept {
    if (is_turned) {
        for (const LibraryFigure& figure : content.figures) {
            if (figure.turns_half) {
                return stage * figure.move;
            }
        }
    }
    return stage;
}

void FigureSequence::start(const DanceContent& content,
                           const FloorMove& stage,
                           const DancerPart& part,
                           bool stands_turned) noexcept {
    content_ = &content;
    stage_ = stage;
    part_ = part;
    before_.reset();
    next_.reset();
    current_ = {choose_ways(0, part.ways, number_), 0.0, stands_turned, {}};
}

double FigureSequence::end_of(const Danced& danced) const noexcept {
    return danced.start + content_->figures[danced.choice.figure].beats;
}

bool FigureSequence::turned_after(const Danced& danced) const noexcept {
    return danced.is_turned != content_->figures[danced.choice.figure].turns_half;
}

void FigureSequence::advance(Beats phase, double energy, FigureWish& wish) noexcept {
    const double end = end_of(current_);
    if (!next_ && phase.count() >= end - kDecided) {
        const std::size_t figure = content_->choreography.next(
            current_.choice.figure, energy, wish, part_.seed, number_ + 1);
        next_ = {choose_ways(figure, part_.ways, number_ + 1), end, turned_after(current_), {}};
        next_->gathers = gathering(current_, *next_);
        wish.is_another = false;
        wish.figure.reset();
    }
    if (next_ && phase.count() >= end) {
        before_ = current_;
        current_ = *next_;
        next_.reset();
        ++number_;
    }
}

void FigureSequence::jump(Beats phase) noexcept {
    const bool is_turned = turned_after(current_);
    ++number_;
    current_ = {choose_ways(0, part_.ways, number_), 0.0, is_turned, {}};
    const double beats = figure().beats;
    current_.start = beats * std::floor(phase.count() / beats);
    before_.reset();
    next_.reset();
}

Pose FigureSequence::pose_of(const Danced& danced, double phase) const noexcept {
    const Pose pose = motion::pose_of(*content_, danced.choice, phase - danced.start);
    return floor_of(*content_, stage_, danced.is_turned)(pose);
}

double FigureSequence::margin_between(const Danced& before, const Danced& after) const noexcept {
    const int shorter = std::min(content_->figures[before.choice.figure].beats,
                                 content_->figures[after.choice.figure].beats);
    return std::min(FigurePassage::kMargin, 0.5 * shorter);
}

Pose FigureSequence::joined(const Danced& before,
                            const Danced& after,
                            double phase) const noexcept {
    const double margin = margin_between(before, after);
    const float share =
        smootherstep(static_cast<float>((phase - after.start + margin) / (2.0 * margin)));
    std::array<FootShare, 2> feet{};
    for (const Side side : kSides) {
        const auto s = static_cast<std::size_t>(side);
        feet[s] = after.gathers[s] ? gathering_step(side, phase - after.start, margin)
                                   : FootShare{share, 0.0F};
    }
    return average(*content_, pose_of(before, phase), pose_of(after, phase), share, feet);
}

std::array<bool, 2> FigureSequence::gathering(const Danced& before,
                                              const Danced& after) const noexcept {
    const WorldPose ends = world_pose(content_->skeleton, pose_of(before, after.start));
    const WorldPose begins = world_pose(content_->skeleton, pose_of(after, after.start));
    std::array<bool, 2> gathers{};
    for (const Side side : kSides) {
        const Bone foot = on_side(Bone::left_foot, side);
        glm::vec3 apart = begins.position(foot) - ends.position(foot);
        apart.y = 0.0F;
        gathers[static_cast<std::size_t>(side)] = glm::length(apart) > kGatherFrom;
    }
    return gathers;
}

Pose FigureSequence::at(Beats phase) const noexcept {
    const double at = phase.count();
    if (before_ && at < current_.start + margin_between(*before_, current_)) {
        return joined(*before_, current_, at);
    }
    if (next_ && at > next_->start + margin_between(current_, *next_)) {
        return pose_of(*next_, at);
    }
    if (next_ && at > next_->start - margin_between(current_, *next_)) {
        return joined(current_, *next_, at);
    }
    return pose_of(current_, at);
}

}  // namespace raks::motion
