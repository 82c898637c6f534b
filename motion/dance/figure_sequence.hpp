#pragma once

#include <cstdint>
#include <limits>
#include <memory>
#include <optional>

#include "base/beats.hpp"
#include "motion/dance/dance_content.hpp"
#include "motion/dance/dancer_part.hpp"

namespace raks::motion {

/// A dance as a row of figures over one continuous phase: the one that is danced, the one before
/// and, from kDecided beats before its end, the one that comes. Over FigurePassage::kMargin beats
/// on either side of a change (half a figure of one beat) both are danced and averaged (Ofli 2008,
/// 5), the feet by their places; a foot that the two plant apart steps over, one that the next
/// figure still has under way goes over until that plants it. Threads: one. Real-time: yes.
class FigureSequence {
 public:
    static constexpr double kDecided = 2.0;  ///< beats

    /// Begins with the library's first figure, its count 1 at phase 0. `stands_turned`: an
    /// earlier dance left the dancer half a turn away.
    void start(const DanceContent& content,
               const FloorMove& stage,
               const DancerPart& part,
               bool stands_turned) noexcept;

    /// At which figures are danced that are chosen from now on: they may be smaller when it is
    /// fast.
    void set_tempo(Bpm tempo) noexcept { tempo_ = tempo; }
    /// The phase went on to here: goes over into the next figure, chooses what follows.
    void advance(Beats phase, double energy, FigureWish& wish) noexcept;
    /// The phase was set anew as a figure ended: the first figure, which hardly turns and travels,
    /// from the beat of it that this is.
    void jump(Beats phase) noexcept;

    /// The pose at a phase up to kDecided after the last advance, in the world.
    [[nodiscard]] Pose at(Beats phase) const noexcept;

    [[nodiscard]] const LibraryFigure& figure() const noexcept {
        return content_->figures[current_.choice.figure];
    }
    /// Beats since its count 1.
    [[nodiscard]] double beat(Beats phase) const noexcept { return phase.count() - current_.start; }
    /// The phase at which it ends.
    [[nodiscard]] Beats end() const noexcept { return Beats(end_of(current_)); }
    /// Whether the figure that is danced began half a turn away from the first.
    [[nodiscard]] bool is_turned() const noexcept { return current_.is_turned; }
    /// How many figures were begun before this one.
    [[nodiscard]] std::uint64_t number() const noexcept { return number_; }

 private:
    /// When a foot goes over from one figure to the next; beats from the change, equal: as the body
    /// does.
    struct FootJoin {
        double from = 0.0;
        double to = 0.0;
        bool is_lifted = false;  // neither figure steps with it meanwhile: it steps over
        // From here on it stays over where the last figure had it, until it goes over.
        double held = std::numeric_limits<double>::infinity();
        [[nodiscard]] double lasts() const noexcept { return to - from; }
    };
    /// What a foot does in two figures about the change from one to the other.
    struct FootState {
        float apart = 0.0F;                ///< while it rests in both, at most; metres
        std::array<FootJoin, 2> swings{};  ///< by figure: the longest
        std::array<double, 2> since{};  ///< by figure: when it last rested; beats from the change
    };
    struct Danced {
        FigureChoice choice;
        double start = 0.0;  // phase of its count 1
        bool is_turned = false;
        std::array<FootJoin, 2> feet{};  // from the figure before
    };
    [[nodiscard]] FigureChoice choose(std::size_t figure, std::uint64_t number) const noexcept;
    [[nodiscard]] std::array<FootState, 2> states_of_feet(const Danced& before,
                                                          const Danced& after) const noexcept;
    [[nodiscard]] FootJoin foot_join(const Danced& before,
                                     const Danced& after,
                                     Side side,
                                     const FootState& foot) const noexcept;
    /// When the figure plants a foot that is under way at `margin`; beats after its start. None: it
    /// stands there then, or later than a join may last.
    [[nodiscard]] std::optional<double> standing_from(const Danced& danced,
                                                      Side side,
                                                      double margin) const noexcept;
    [[nodiscard]] double end_of(const Danced& danced) const noexcept;
    [[nodiscard]] bool turned_after(const Danced& danced) const noexcept;
    [[nodiscard]] Pose pose_of(const Danced& danced, double phase) const noexcept;
    /// Before hands are kept out of the body.
    [[nodiscard]] Pose free_at(double phase) const noexcept;
    /// Beats on either side of a change in which both are danced: two joins never meet.
    [[nodiscard]] double margin_between(const Danced& before, const Danced& after) const noexcept;
    /// Beats after a change until which a foot may still be on its way.
    [[nodiscard]] double joined_until(const Danced& before, const Danced& after) const noexcept;
    [[nodiscard]] Pose joined(const Danced& before,
                              const Danced& after,
                              double phase) const noexcept;

    const DanceContent* content_ = nullptr;
    Bpm tempo_{120.0};
    FloorMove stage_;
    DancerPart part_;
    std::uint64_t number_ = 0;
    std::optional<Danced> before_;
    Danced current_;
    std::optional<Danced> next_;
};

/// From where a figure starts to the world, for a dancer who stands turned or not.
[[nodiscard]] FloorMove floor_of(const DanceContent& content,
                                 const FloorMove& stage,
                                 bool is_turned) noexcept;

}  // namespace raks::motion
