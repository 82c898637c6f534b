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
    bool has_heard_ = false;
};

/// What the user wants of the next figure.
struct FigureWish {
    bool is_another = false;            ///< not this one again
    std::optional<std::size_t> figure;  ///< this one
    bool is_locked = false;             ///< the same for as long as it lasts
};

/// Which figure comes next: by the grammar's weights, more often one as lively as the music. Drawn
/// by (seed, number of the figure): the same dance again from the same seed and music.
/// Threads: any. Real-time: next yes.
class Choreography {
 public:
    Choreography() = default;
    explicit Choreography(FigureGrammar grammar) : grammar_(std::move(grammar)) {}

    [[nodiscard]] std::size_t next(std::size_t current,
                                   double energy,
                                   const FigureWish& wish,
                                   std::uint64_t seed,
                                   std::uint64_t number) const noexcept;

 private:
    FigureGrammar grammar_;
};

}  // namespace raks::motion
