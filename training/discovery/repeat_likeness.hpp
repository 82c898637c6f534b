#pragma once

#include <cstddef>
#include <span>
#include <vector>

#include "training/discovery/repeat_segmentation.hpp"
#include "training/figures/figure_trainer.hpp"

/// Repeat likeness: which repeats are the same figure, by the body's posture at equal phases.
namespace raks::motion {

/// Repeats closer than this are alike. Repeats of one salsa figure lie 0.4 to 0.7 apart, different
/// figures of the same steps 0.6 to 1.5.
inline constexpr double kAlikeDistance = 0.7;

/// One repeat of a clip.
struct ClipRepeat {
    const TrainingClip* clip = nullptr;  ///< never null where it is compared
    RepeatSpan frames;                   ///< in frames of the clip
    int beats = 0;                       ///< repeats of another number of beats are never alike
};

/// How alike repeats are.
struct RepeatLikeness {
    /// Distance of each repeat to the commonest one: root mean square over phases and joints of the
    /// places seen from the hips, over that of two random moments of these repeats. 0: the same;
    /// about 1: nothing in common.
    std::vector<double> distance;
    /// Whether it is alike the commonest one, and turns as it does within 60 degrees.
    std::vector<bool> is_alike;
    std::size_t commonest =
        0;  ///< the repeat with most others alike; of equals the nearest to them
};

/// Compares repeats of one or several clips; at least one. Threads: workers. Real-time: no.
[[nodiscard]] RepeatLikeness compare_repeats(std::span<const ClipRepeat> repeats);

}  // namespace raks::motion
