#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "base/beats.hpp"
#include "base/random.hpp"
#include "motion/choreography/authored_dance.hpp"

/// What the steps of an evaluation share: which repeats, which frames, how large, how varied.
namespace raks::motion {

/// Streams of random numbers of one evaluation: `kind` x 64 + which.
enum class Draw : std::uint64_t { clock, arm_clock, track, repeat, places };

struct RepeatPlan {
    const AuthoredFigure* figure = nullptr;  ///< never null
    Bpm tempo{120.0};
    double size = 1.0;   ///< of waves and steps, by the tempo
    double noise = 1.0;  ///< 0: every repeat the same
    std::uint64_t seed = 0;
    double frames_per_second = 60.0;
    int first_repeat = 0;  ///< steps and keys are laid out from here
    int last_repeat = 0;   ///< to the end of this one

    std::vector<double> music_beats;  ///< by frame: the music's
    std::vector<double> beats;        ///< by frame: the dancer's own beat, wandering
    std::vector<double> arm_beats;    ///< of arms, hands and head

    [[nodiscard]] std::size_t frames() const noexcept { return beats.size(); }
    /// Frames in so many beats, for filters.
    [[nodiscard]] double frames_of(double beats_long) const noexcept {
        return beats_long * tempo.seconds_per_beat() * frames_per_second;
    }
    [[nodiscard]] bool is_mirrored(int repeat) const noexcept {
        return figure->is_mirrored && (repeat % 2 != 0);
    }
    [[nodiscard]] CounterRandom random(Draw draw, std::uint64_t which = 0) const noexcept {
        constexpr std::uint64_t kMany = 4096;
        return CounterRandom(seed, static_cast<std::uint64_t>(draw) * kMany + which);
    }
    /// A number of a repeat, also of those before the first.
    [[nodiscard]] static std::uint64_t number_of(int repeat, std::uint64_t which) noexcept {
        constexpr std::uint64_t kMany = 4096;
        constexpr int kOrigin = 1024;
        return static_cast<std::uint64_t>(repeat + kOrigin) * kMany + which;
    }
};

/// How a figure is to be danced.
struct EvaluationOptions {
    Bpm written{120.0};  ///< the dance's own tempo, at which it has its full size
    Bpm tempo{120.0};
    int repeats = 4;
    double margin = 1.0;  ///< beats before the first and after the last repeat
    double frames_per_second = 60.0;
    double noise = 1.0;  ///< times the style's variation between repeats; 0: none
    std::uint64_t seed = 1;
};

[[nodiscard]] RepeatPlan plan_repeats(const AuthoredFigure& figure,
                                      const EvaluationOptions& options);

/// The value of a control at every frame: its tracks, mirrored in every other repeat of a mirrored
/// figure, lagging and varying as the style says.
[[nodiscard]] std::vector<double> control_values(const RepeatPlan& plan, Control control);

}  // namespace raks::motion
