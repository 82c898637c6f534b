#include "motion/dance/cell_poses.hpp"

#include <algorithm>
#include <cstddef>

#include "motion/dance/dance_content.hpp"

namespace raks::motion {
namespace {

constexpr double kSample = 0.05;  // beats between looks at what stands

std::array<double, 2> stood_until(const DanceContent& content, const Cell& cell) {
    std::array<double, 2> until{-kCellJoin, -kCellJoin};
    for (double at = -kCellJoin; at <= 0.0; at += kSample) {
        const double beat = cell.beat + 1.0 + at;
        const Pose pose = take_pose(content, cell.take, beat, false);
        for (std::size_t s = 0; s < until.size(); ++s) {
            until[s] = pose.foot_contact[s] ? at : until[s];
        }
    }
    return until;
}

std::array<FootStand, 2> stands_after(const DanceContent& content, const Cell& cell) {
    std::array<FootStand, 2> stands{};
    std::array<int, 2> found{};
    for (double at = 0.0; at <= kCellStep && found != std::array{3, 3};
         at += at < kCellJoin ? kSample : 2.0 * kSample) {
        const double beat = cell.beat + at;
        const Pose pose = take_pose(content, cell.take, beat, false);
        for (std::size_t s = 0; s < stands.size(); ++s) {
            const bool is_down = pose.foot_contact[s];
            if (found[s] == 0 && (is_down || at >= kCellJoin)) {
                stands[s].from = std::min(at, kCellJoin);
                found[s] = 1;
            } else if (found[s] == 1 && !is_down) {
                stands[s].leaves = at;
                found[s] = 2;
            } else if (found[s] == 2 && is_down) {
                stands[s].lands = at;
                found[s] = 3;
            }
        }
    }
    return stands;
}

}  // namespace

Pose take_pose(const DanceContent& content,
               std::uint16_t take,
               double beat,
               bool is_mirrored) noexcept RAKS_NONBLOCKING {
    Pose pose = content.rest;
    content.figures[take].passages.front().at(beat, pose);
    return is_mirrored ? mirrored(pose) : pose;
}

std::vector<CellStands> cell_stands(const DanceContent& content) {
    std::vector<CellStands> stands;
    for (const Cell& cell : content.cells->cells) {
        stands.push_back({stood_until(content, cell), stands_after(content, cell)});
    }
    return stands;
}

}  // namespace raks::motion
