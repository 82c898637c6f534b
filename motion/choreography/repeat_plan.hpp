#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "base/beats.hpp"
#include "base/random.hpp"
#include "motion/choreography/authored_dance.hpp"

/// Repeat plan: what all stages of an evaluation share: repeats, frames, clocks, size and noise.
namespace raks::motion {

/// Purposes of random numbers in one evaluation; each has streams of its own.
enum class Draw : std::uint64_t { clock, arm_clock, track, repeat, places };

/// One evaluation of a figure over several repeats.
struct RepeatPlan {
    const AuthoredFigure* figure = nullptr;  ///< never null
    Bpm tempo{120.0};                        ///< at which it is danced
    double size = 1.0;                       ///< factor of waves and steps, by the tempo
    double noise = 1.0;                      ///< factor of all noise; 0: all repeats are equal
    std::uint64_t seed = 0;                  ///< of all random numbers
    double frames_per_second = 60.0;         ///< of the frames below
    int first_repeat = 0;                    ///< from which steps and keys are laid out; negative
    int last_repeat = 0;                     ///< to which they are laid out, inclusive

    std::vector<double> music_beats;  ///< by frame: the music's beat
    std::vector<double> beats;        ///< by frame: the dancer's beat, with timing noise
    std::vector<double> arm_beats;    ///< by frame: the same for arms, hands and head

    /// Number of frames.
    [[nodiscard]] std::size_t frames() const noexcept { return beats.size(); }
    /// Frames in a duration of `beats_long` beats.
    [[nodiscard]] double frames_of(double beats_long) const noexcept {
        return beats_long * tempo.seconds_per_beat() * frames_per_second;
    }
    /// Whether this repeat is danced as a mirror image.
    [[nodiscard]] bool is_mirrored(int repeat) const noexcept {
        return figure->is_mirrored && (repeat % 2 != 0);
    }
    /// The stream `which` (below 4096) of a purpose.
    [[nodiscard]] CounterRandom random(Draw draw, std::uint64_t which = 0) const noexcept {
        constexpr std::uint64_t kMany = 4096;
        return CounterRandom(seed, static_cast<std::uint64_t>(draw) * kMany + which);
    }
    /// Index into a stream for number `which` of a repeat; repeats may be negative.
    [[nodiscard]] static std::uint64_t number_of(int repeat, std::uint64_t which) noexcept {
        constexpr std::uint64_t kMany = 4096;
        constexpr int kOrigin = 1024;
        return static_cast<std::uint64_t>(repeat + kOrigin) * kMany + which;
    }
};

/// How a figure is to be danced.
struct EvaluationOptions {
    Bpm written{120.0};               ///< the dance's own tempo, at which it has its written size
    Bpm tempo{120.0};                 ///< at which it is danced
    int repeats = 4;                  ///< at least 1
    double margin = 1.0;              ///< beats before the first and after the last repeat
    double frames_per_second = 60.0;  ///< of the poses
    double noise = 1.0;               ///< factor of the style's noise; 0: none
    std::uint64_t seed = 1;           ///< same seed, same bits
};

/// Plans an evaluation; `figure` must outlive the plan. Threads: any. Real-time: no.
[[nodiscard]] RepeatPlan plan_repeats(const AuthoredFigure& figure,
                                      const EvaluationOptions& options);

/// The value of a control at every frame, in its own unit: the sum of its tracks (mirrored in every
/// other repeat of a mirrored figure), with the style's lags and noise. Threads: any. Real-time:
/// no.
[[nodiscard]] std::vector<double> control_values(const RepeatPlan& plan, Control control);

}  // namespace raks::motion
