// Cell poses: the takes of a dance of cells as they are danced, and when their feet stand.
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "base/realtime.hpp"
#include "motion/skeleton/pose.hpp"

namespace raks::motion {

struct DanceContent;

/// Beats on either side of a join in which both pieces are danced.
inline constexpr double kCellJoin = 0.35;
/// Beats from a join within which a foot is followed.
inline constexpr double kCellStep = 2.0;

/// When a foot stands first after a beat, leaves, and lands again; beats from that beat.
struct FootStand {
    double from = kCellJoin;    ///< at most kCellJoin
    double leaves = kCellStep;  ///< at most kCellStep
    double lands = kCellStep;   ///< at most kCellStep
};

/// When the feet stand about a cell, by Side.
struct CellStands {
    /// When each foot stands last before the cell's end, beats from it; -kCellJoin: not since then
    std::array<double, 2> until{-kCellJoin, -kCellJoin};
    std::array<FootStand, 2> after{};  ///< the cell's beginning
};

/// The pose of a take at a beat, in the take's own frame. Threads: any. Real-time: yes.
[[nodiscard]] Pose take_pose(const DanceContent& content,
                             std::uint16_t take,
                             double beat,
                             bool is_mirrored) noexcept RAKS_NONBLOCKING;

/// The stands of all cells of a content: what a join asks of them. It is looked up when a piece is
/// laid, since to find it takes some thirty poses. Threads: workers. Real-time: no.
[[nodiscard]] std::vector<CellStands> cell_stands(const DanceContent& content);

}  // namespace raks::motion
