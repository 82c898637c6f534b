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

/// A figure by itself: what the dancer makes of it again and again, on a beat that is known
/// exactly.
namespace raks::engine {

struct FigureOnBeat {
    std::size_t figure = 0;  ///< of the library
    Bpm tempo{120.0};
    int beats_per_bar = 4;
    std::uint64_t seed = 1;
};

/// The poses at `beats` (ascending, from -2 on), counted from a count 1 of the figure by which the
/// dancer has settled into it.
/// Errors: those of Dancer::prepare. Threads: workers. Real-time: no (some 10 ms a second).
[[nodiscard]] Expected<std::vector<motion::Pose>> dance_alone(
    const std::shared_ptr<const motion::DanceLibrary>& library,
    const motion::Skeleton& skeleton,
    const FigureOnBeat& on,
    std::span<const double> beats);

/// A figure of a written dance, as it is danced from its model.
struct DancedWrittenFigure {
    std::string name;
    motion::TakeMeasures measures;
    std::vector<std::string> faults;  ///< faults_in_measures against its file, faults_in_poses
};

/// Every figure of a dance twelve times at its written tempo, against
/// config/choreographies/DANCE.toml. Empty where a dance was not written but captured. Errors: a
/// file that cannot be read, a library without one of the file's figures. Threads: workers.
/// Real-time: no (some seconds).
[[nodiscard]] Expected<std::vector<DancedWrittenFigure>> danced_written_figures(
    const std::string& dance,
    const std::shared_ptr<const motion::DanceLibrary>& library,
    const motion::Skeleton& skeleton,
    std::uint64_t seed = 1);

}  // namespace raks::engine
