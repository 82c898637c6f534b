#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <vector>

#include "base/beats.hpp"
#include "base/random.hpp"
#include "motion/dance/feature_pose.hpp"
#include "motion/dance/floor_move.hpp"
#include "motion/dance/foot_lock.hpp"
#include "motion/figures/figure_model.hpp"
#include "motion/figures/motion_features.hpp"
#include "motion/skeleton/pose.hpp"
#include "motion/skeleton/skeleton.hpp"

namespace raks::motion {

/// Where a figure leads on the floor, seen from where its count 1 began (hips at the origin,
/// heading 0). A dance closes when its figures either come back or end half a turn about one common
/// point.
struct FigureWay {
    int half_turns = 0;  ///< of the hips over the figure
    FloorMove move;      ///< from its start to its end; identity, or half a turn
    /// In the middle of the figure, besides what was learnt; left, forward of its start; metres.
    glm::dvec2 aside{0.0, 0.0};
};

/// A figure's trajectories as learnt; what each passage varies. Torso and legs are widened until
/// the toes are as fast as people's.
[[nodiscard]] FigureTracks learnt_tracks(const FigureModel& model, const Skeleton& skeleton);

/// Where both balls rest when a figure begins, in the frame of its start; by Side.
using StartPlaces = std::array<std::optional<glm::vec2>, 2>;

/// One figure danced once, from kMargin before its count 1 to kMargin after its end, with planted
/// feet, in the frame of its start. Immutable once made.
class FigurePassage {
 public:
    /// Beats before and after, over which it goes over into its neighbours.
    static constexpr double kMargin = 0.75;

    /// Carries the tracks over to `skeleton` along `way`. The feet step as in `steps` (the tracks
    /// as learnt) and rest, each time, a little aside, as `random` says (none: not); where the
    /// figure begins and ends at `places`. Threads: workers.
    /// Real-time: no (some ms).
    FigurePassage(const FigureModel& model,
                  const FigureTracks& steps,
                  const FigureTracks& tracks,
                  const FigureWay& way,
                  const StartPlaces& places,
                  const CounterRandom* random,
                  const Skeleton& skeleton);

    /// The same tracks as they are: feet free, no contacts.
    FigurePassage(const FigureModel& model,
                  const FigureTracks& tracks,
                  const FigureWay& way,
                  const Skeleton& skeleton);

    /// Sets hips, body and contacts of `pose` at a beat in [-kMargin, beats + kMargin] (clamped);
    /// fingers stay. Threads: any. Real-time: yes.
    void at(double beat, Pose& pose) const noexcept;
    /// Arms alone. Threads: any. Real-time: yes.
    void arms_at(double beat, Pose& pose) const noexcept;

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
    /// Takes the figure with its margins out of poses that begin kAround beats before it.
    void keep(const std::vector<Pose>& poses, int samples_per_beat);

    double samples_per_beat_ = 48.0;
    std::vector<Sample> samples_;
};

/// Where the balls rest around the start of this figure when it is danced as learnt.
[[nodiscard]] StartPlaces learnt_places(const FigureModel& model,
                                        const FigureTracks& tracks,
                                        const FigureWay& way,
                                        const Skeleton& skeleton);

}  // namespace raks::motion
