// Figure passage: one figure, solved for the avatar's skeleton and sampled over its phase.
#pragma once

#include <array>
#include <bitset>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <optional>
#include <span>
#include <vector>

#include "base/beats.hpp"
#include "base/packer.hpp"
#include "base/random.hpp"
#include "base/realtime.hpp"
#include "motion/dance/baking/foot_lock.hpp"
#include "motion/dance/baking/free_figure.hpp"
#include "motion/figures/figure_model.hpp"
#include "motion/skeleton/pose.hpp"
#include "motion/skeleton/skeleton.hpp"

namespace raks::motion {

/// Where each foot's pivot rests when a figure begins: floor (x, z) in the frame of its start,
/// metres; by Side; none: the foot does not rest there.
using StartPlaces = std::array<std::optional<glm::vec2>, 2>;

/// How the feet of a passage step.
struct Footing {
    StartPlaces places;       ///< where feet rest at the start and end of every figure of the dance
    FigureLandings landings;  ///< where contacts begin
    /// The steps are means of repeats that differ, as those learnt from people
    bool is_mean = false;
    double reach = 0.75;  ///< beats; a contact begins at the nearest landing that is not farther
};

/// One way to dance one figure, from kMargin before its count 1 to kMargin after its end, with
/// planted feet, in the frame of its start (hips at the origin, heading 0). Immutable once made.
class FigurePassage {
 public:
    /// Beats before and after the figure, over which it is blended with its neighbours.
    static constexpr double kMargin = 0.75;

    /// The feet step as in `steps`. Each contact is shifted a little aside by draws from `random`
    /// (null: not shifted), but where the figure begins and ends the feet rest at the footing's
    /// places. `body`: the poses above the hips, as many as those of `steps`. Threads: workers.
    /// Real-time: no (some ms).
    FigurePassage(const FigureModel& model,
                  const FreeFigure& steps,
                  std::vector<Pose> body,
                  const FigurePath& way,
                  const Footing& footing,
                  const CounterRandom* random,
                  const Skeleton& skeleton);

    /// The figure as it is: feet are not planted, no contacts.
    explicit FigurePassage(const FreeFigure& figure);

    /// Negates a bone's quaternions (q and -q are the same rotation) where the first of them has a
    /// negative dot product with the first one of `other`; within a passage signs are continuous.
    /// Interpolation between the two passages then turns a bone the same way round over the whole
    /// figure. Threads: workers. Real-time: no.
    void take_signs_of(const FigurePassage& other);

    /// The same in half the memory, some 9 KB a beat: rotations to 1/32767 of a quaternion's
    /// components, which is less than 0.1 mm at the end of a limb. For whole takes, of which there
    /// are minutes. take_signs_of() must come before. Threads: workers. Real-time: no.
    [[nodiscard]] FigurePassage compact() const;

    /// Sets hips, body and contacts of `pose` at a beat in [-kMargin, beats + kMargin] (clamped);
    /// fingers stay. Threads: any. Real-time: yes.
    void at(double beat, Pose& pose) const noexcept RAKS_NONBLOCKING;
    /// Sets the arms' rotations alone, at such a beat. Threads: any. Real-time: yes.
    void arms_at(double beat, Pose& pose) const noexcept RAKS_NONBLOCKING;

    /// Appends the samples in this machine's byte order, for a cache. Threads: any. Real-time: no.
    void pack(Packer& packer) const;
    /// Reads what pack() wrote, without a copy: the samples stay in the unpacker's bytes, which
    /// `owner` keeps alive. After a fault of `unpacker` the passage is incomplete and must not be
    /// used: check unpacker.is_good().
    [[nodiscard]] static FigurePassage unpack(Unpacker& unpacker,
                                              std::shared_ptr<const void> owner);
    /// Whether there are the samples of a figure of so many beats, with its margins: a passage that
    /// was unpacked may have others. Threads: any. Real-time: no.
    [[nodiscard]] bool covers(int beats) const noexcept;

    /// The bones that a passage moves, hips and trunk first, then legs; the arms are the last
    /// kArmBones.
    static constexpr std::size_t kArmBones = 8;
    /// In this order.
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
        // Bytes: a cache may hold any number, which no bool can have.
        std::array<std::uint8_t, 2> contact{};
        std::array<bool, 2> unused{};  // instead of padding, so that a cache holds defined bytes
    };
    static_assert(sizeof(Sample) == 4 * (kBones.size() * 4 + 3) + 4);
    /// Of compact(): w, x, y, z in steps of 1 / 32767.
    struct CompactSample {
        std::array<std::array<std::int16_t, 4>, kBones.size()> rotations;
        std::array<float, 3> hips{};
        std::array<std::uint8_t, 2> contact{};  // as above
        std::array<bool, 2> unused{};           // as above
    };
    static_assert(sizeof(CompactSample) == 2 * (kBones.size() * 4) + 16);
    /// Of a beat: the samples around it, and how far it lies from the first to the second.
    struct Place {
        std::size_t before;
        float share;
    };
    [[nodiscard]] Place place_of(double beat) const noexcept;
    [[nodiscard]] std::size_t count() const noexcept { return samples_.size() + compact_.size(); }
    template <typename Samples>
    static void set_body(const Samples& samples, const Place& place, Pose& pose) noexcept;
    template <typename Samples>
    static void set_rotations(const Samples& samples,
                              const Place& place,
                              std::size_t first,
                              Pose& pose) noexcept;
    /// Keeps the figure with its margins out of `poses`, which begin kBeatsAround beats before it,
    /// and makes the signs of each bone's quaternions continuous.
    void keep(const std::vector<Pose>& poses, int samples_per_beat);
    void set_samples(std::vector<Sample> samples);

    double samples_per_beat_ = 48.0;
    std::span<const Sample> samples_;         // or
    std::span<const CompactSample> compact_;  // those of compact()
    std::shared_ptr<const void> owner_;  // of the samples: a list, or the bytes of a cached file
};

/// Where the feet rest around the start of this figure when it is danced as learnt: mean over the
/// contact samples within kMargin of the start. Threads: workers. Real-time: no.
[[nodiscard]] StartPlaces learnt_places(const FigureModel& model,
                                        const FigureTracks& tracks,
                                        const FigurePath& way,
                                        const Skeleton& skeleton);

// Arm mixes: which passages' arms may be averaged.

/// Number of passages (ways to dance it) of each figure.
inline constexpr std::size_t kWays = 8;

/// Whether the arms of passages a and b of a figure can be mixed: [a][b].
using ArmMixes = std::array<std::bitset<kWays>, kWays>;

/// Two passages' arms can be mixed when no bone of theirs is ever 120 degrees or more apart; beyond
/// that the shorter way round would soon change. Their quaternions' signs must agree
/// (take_signs_of). `passages`: at most kWays, of a figure of `beats`. Threads: workers. Real-time:
/// no.
[[nodiscard]] ArmMixes arm_mixes(std::span<const FigurePassage> passages, int beats);

}  // namespace raks::motion
