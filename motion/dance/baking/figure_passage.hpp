#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <vector>

#include "base/beats.hpp"
#include "base/packer.hpp"
#include "base/random.hpp"
#include "motion/dance/baking/foot_lock.hpp"
#include "motion/dance/baking/free_figure.hpp"
#include "motion/figures/figure_model.hpp"
#include "motion/skeleton/pose.hpp"
#include "motion/skeleton/skeleton.hpp"

namespace raks::motion {

/// Where both balls rest when a figure begins, in the frame of its start; by Side.
using StartPlaces = std::array<std::optional<glm::vec2>, 2>;

/// How the feet step.
struct Footing {
    StartPlaces places;       ///< as in all figures of the dance
    FigureLandings landings;  ///< at which the contacts are aimed
    bool is_mean = false;     ///< steps are means of repeats that differ, as people's do
};

/// One figure danced once, from kMargin before its count 1 to kMargin after its end, with planted
/// feet, in the frame of its start. Immutable once made.
class FigurePassage {
 public:
    /// Beats before and after, over which it goes over into its neighbours.
    static constexpr double kMargin = 0.75;

    /// The feet step as in `steps` and rest, each time, a little aside, as `random` says (none:
    /// not); where the figure begins and ends at the footing's places. `body`: the poses above the
    /// hips, as many as those of `steps`. Threads: workers. Real-time: no (some ms).
    FigurePassage(const FigureModel& model,
                  const FreeFigure& steps,
                  std::vector<Pose> body,
                  const FigurePath& way,
                  const Footing& footing,
                  const CounterRandom* random,
                  const Skeleton& skeleton);

    /// The figure as it is: feet free, no contacts.
    explicit FigurePassage(const FreeFigure& figure);

    /// The rotations in the one of both signs in which they lie nearer to those of `other` where
    /// both begin; each goes on without a jump. So the way round from one passage to another stays
    /// the same over the figure. Threads: workers. Real-time: no.
    void take_signs_of(const FigurePassage& other);

    /// Sets hips, body and contacts of `pose` at a beat in [-kMargin, beats + kMargin] (clamped);
    /// fingers stay. Threads: any. Real-time: yes.
    void at(double beat, Pose& pose) const noexcept;
    /// Arms alone. Threads: any. Real-time: yes.
    void arms_at(double beat, Pose& pose) const noexcept;

    /// As this machine stores it, for a cache. Threads: any. Real-time: no.
    void pack(Packer& packer) const;
    /// Of what pack() wrote. Behind a fault of `unpacker` it is empty: ask that.
    [[nodiscard]] static FigurePassage unpack(Unpacker& unpacker);

    /// The bones that move; the arms are the last kArmBones.
    static constexpr std::size_t kArmBones = 8;
    static constexpr std::array<Bone, 22> kBones = {Bone::hips,
                                                    Bone::spine,
                                                    Bone::chest,
                                                    Bone::upper_chest,
                                                    Bone::neck,
                                                    Bone::head,
                                                    Bone::left_upper_leg,
                                                    Bone::left_lower_leg,
                                                    Bone::left_foot,
                                                    Bone::left_toes,
                                                    Bone::right_upper_leg,
                                                    Bone::right_lower_leg,
                                                    Bone::right_foot,
                                                    Bone::right_toes,
                                                    Bone::left_shoulder,
                                                    Bone::left_upper_arm,
                                                    Bone::left_lower_arm,
                                                    Bone::left_hand,
                                                    Bone::right_shoulder,
                                                    Bone::right_upper_arm,
                                                    Bone::right_lower_arm,
                                                    Bone::right_hand};

 private:
    FigurePassage() = default;
    struct Sample {
        std::array<glm::quat, kBones.size()> rotations;
        glm::vec3 hips{};
        std::array<bool, 2> contact{};
    };
    struct Place {
        const Sample& before;
        const Sample& after;
        float share;
    };
    [[nodiscard]] Place place_of(double beat) const noexcept;
    /// Takes the figure with its margins out of poses that begin kBeatsAround beats before it.
    void keep(const std::vector<Pose>& poses, int samples_per_beat);

    double samples_per_beat_ = 48.0;
    std::vector<Sample> samples_;
};

/// Where the balls rest around the start of this figure when it is danced as learnt.
[[nodiscard]] StartPlaces learnt_places(const FigureModel& model,
                                        const FigureTracks& tracks,
                                        const FigurePath& way,
                                        const Skeleton& skeleton);

}  // namespace raks::motion
