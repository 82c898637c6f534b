#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <utility>
#include <vector>

#include "base/music_state.hpp"
#include "motion/figures/figure_grammar.hpp"

namespace raks::motion {

/// How lively the music is beside what it has been: follows the loudness of about two bars against
/// that of the last half minute. Threads: one. Real-time: yes.
class MusicEnergy {
 public:
    void advance(const MusicState& music) noexcept;
    /// [0, 1]; 0.5 is as usual.
    [[nodiscard]] double value() const noexcept;
    void reset() noexcept { *this = MusicEnergy(); }

 private:
    double now_ = 0.0;    // LUFS, smoothed
    double usual_ = 0.0;  // LUFS, of the last half minute
    bool is_started_ = false;
};

/// What the user wants of the next figure.
struct FigureWish {
    bool is_another = false;            ///< not this one again
    std::optional<std::size_t> figure;  ///< this one
    bool is_locked = false;             ///< the same for as long as it lasts
};

/// Where those are for whom one dances, seen by the dancer as a figure begins.
enum class Audience : std::uint8_t {
    none,    ///< one of a couple dances for the other
    ahead,   ///< seen from the front
    behind,  ///< seen from the back
};

/// For when a figure is chosen.
struct FigureMoment {
    std::size_t after = 0;  ///< the figure that it comes after
    double energy = 0.5;    ///< of the music, [0, 1]
    Audience audience = Audience::none;
};

/// Which figure comes next: by the grammar's weights, more often one as lively as the music, and
/// one that ends towards the audience. Drawn by (seed, number of the figure): the same dance again
/// from the same seed and music. Threads: any. Real-time: next yes.
class FigureChooser {
 public:
    FigureChooser() = default;
    /// `turns_half`: by figure, whether it ends half a turn from where it began.
    FigureChooser(FigureGrammar grammar, std::vector<bool> turns_half)
        : grammar_(std::move(grammar)), turns_half_(std::move(turns_half)) {}

    [[nodiscard]] std::size_t next(const FigureMoment& moment,
                                   const FigureWish& wish,
                                   std::uint64_t seed,
                                   std::uint64_t number) const noexcept;

 private:
    [[nodiscard]] double weight(std::size_t figure, const FigureMoment& moment) const noexcept;

    FigureGrammar grammar_;
    std::vector<bool> turns_half_;
};

}  // namespace raks::motion
