// Figure sequence: joins figures into one continuous dance.
#pragma once

#include <cstdint>
#include <limits>
#include <memory>
#include <optional>

#include "base/beats.hpp"
#include "base/realtime.hpp"
#include "motion/dance/dance_content.hpp"
#include "motion/dance/dancer_part.hpp"

namespace raks::motion {

/// A dance as a row of figures over one continuous phase. It keeps the present figure, the one
/// before and, from kDecided beats before the end, the next one. Within FigurePassage::kMargin
/// beats on either side of a change (half a figure of one beat) both figures are danced and
/// averaged (Ofli 2008, 5); feet are averaged by their places. A foot that the two figures plant
/// apart takes a step over; one that the next figure still has in the air moves over until that
/// figure plants it. Figures are danced left for right where the dance's habits say so: one goes on
/// with the foot that is free, or the weight goes back in the last beat of the figure before. To
/// calm music some figures are danced at half the tempo.
/// Threads: one. Real-time: yes.
class FigureSequence {
 public:
    /// Beats before its end at which the next figure is chosen
    static constexpr double kDecided = 2.0;

    /// Begins with the library's first figure, its count 1 at phase 0. `stage`: from a figure's
    /// start to the world. `stands_turned`: an earlier dance left the dancer half a turn away.
    void start(const DanceContent& content,
               const FloorMove& stage,
               const DancerPart& part,
               bool stands_turned) noexcept RAKS_NONBLOCKING;

    /// The tempo for figures chosen from here on: at a fast one they may be smaller.
    void set_tempo(Bpm tempo) noexcept { tempo_ = tempo; }
    /// Advances to a phase: changes to the next figure when it is due and chooses the one after.
    /// `energy`: of the music, [0, 1]. `wish`: cleared as far as it was granted.
    void advance(Beats phase, double energy, FigureWish& wish) noexcept RAKS_NONBLOCKING;
    /// The phase was re-anchored as a figure ended: goes on with the first figure, which hardly
    /// turns and travels, at the beat of it that fits the phase.
    void jump(Beats phase) noexcept RAKS_NONBLOCKING;

    /// Goes on with the same figures of another library, which has the same in the same order.
    void go_on_in(const DanceContent& content, const FloorMove& stage) noexcept {
        content_ = content_ != nullptr ? &content : nullptr;
        stage_ = stage;
    }

    /// The pose in the world at a phase up to kDecided after the last advance. Hands may be inside
    /// the body: see clear_hands().
    [[nodiscard]] Pose at(Beats phase, const Manner& manner = {}) const noexcept RAKS_NONBLOCKING;

    /// The present figure.
    [[nodiscard]] const LibraryFigure& figure() const noexcept {
        return content_->figures[current_.choice.figure];
    }
    /// Beats since the present figure's count 1.
    [[nodiscard]] double beat(Beats phase) const noexcept {
        return (phase.count() - current_.start) / current_.stretch;
    }
    /// Beats of the phase for each beat of the present figure: 2 at half the tempo, else 1.
    [[nodiscard]] double stretch() const noexcept { return current_.stretch; }
    /// The phase at which the present figure ends.
    [[nodiscard]] Beats end() const noexcept { return Beats(end_of(current_)); }
    /// Whether the present figure is danced left for right.
    [[nodiscard]] bool is_mirrored() const noexcept { return current_.choice.is_mirrored; }
    /// Whether the present figure began half a turn away from the first.
    [[nodiscard]] bool is_turned() const noexcept { return current_.is_turned; }
    /// How many figures were begun before this one.
    [[nodiscard]] std::uint64_t number() const noexcept { return number_; }

 private:
    /// When a foot moves from one figure's place to the next's; beats from the change. `from` equal
    /// to `to`: together with the body.
    struct FootJoin {
        double from = 0.0;
        double to = 0.0;
        bool is_lifted = false;  // by an added step, as neither figure steps with it then
        // From this beat on the foot keeps the place that the last figure gave it, until `from`.
        double held = std::numeric_limits<double>::infinity();
        bool is_planted = false;  // it stands there meanwhile, whatever the last figure does
        [[nodiscard]] double lasts() const noexcept { return to - from; }
    };
    /// What one foot does in both figures around the change between them.
    struct FootState {
        float apart = 0.0F;  ///< largest distance between its places while it rests in both; metres
        std::array<FootJoin, 2> swings{};  ///< by figure: its longest swing
        std::array<double, 2> since{};  ///< by figure: when it rested last; beats from the change
    };
    struct Danced {
        FigureChoice choice;
        double start = 0.0;  // phase of its count 1
        bool is_turned = false;
        std::array<FootJoin, 2> feet{};  // how each foot came from the figure before
        bool changes_foot = false;       // begins on the foot that carried the figure before
        double stretch = 1.0;            // beats of the phase for each of the figure
    };
    [[nodiscard]] FigureChoice choose(std::size_t figure, std::uint64_t number) const noexcept;
    /// The foot that its first step is danced with.
    [[nodiscard]] std::optional<Side> leading_foot(const Danced& danced) const noexcept;
    /// Decides whether the next figure is danced at half the tempo.
    void take_tempo(Danced& next, double energy, bool is_locked) const noexcept;
    /// Decides whether the next figure is danced left for right.
    void take_side(Danced& next, bool is_locked) const noexcept;
    /// Whether both feet stand, and near enough in both figures for the weight to go back.
    [[nodiscard]] bool can_change_foot(const Danced& before, const Danced& after) const noexcept;
    [[nodiscard]] std::array<FootState, 2> states_of_feet(const Danced& before,
                                                          const Danced& after) const noexcept;
    [[nodiscard]] FootJoin foot_join(const Danced& before,
                                     const Danced& after,
                                     Side side,
                                     const FootState& foot) const noexcept;
    /// When the figure plants a foot that is in the air at `margin`; beats after its start. None:
    /// the foot stands at `margin` already, or is planted later than a join may last.
    [[nodiscard]] std::optional<double> standing_from(const Danced& danced,
                                                      Side side,
                                                      double margin) const noexcept;
    [[nodiscard]] double end_of(const Danced& danced) const noexcept RAKS_NONBLOCKING;
    [[nodiscard]] bool turned_after(const Danced& danced) const noexcept;
    [[nodiscard]] Pose pose_of(const Danced& danced,
                               double phase,
                               const Manner& manner) const noexcept;
    /// How a foot joins where the dancer goes over to the foot that carried.
    [[nodiscard]] FootJoin foot_join_to_other_foot(const Danced& after,
                                                   Side side,
                                                   const FootState& foot) const noexcept;
    /// Beats on either side of a change in which both figures are danced; short enough that two
    /// joins never meet.
    [[nodiscard]] double margin_between(const Danced& before, const Danced& after) const noexcept;
    /// Beats after a change, from and to which the body goes over.
    [[nodiscard]] std::array<double, 2> body_join(const Danced& before,
                                                  const Danced& after) const noexcept;
    /// Beats after a change until which a foot may still be on its way.
    [[nodiscard]] double joined_until(const Danced& before, const Danced& after) const noexcept;
    [[nodiscard]] Pose joined(const Danced& before,
                              const Danced& after,
                              double phase,
                              const Manner& manner) const noexcept;

    const DanceContent* content_ = nullptr;
    Bpm tempo_{120.0};
    FloorMove stage_;
    // Of its part, which itself owns memory.
    std::uint64_t seed_ = 1;
    std::uint64_t ways_ = 1;
    bool is_in_couple_ = false;
    bool mirrors_ = false;
    bool slows_ = false;
    std::uint64_t number_ = 0;
    std::optional<Danced> before_;
    Danced current_;
    std::optional<Danced> next_;
};

/// Move from a figure's start to the world, for a dancer who stands half a turn away or not.
/// Threads: any. Real-time: yes.
[[nodiscard]] FloorMove floor_of(const DanceContent& content,
                                 const FloorMove& stage,
                                 bool is_turned) noexcept RAKS_NONBLOCKING;

}  // namespace raks::motion
