#include "motion/dance/cell_sequence.hpp"

#include <algorithm>
#include <cmath>

#include "base/smooth_steps.hpp"
#include "motion/dance/body/limb_ik.hpp"
#include "motion/dance/pose_join.hpp"

#include <glm/geometric.hpp>

namespace raks::motion {
namespace {

constexpr double kJoin = 0.35;          // beats on either side of a join in which both are danced
constexpr double kThinksFor = 1.0;      // beats before a decision in which futures are drawn
constexpr float kSlidesUnseen = 0.03F;  // metres that a standing foot may go over unseen
constexpr float kAddedLift = 0.04F;     // metres, at the middle of an added step
constexpr int kBar = 4;                 // beats

float way_between(const glm::vec3& a, const glm::vec3& b) noexcept {
    return glm::length(glm::vec2(a.x - b.x, a.z - b.z));
}

}  // namespace

Pose CellSequence::pose_of(const Piece& piece, double phase) const noexcept {
    const Cell& cell = content_->cells->cells[piece.first_cell];
    FigureChoice choice;
    choice.figure = cell.take;
    choice.is_mirrored = piece.is_mirrored;
    return piece.floor(motion::pose_of(*content_, choice, cell.beat + phase - piece.from));
}

void CellSequence::start(const DanceContent& content,
                         const FloorMove& stage,
                         const DancerPart& part) noexcept RAKS_NONBLOCKING {
    content_ = &content;
    stage_ = stage;
    faces_us_ = !part.is_in_couple;
    last_ = chooser_.start(*content.cells, part.seed);
    phase_ = 0.0;
    present_ = 0;
    count_ = 1;
    Piece& first = pieces_[0];
    first = {.first_cell = last_.cell, .is_mirrored = last_.is_mirrored, .from = 0.0, .until = 1.0};
    // The hips stand in the middle of the stage, to the front.
    first.floor = stage * inverse(floor_frame(pose_of(first, 0.0)));
}

void CellSequence::go_on_in(const DanceContent& content, const FloorMove& stage) noexcept {
    content_ = content_ != nullptr ? &content : nullptr;
    stage_ = stage;
}

// Where the last piece that is decided ends, seen from the stage.
FloorMove CellSequence::end_on_stage() const noexcept {
    const Piece& last = pieces_[count_ - 1];
    return inverse(stage_) * floor_frame(pose_of(last, last.until));
}

void CellSequence::advance(Beats phase, double energy, FigureWish& wish) noexcept RAKS_NONBLOCKING {
    phase_ = phase.count();
    while (present_ + 1 < count_ && phase_ >= pieces_[present_ + 1].from) {
        ++present_;
        ++number_;
        wish.is_another = false;
    }
    // The piece before is kept for as long as it is joined.
    if (present_ > 1) {
        const std::size_t gone = present_ - 1;
        std::move(pieces_.begin() + static_cast<std::ptrdiff_t>(gone),
                  pieces_.begin() + static_cast<std::ptrdiff_t>(count_),
                  pieces_.begin());
        count_ -= gone;
        present_ -= gone;
    }
    wish.figure.reset();
    const double left = pieces_[count_ - 1].until - phase_;
    if (left > kDecided + kThinksFor) {
        return;
    }
    const CellWish wanted{energy, wish.is_another, faces_us_};
    chooser_.draw(*content_->cells, last_, end_on_stage(), wanted);
    if (left <= kDecided && count_ + CellChooser::kFollowed <= pieces_.size()) {
        for (const CellStep& step : chooser_.decide()) {
            append(step);
        }
    }
}

void CellSequence::append(const CellStep& step) noexcept {
    Piece& last = pieces_[count_ - 1];
    last_ = step;
    if (!step.is_joined) {
        last.until += 1.0;
        return;
    }
    Piece& next = pieces_[count_];
    next = {.first_cell = step.cell,
            .is_mirrored = step.is_mirrored,
            .from = last.until,
            .until = last.until + 1.0};
    lay(last, next);
    ++count_;
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

Pose CellSequence::at(Beats phase) const noexcept RAKS_NONBLOCKING {
    const double when = phase.count();
    std::size_t i = 0;
    while (i + 1 < count_ && when >= pieces_[i + 1].from) {
        ++i;
    }
    if (i > 0 && when < pieces_[i].from + kJoin) {
        return joined(pieces_[i - 1], pieces_[i], when);
    }
    if (i + 1 < count_ && when > pieces_[i + 1].from - kJoin) {
        return joined(pieces_[i], pieces_[i + 1], when);
    }
    return pose_of(pieces_[i], when);
}

void CellSequence::jump(Beats phase) noexcept RAKS_NONBLOCKING {
    Piece piece = present();
    // In the last cell that is decided, where the phase has run ahead of what is.
    const double beats = std::min(std::floor(phase_ - piece.from), piece.until - piece.from - 1.0);
    const double part = phase.count() - std::floor(phase.count());
    piece.first_cell = static_cast<std::uint16_t>(piece.first_cell + std::max(0.0, beats));
    piece.from = phase.count() - part;
    piece.until = piece.from + 1.0;
    last_ = {piece.first_cell, piece.is_mirrored, false};
    pieces_[0] = piece;
    count_ = 1;
    present_ = 0;
    phase_ = phase.count();
    ++number_;
}

const LibraryFigure& CellSequence::figure() const noexcept {
    return content_->figures[content_->cells->cells[present().first_cell].take];
}

double CellSequence::beat(Beats phase) const noexcept {
    return content_->cells->cells[present().first_cell].beat + phase.count() - present().from;
}

Beats CellSequence::end() const noexcept { return Beats(kBar * (std::floor(phase_ / kBar) + 1.0)); }

}  // namespace raks::motion
