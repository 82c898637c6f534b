#include "training/figures/common_turn.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>

#include "motion/figures/motion_features.hpp"

namespace raks::motion {
namespace {

constexpr double kAlike = M_PI / 3.0;  // radians: turns this close count as the same turn
// Radians from the commonest turn within which a repeat is kept.
constexpr double kKept = M_PI / 2.0;

}  // namespace

double turn_of(const TrainingClip& clip, const FigureRepeat& repeat) {
    const auto heading = [&](std::size_t frame) {
        return heading_of(glm::dquat(clip.poses[frame].rotation(Bone::hips)));
    };
    const auto first = static_cast<std::size_t>(repeat.beat_frames.front());
    const auto last =
        std::min(static_cast<std::size_t>(repeat.beat_frames.back()), clip.poses.size() - 1);
    // Sums the differences from frame to frame, each in (-pi, pi], so that full turns count.
    double turn = 0.0;
    for (std::size_t frame = first; frame < last; ++frame) {
        turn += std::remainder(heading(frame + 1) - heading(frame), 2.0 * M_PI);
    }
    return turn;
}

std::vector<bool> of_common_turn(const std::vector<TrainingClip>& clips,
                                 const std::vector<FigureRepeat>& repeats) {
    std::vector<double> turns;
    for (const FigureRepeat& repeat : repeats) {
        turns.push_back(turn_of(clips[repeat.clip], repeat));
    }
    double common = 0.0;
    // The mode: the turn with most others near it. A mean or median could fall between two kinds of
    // turn.
    std::ptrdiff_t most = 0;
    for (const double turn : turns) {
        const auto alike = std::count_if(turns.begin(), turns.end(), [turn](double other) {
            return std::abs(other - turn) <= kAlike;
        });
        if (alike > most) {
            most = alike;
            common = turn;
        }
    }
    std::vector<bool> kept;
    for (const double turn : turns) {
        kept.push_back(std::abs(turn - common) <= kKept);
    }
    return kept;
}

}  // namespace raks::motion
