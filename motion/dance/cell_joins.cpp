// Where the pieces of a dance of cells are on the floor, and how one goes over into the next.
#include <algorithm>
#include <cmath>

#include "base/smooth_steps.hpp"
#include "motion/dance/baking/figure_size.hpp"
#include "motion/dance/body/limb_ik.hpp"
#include "motion/dance/cell_sequence.hpp"
#include "motion/dance/pose_join.hpp"

#include <glm/geometric.hpp>

namespace raks::motion {
namespace {

constexpr double kJoin = 0.35;          // beats on either side of a join in which both are danced
constexpr float kSlidesUnseen = 0.03F;  // metres that a standing foot may go over unseen
constexpr float kAddedLift = 0.04F;     // metres, at the middle of an added step

float way_between(const glm::vec3& a, const glm::vec3& b) noexcept {
    return glm::length(glm::vec2(a.x - b.x, a.z - b.z));
}

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

// The phase of a piece as it is shown: from its rest it starts softly, and is then in time.
double CellSequence::shown(const Piece& piece, double phase) noexcept {
    const Rest& rest = piece.rest;
    if (phase >= rest.to) {
        return phase;
    }
    const double t = std::max(0.0, (phase - rest.from) / (rest.to - rest.from));
    // Hermite: still at the beginning, as fast as the music at the end.
    const double way = t * t * (3.0 - 2.0 * t);
    return rest.at + way * (rest.to - rest.at) + t * t * (t - 1.0) * (rest.to - rest.from);
}

Pose CellSequence::pose_of(const Piece& piece, double phase) const noexcept {
    const Cell& cell = content_->cells->cells[piece.first_cell];
    FigureChoice choice;
    choice.figure = cell.take;
    choice.is_mirrored = piece.is_mirrored;
    return piece.floor(
        motion::pose_of(*content_, choice, cell.beat + shown(piece, phase) - piece.from));
}

// Lays the next piece so that the feet that stand in both stay where they are, and decides how each
// foot goes over.
void CellSequence::lay(const Piece& before, Piece& after) const noexcept {
    const Skeleton& skeleton = content_->skeleton;
    const Pose from = pose_of(before, after.from);
    after.floor = {};
    const Pose own = pose_of(after, after.from);
    const double turn = floor_frame(from).heading - floor_frame(own).heading;
    const FloorMove turned{turn, {}};
    Pose to = turned(own);
    const WorldPose a = world_body(skeleton, from);
    WorldPose b = world_body(skeleton, to);
    glm::vec3 apart{};
    int standing = 0;
    for (const Side side : kSides) {
        const auto s = static_cast<std::size_t>(side);
        if (from.foot_contact[s] && to.foot_contact[s]) {
            apart += foot_place(skeleton, a, side).pivot - foot_place(skeleton, b, side).pivot;
            ++standing;
        }
    }
    apart =
        standing > 0 ? apart / static_cast<float>(standing) : from.hips_position - to.hips_position;
    after.floor = {turn, {static_cast<double>(apart.x), static_cast<double>(apart.z)}};
    to = after.floor(own);
    b = world_body(skeleton, to);
    for (const Side side : kSides) {
        const auto s = static_cast<std::size_t>(side);
        after.swings[s] = {-kJoin, kJoin};
        const bool stood = from.foot_contact[s];
        const bool stands = to.foot_contact[s];
        if (stood && stands) {
            after.is_lifted[s] = way_between(foot_place(skeleton, a, side).pivot,
                                             foot_place(skeleton, b, side).pivot) > kSlidesUnseen;
            if (after.is_lifted[s]) {
                // One foot after the other, or both would be in the air.
                after.swings[s] =
                    side == Side::left ? std::array{-kJoin, 0.0} : std::array{0.0, kJoin};
            }
        } else if (stood) {
            after.swings[s] = {0.0, kJoin};
        } else if (stands) {
            after.swings[s] = {-kJoin, 0.0};
        }
    }
}

Pose CellSequence::joined(const Piece& before, const Piece& after, double phase) const noexcept {
    const double at = phase - after.from;
    const float share = smootherstep(static_cast<float>((at + kJoin) / (2.0 * kJoin)));
    std::array<FootShare, 2> feet{};
    for (std::size_t s = 0; s < feet.size(); ++s) {
        const auto [from, to] = after.swings[s];
        const float own = smootherstep(static_cast<float>((at - from) / (to - from)));
        feet[s].share = own;
        feet[s].lift = after.is_lifted[s] ? kAddedLift * 4.0F * own * (1.0F - own) : 0.0F;
    }
    return joined_poses(
        content_->skeleton, pose_of(before, phase), pose_of(after, phase), share, feet);
}

Pose CellSequence::unsized(double phase) const noexcept {
    const std::size_t i = piece_at(phase);
    if (i > 0 && phase < pieces_[i].from + kJoin) {
        return joined(pieces_[i - 1], pieces_[i], phase);
    }
    if (i + 1 < count_ && phase > pieces_[i + 1].from - kJoin) {
        return joined(pieces_[i], pieces_[i + 1], phase);
    }
    return pose_of(pieces_[i], phase);
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
