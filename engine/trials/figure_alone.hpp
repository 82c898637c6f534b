#pragma once

#include <cstddef>
#include <cstdint>
#include <memory>
#include <span>
#include <string>
#include <vector>

#include "base/beats.hpp"
#include "base/expected.hpp"
#include "motion/choreography/figure_measures.hpp"
#include "motion/dancer.hpp"

/// One figure by itself: the dancer repeats it on a beat that is known exactly, so that only the
/// motion is measured and not the tracker.
namespace raks::engine {

/// Which figure is danced, and the music that it is danced to.
struct FigureOnBeat {
    std::size_t figure = 0;  ///< index in the library
    Bpm tempo{120.0};        ///< steady
    int beats_per_bar = 4;   ///< of the music's bars
    std::uint64_t seed = 1;  ///< of the dancer's random choices
};

/// The poses at `beats` (ascending, from -2 on), where beat 0 is a count 1 of the figure at which
/// the dancer has settled into it. Errors: those of Dancer::prepare. Threads: workers. Real-time:
/// no (some 10 ms a second).
[[nodiscard]] Expected<std::vector<motion::Pose>> dance_alone(
    const std::shared_ptr<const motion::DanceLibrary>& library,
    const motion::Skeleton& skeleton,
    const FigureOnBeat& on,
    std::span<const double> beats);

/// A figure of a written dance, danced from its trained model and measured.
struct DancedWrittenFigure {
    std::string name;                 ///< of the figure
    motion::TakeMeasures measures;    ///< over twelve repeats at the written tempo
    std::vector<std::string> faults;  ///< faults_in_measures against its file, faults_in_poses
};

/// Dances every figure of a written dance twelve times at its written tempo and compares the
/// measures with config/choreographies/DANCE.toml. Empty where the dance was captured and not
/// written. Errors: a file that cannot be read, a library that lacks a figure of the file. Threads:
/// workers. Real-time: no (some seconds).
[[nodiscard]] Expected<std::vector<DancedWrittenFigure>> danced_written_figures(
    const std::string& dance,
    const std::shared_ptr<const motion::DanceLibrary>& library,
    const motion::Skeleton& skeleton,
    std::uint64_t seed = 1);

}  // namespace raks::engine
