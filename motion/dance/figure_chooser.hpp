// Figure chooser: which figure comes next.
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <utility>
#include <vector>

#include "base/realtime.hpp"
#include "motion/figures/figure_grammar.hpp"

namespace raks::motion {

/// What the user wants of the next figure.
struct FigureWish {
    bool is_another = false;            ///< any but the present one
    std::optional<std::size_t> figure;  ///< this one; index in the grammar's rules
    bool is_locked = false;             ///< repeat the present one as long as it is set
};

/// Where the audience is, seen by the dancer as a figure begins.
enum class Audience : std::uint8_t {
    none,    ///< one of a couple dances for the other
    ahead,   ///< seen from the front
    behind,  ///< seen from the back
};

/// The moment for which a figure is chosen.
struct FigureMoment {
    std::size_t after = 0;               ///< the figure that it comes after
    double energy = 0.5;                 ///< of the music, [0, 1]
    Audience audience = Audience::none;  ///< side from which the dancer is seen
};

/// Chooses the next figure by the grammar's weights, favouring figures as lively as the music and
/// those that end facing the audience. The draw depends on (seed, number of the figure), so the
/// same seed and music give the same dance. Threads: any. Real-time: next yes.
class FigureChooser {
 public:
    FigureChooser() = default;  ///< of no grammar; next() must not be called
    /// `turns_half`: by figure, whether it ends half a turn from where it began.
    FigureChooser(FigureGrammar grammar, std::vector<bool> turns_half)
        : grammar_(std::move(grammar)), turns_half_(std::move(turns_half)) {}

    /// Of a dance without figures, in which dancers have habits all the same; next() must not be
    /// called.
    [[nodiscard]] static FigureChooser without_figures(const DanceHabits& habits) {
        FigureChooser chooser;
        chooser.grammar_.habits = habits;
        return chooser;
    }

    /// What the dancers do beside the figures.
    [[nodiscard]] const DanceHabits& habits() const noexcept { return grammar_.habits; }

    /// Index of the next figure; `number`: how many figures were begun. A wished figure comes
    /// first, then the lock.
    [[nodiscard]] std::size_t next(const FigureMoment& moment,
                                   const FigureWish& wish,
                                   std::uint64_t seed,
                                   std::uint64_t number) const noexcept RAKS_NONBLOCKING;

 private:
    [[nodiscard]] double weight(std::size_t figure, const FigureMoment& moment) const noexcept;

    FigureGrammar grammar_;
    std::vector<bool> turns_half_;
};

}  // namespace raks::motion
