#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "audio/music/generator/music_generator.hpp"
#include "base/expected.hpp"
#include "engine/setup/analyzer_setup.hpp"
#include "engine/setup/dancers.hpp"
#include "motion/evaluate/dance_measures.hpp"
#include "motion/evaluate/landing_error.hpp"
#include "motion/figures/figure_model.hpp"

/// Measures the whole chain: generated music -> analyzer -> dancer -> poses at 60 a second.
namespace raks::engine {

/// What the tempo of a trial's music does.
enum class TrialKind : std::uint8_t {
    steady,  ///< one tempo
    ramp,    ///< the tempo rises or falls by 2 % a second; landings are judged meanwhile
    breaks,  ///< silences, and jumps of the tempo
};

/// One piece of generated music and what is judged in it.
struct DanceTrial {
    std::string name;                    ///< "salsa-180"
    TrialKind kind = TrialKind::steady;  ///< decides which bounds apply
    audio::MusicPlan music;              ///< what the generator makes
    double judged_from = 0.0;            ///< seconds of the music in which landings count
    double judged_to = 1e9;              ///< end of that stretch
};

/// The trials of a dance; `learnt`: its learnt tempo. In full: steady music of 100 to 200 BPM (the
/// dance's own style from 160 on, other styles below), 60 s each; ramps up and down; breaks. In
/// brief: music of the dance's own style at 0.85, 1 and 1.15 of the learnt tempo, ramps between
/// those, silences.
[[nodiscard]] std::vector<DanceTrial> standard_trials(const DanceInfo& dance, Bpm learnt);

/// Measures of a couple, over the frames in which it dances and has settled.
struct CoupleResult {
    double hands_p90 = 0.0;     ///< of the hands that hold one another, in the basic; metres
    double facing_p90 = 0.0;    ///< how far either looks past the other, in the basic; radians
    double closest = 0.0;       ///< skin to skin, in all figures; metres, negative: overlap
    std::string closest_in;     ///< the figure in which that was
    double overlapping = 0.0;   ///< share of the time in which the bodies overlap
    double held = 0.0;          ///< share of the time in which at least one pair of palms is held
    double palms_median = 0.0;  ///< between the palms of a pair while it is held; metres
    double palms_p90 = 0.0;     ///< the same, 90th percentile
    /// Range of the height of the lead's left palm with the follow's right one while they are held,
    /// 5th to 95th percentile; metres. A closed frame is steady.
    double held_height = 0.0;
};

/// Rate at which all measures are taken, so that they compare with those of captured dances.
inline constexpr double kTrialPosesPerSecond = 60.0;

/// What was measured in one trial.
struct TrialResult {
    motion::LandingReport landing;   ///< landings against the beats of the music
    motion::DanceMeasures measures;  ///< while dancing, from 4 s after each start
    double highest_jerk = 0.0;       ///< of all frames, starts and stops too; m/s^3, by pace
    double lowest_sole = 0.0;        ///< ball, toe tip or heel of any pose over the floor; metres
    double hand_clearance = 0.0;     ///< least of a hand from the body, negative: inside; metres
    double joint_excess = 0.0;       ///< greatest angle beyond worst_joint()'s limits; degrees
    double danced_share = 0.0;       ///< of the time
    double pace = 0.0;               ///< mean tempo danced / learnt, while dancing
    int reanchors = 0;               ///< how often the dancer set its phase anew
    std::optional<CoupleResult> couple;  ///< none when one dances alone
    std::vector<motion::Pose> poses;     ///< of the measured dancer, kTrialPosesPerSecond
};

/// Who dances a trial, alone or as a couple, and which of them is measured.
struct TrialCast {
    AnalyzerModels models;              ///< of the analyzer
    Cast cast;                          ///< one or two members
    std::size_t measured = 0;           ///< index of the measured member
    motion::JudgedLandings landings{};  ///< that are judged

    /// The body of the measured member.
    [[nodiscard]] const motion::Skeleton& skeleton() const noexcept {
        return cast[measured].body.skeleton;
    }
};

/// Runs and measures one trial. `models`: the trained figures that the dance is measured against.
/// Jerks are divided by the cube of the pace (tempo danced / learnt), speeds by the pace. Errors:
/// those of the generator and of the offline driver. Threads: any. Real-time: no (a minute of music
/// takes about 2 s).
[[nodiscard]] Expected<TrialResult> run_trial(const DanceTrial& trial,
                                              const TrialCast& cast,
                                              std::span<const motion::FigureModel> models);

}  // namespace raks::engine
