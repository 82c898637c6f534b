#pragma once

#include <array>
#include <bitset>

#include "base/beats.hpp"
#include "motion/dance/baking/figure_passage.hpp"
#include "motion/figures/size_by_tempo.hpp"
#include "motion/skeleton/pose.hpp"
#include "motion/skeleton/skeleton.hpp"

namespace raks::motion {

/// How large a figure is danced, against how it was learnt.
struct FigureSize {
    float body = 1.0F;
    float arms = 1.0F;
    /// Height of jumps: what goes up comes down in its time.
    float flight = 1.0F;

    [[nodiscard]] bool is_as_learnt() const noexcept {
        return body == 1.0F && arms == 1.0F && flight == 1.0F;
    }
};

/// What a figure moves about.
struct FigureMiddle {
    Pose pose;                               ///< mean rotations and place of the hips
    std::array<glm::vec3, 2> ankles{};       ///< mean places; by Side
    std::bitset<kBoneCount> turns_about_it;  ///< bones that never turn far away from it
    bool comes_back = false;                 ///< it ends where and as it began
};

/// Of a passage of so many beats; `comes_back`: by the grammar. Threads: workers. Real-time: no.
[[nodiscard]] FigureMiddle middle_of(const FigurePassage& passage,
                                     int beats,
                                     bool comes_back,
                                     const Skeleton& skeleton);

/// The size of a figure that was learnt at one tempo and is danced at another. When the music is
/// slower it is as learnt: its legs were planned to reach no farther.
/// Threads: any. Real-time: yes.
[[nodiscard]] FigureSize figure_size(const SizeByTempo& law, Bpm learnt, Bpm tempo) noexcept;

/// A pose of the figure with its movements so large: rotations go so far away from their mean, hips
/// and feet from their mean places. A foot stands as it stood, as long as the size stays the same;
/// steps are lifted as high as before. Both feet off the floor: hips and feet fly as high as
/// `flight` says. Threads: any. Real-time: yes.
void resize(const FigureMiddle& middle,
            const FigureSize& size,
            const Skeleton& skeleton,
            Pose& pose) noexcept;

}  // namespace raks::motion
