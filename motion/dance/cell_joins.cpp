// Where the pieces of a dance of cells are on the floor, and how one goes over into the next.
#include <algorithm>
#include <cmath>
#include <utility>

#include "base/smooth_steps.hpp"
#include "motion/dance/baking/figure_size.hpp"
#include "motion/dance/body/limb_ik.hpp"
#include "motion/dance/cell_sequence.hpp"
#include "motion/dance/pose_join.hpp"

#include <glm/geometric.hpp>

namespace raks::motion {
namespace {

constexpr double kNearJoin = 0.2;   // beats from a join within which a foot stands in both pieces
constexpr float kFarApart = 0.10F;  // metres that a foot cannot stand aside from its piece
constexpr float kSlidesUnseen = 0.01F;  // metres that a standing foot may go over unseen
constexpr float kAddedLift = 0.04F;     // metres, at the middle of an added step
constexpr double kAddedStep = 0.4;      // beats
constexpr double kShortestStep = 0.05;  // beats

constexpr double kFacesUs = 0.5;    // radians from the audience that count as facing it
constexpr double kTurnShare = 0.3;  // of what is beyond, made up at a join
constexpr double kMostTurn = 0.12;  // radians, at a join

glm::vec2 over_ground(const glm::vec3& place) noexcept { return {place.x, place.z}; }

// What the manner asks of a pose of takes: trunk, arms and height. Steps stay as long as they are,
// since takes travel.
FigureSize size_of_cells(const Manner& manner) noexcept {
    FigureSize size;
    size.body = manner.body;
    size.arms = manner.arms;
    size.bend = manner.bend;
    return size;
}

}  // namespace

// The phase of a piece as it is shown: after a rest it makes up for what it lacks, and ends as fast
// as the music (a Hermite curve). It starts at its mean rate: the dancer smooths the change.
double CellSequence::shown(const Piece& piece, double phase) noexcept {
    const Rest& rest = piece.rest;
    if (phase >= rest.to) {
        return phase;
    }
    const double beats = rest.to - rest.from;
    const double way = rest.to - rest.at;
    const double t = std::max(0.0, (phase - rest.from) / beats);
    const double back = 1.0 - t;
    return rest.at + way * t * t * (3.0 - 2.0 * t) + way * t * back * back - beats * t * t * back;
}

Pose CellSequence::pose_of(const Piece& piece, double phase) const noexcept {
    const Cell& cell = content_->cells->cells[piece.first_cell];
    const double beat = cell.beat + shown(piece, phase) - piece.from;
    return piece.floor(take_pose(*content_, cell.take, beat, piece.is_mirrored));
}

// The pose of a piece with its feet where they still stand from the piece before.
Pose CellSequence::with_feet(const Piece& piece, double phase) const noexcept {
    Pose pose = pose_of(piece, phase);
    const double at = phase - piece.from;
    const auto is_over = [at](const FootJoin& foot) { return !foot.stays || at >= foot.lands; };
    if (std::all_of(piece.feet.begin(), piece.feet.end(), is_over)) {
        return pose;
    }
    const Skeleton& skeleton = content_->skeleton;
    const WorldPose world = world_body(skeleton, pose);
    std::array<FootTarget, 2> targets;
    std::array<glm::vec3, 2> ankles{};
    for (const Side side : kSides) {
        const auto s = static_cast<std::size_t>(side);
        const FootJoin& foot = piece.feet[s];
        const FootPlace place = foot_place(skeleton, world, side);
        float left = 0.0F;
        if (!is_over(foot)) {
            const double gone = (at - foot.leaves) / (foot.lands - foot.leaves);
            left = 1.0F - smootherstep(static_cast<float>(gone));
        }
        targets[s].rotation = turn_about_up(left * foot.yaw) * place.rotation;
        const glm::vec2 aside = left * foot.aside;
        glm::vec3 pivot = place.pivot + glm::vec3(aside.x, 0.0F, aside.y);
        if (foot.is_lifted && left > 0.0F && left < 1.0F) {
            pivot.y += kAddedLift * 4.0F * left * (1.0F - left);
            pose.foot_contact[s] = false;
        }
        targets[s].ankle = pivot - pivot_from_ankle(skeleton, side, targets[s].rotation);
        ankles[s] = targets[s].ankle;
    }
    lower_to_reach(skeleton, ankles, pose);
    for (const Side side : kSides) {
        solve_leg(skeleton, side, targets[static_cast<std::size_t>(side)], pose);
    }
    return pose;
}

// When the feet stand about the end of a piece and about the beginning of the next one; a mirrored
// piece stands with the other foot.
CellSequence::JoinStands CellSequence::stands_at(const Piece& before,
                                                 const Piece& after) const noexcept {
    const CellStands& last = content_->stands[cell_of(before, after.from - 0.5)];
    const CellStands& next = content_->stands[after.first_cell];
    JoinStands stands{last.until, next.after};
    if (before.is_mirrored) {
        std::swap(stands.until[0], stands.until[1]);
    }
    if (after.is_mirrored) {
        std::swap(stands.after[0], stands.after[1]);
    }
    return stands;
}

// What a join turns the dance towards the audience, radians: so little that feet can stay.
double CellSequence::turn_to_us(const Pose& pose) const noexcept {
    const double away = std::remainder(floor_frame(pose).heading - stage_.heading, 2.0 * M_PI);
    const double beyond = std::max(0.0, std::abs(away) - kFacesUs);
    const double turn = std::min(kMostTurn, kTurnShare * beyond);
    return faces_us_ ? -std::copysign(turn, away) : 0.0;
}

// Lays the next piece so that the feet that stand in both stay where they are, and decides how each
// foot goes over: one that stands in both stays where it is until the next piece takes it away;
// others go over while they are in the air.
void CellSequence::lay(const Piece& before, Piece& after) const noexcept {
    const Skeleton& skeleton = content_->skeleton;
    const auto [until, stands] = stands_at(before, after);
    const Pose from = with_feet(before, after.from);
    after.floor = {};
    const Pose own = pose_of(after, after.from);
    const double heading = floor_frame(from).heading + turn_to_us(from);
    const FloorMove turned{heading - floor_frame(own).heading, {}};
    std::array<FootPlace, 2> stood;
    std::array<FootPlace, 2> stand;
    glm::vec2 apart{};
    float standing = 0.0F;
    for (const Side side : kSides) {
        const auto s = static_cast<std::size_t>(side);
        FootJoin& foot = after.feet[s];
        foot.stays = until[s] > -kNearJoin && stands[s].from < kNearJoin;
        if (foot.stays) {
            const Pose last = with_feet(before, after.from + until[s]);
            const Pose first = turned(pose_of(after, after.from + stands[s].from));
            stood[s] = foot_place(skeleton, world_body(skeleton, last), side);
            stand[s] = foot_place(skeleton, world_body(skeleton, first), side);
            apart += over_ground(stood[s].pivot - stand[s].pivot);
            standing += 1.0F;
        }
    }
    apart = standing > 0.0F ? apart / standing
                            : over_ground(from.hips_position - turned(own).hips_position);
    after.floor = {turned.heading, glm::dvec2(apart)};
    for (const Side side : kSides) {
        const auto s = static_cast<std::size_t>(side);
        FootJoin& foot = after.feet[s];
        foot.from = until[s];
        foot.to = stands[s].from;
        if (!foot.stays) {
            continue;
        }
        foot.aside = over_ground(stood[s].pivot - stand[s].pivot) - apart;
        foot.yaw = static_cast<float>(std::remainder(
            foot_heading(stood[s].rotation) - foot_heading(stand[s].rotation), 2.0 * M_PI));
        foot.leaves = stands[s].leaves;
        foot.lands = std::max(stands[s].lands, foot.leaves + kShortestStep);
        const float way = glm::length(foot.aside);
        // One foot after the other, or both would be in the air.
        const double first = side == Side::left ? 0.0 : kAddedStep;
        if (way > kFarApart) {
            foot.leaves = first - kAddedStep;
            foot.lands = first;
            foot.is_lifted = true;
        } else if (foot.lands >= kCellStep) {
            foot.leaves = kCellJoin + first;
            foot.lands = foot.leaves + kAddedStep;
            foot.is_lifted = way > kSlidesUnseen;
        }
    }
}

Pose CellSequence::joined(const Piece& before, const Piece& after, double phase) const noexcept {
    const double at = phase - after.from;
    const float share = smootherstep(static_cast<float>((at + kCellJoin) / (2.0 * kCellJoin)));
    std::array<FootShare, 2> feet{};
    for (std::size_t s = 0; s < feet.size(); ++s) {
        const FootJoin& foot = after.feet[s];
        feet[s].share =
            foot.stays ? share
                       : smootherstep(static_cast<float>((at - foot.from) / (foot.to - foot.from)));
    }
    const Pose from = with_feet(before, phase);
    const Pose to = with_feet(after, phase);
    Pose pose = joined_poses(content_->skeleton, from, to, share, feet);
    for (std::size_t s = 0; s < feet.size(); ++s) {
        const FootJoin& foot = after.feet[s];
        const bool goes_over = !foot.stays && at > foot.from && at < foot.to;
        const bool is_of_next = foot.stays ? at >= 0.0 : at >= foot.to;
        pose.foot_contact[s] =
            !goes_over && (is_of_next ? to.foot_contact[s] : from.foot_contact[s]);
    }
    return pose;
}

Pose CellSequence::unsized(double phase) const noexcept {
    const std::size_t i = piece_at(phase);
    if (i > 0 && phase < pieces_[i].from + kCellJoin) {
        return joined(pieces_[i - 1], pieces_[i], phase);
    }
    if (i + 1 < count_ && phase > pieces_[i + 1].from - kCellJoin) {
        return joined(pieces_[i], pieces_[i + 1], phase);
    }
    return with_feet(pieces_[i], phase);
}

Pose CellSequence::at(Beats phase, const Manner& manner) const noexcept RAKS_NONBLOCKING {
    const Pose pose = unsized(phase.count());
    const FigureSize size = size_of_cells(manner);
    if (size.is_as_learnt()) {
        return pose;
    }
    const FloorMove place = floor_frame(pose);
    Pose own = inverse(place)(pose);
    resize(figure().middle, size, content_->skeleton, own);
    return place(own);
}

}  // namespace raks::motion
