// Figure size: how large a figure is danced at another tempo.
#pragma once

#include <array>
#include <bitset>

#include "base/beats.hpp"
#include "base/realtime.hpp"
#include "motion/dance/baking/figure_passage.hpp"
#include "motion/figures/size_by_tempo.hpp"
#include "motion/skeleton/pose.hpp"
#include "motion/skeleton/skeleton.hpp"

namespace raks::motion {

/// How large a figure is danced relative to how it was learnt; 1 is as learnt.
struct FigureSize {
    float body = 1.0F;  ///< trunk, head, and how far the hips rise and sink
    float arms = 1.0F;  ///< arms
    /// By Side: way of the feet over the floor; the hips' is their mean.
    std::array<float, 2> steps{1.0F, 1.0F};
    /// Height of jumps: falls with the square of the time that a beat leaves for them.
    float flight = 1.0F;
    float bend = 0.0F;  ///< how much lower the hips are; metres

    /// Whether resizing changes nothing.
    [[nodiscard]] bool is_as_learnt() const noexcept {
        return body == 1.0F && arms == 1.0F && steps[0] == 1.0F && steps[1] == 1.0F &&
               flight == 1.0F && bend == 0.0F;
    }
};

/// The mean posture that a figure moves about; resize() scales the distances from it.
struct FigureMiddle {
    Pose pose;  ///< mean rotations and mean place of the hips, jumps subtracted
    std::array<glm::vec3, 2> ankles{};  ///< mean places in the frame of the start; by Side; metres
    /// Bones that are never 120 degrees or more away from it
    std::bitset<kBoneCount> turns_about_it;
    bool comes_back = false;  ///< it ends at the place and heading where it began
};

/// The middle of a passage of a figure of `beats`; `comes_back` is copied. Threads: workers.
/// Real-time: no.
[[nodiscard]] FigureMiddle middle_of(const FigurePassage& passage,
                                     int beats,
                                     bool comes_back,
                                     const Skeleton& skeleton);

/// The size at `tempo` of a figure learnt at `learnt`, by its law. When the music is slower, body
/// and arms stay as learnt, because the legs were planned to reach no farther. Threads: any.
/// Real-time: yes.
[[nodiscard]] FigureSize figure_size(const SizeByTempo& law,
                                     Bpm learnt,
                                     Bpm tempo) noexcept RAKS_NONBLOCKING;

/// Scales the movements of a pose of the figure: rotations by their distance from the mean, hips
/// and feet by that from their mean places. A standing foot stays in place as long as the size
/// stays the same; steps are lifted as high as before. While both feet are off the floor hips and
/// feet rise by the factor `flight`. Threads: any. Real-time: yes.
void resize(const FigureMiddle& middle,
            const FigureSize& size,
            const Skeleton& skeleton,
            Pose& pose) noexcept RAKS_NONBLOCKING;

}  // namespace raks::motion
