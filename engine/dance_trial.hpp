#pragma once

#include <cstdint>
#include <memory>
#include <span>
#include <string>
#include <vector>

#include "audio/synth/music_generator.hpp"
#include "base/expected.hpp"
#include "motion/dancer.hpp"
#include "motion/evaluate/dance_measures.hpp"
#include "motion/evaluate/landing_error.hpp"
#include "motion/figures/figure_model.hpp"

/// Measuring the whole chain: generated music -> analyzer -> dancer -> poses at 60 a second.
namespace raks::engine {

enum class TrialKind : std::uint8_t {
    steady,  ///< one tempo
    ramp,    ///< the tempo rises or falls by 2 % a second; landings are judged meanwhile
    breaks,  ///< silences, and jumps of the tempo
};

struct DanceTrial {
    std::string name;  ///< "salsa-180"
    TrialKind kind = TrialKind::steady;
    audio::MusicPlan music;
    double judged_from = 0.0;  ///< seconds of the music in which landings count
    double judged_to = 1e9;
};

/// Steady music of 100 to 200 BPM (salsa from 160 on, other styles elsewhere), 60 s each; ramps up
/// and down; breaks.
[[nodiscard]] std::vector<DanceTrial> standard_trials();

struct TrialResult {
    motion::LandingReport landing;
    motion::DanceMeasures measures;  ///< while dancing, 4 s after each start on
    double highest_jerk = 0.0;       ///< of all, starting and settling too; m/s^3, by pace
    double lowest_sole = 0.0;        ///< ball, toe tip or heel of any pose over the floor; metres
    double danced_share = 0.0;       ///< of the time
    double pace = 0.0;               ///< mean tempo danced / learnt, while dancing
    int reanchors = 0;
};

/// Jerks are divided by the cube of the pace, speeds by the pace. Errors: those of the generator
/// and the offline driver. Threads: any. Real-time: no (a minute of music takes about 2 s).
[[nodiscard]] Expected<TrialResult> run_trial(
    const DanceTrial& trial,
    const std::shared_ptr<const motion::DanceLibrary>& library,
    std::span<const motion::FigureModel> models,
    std::uint64_t seed);

}  // namespace raks::engine
