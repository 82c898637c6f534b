// Landing error: how exactly steps come down with the music.
#pragma once

#include <cstddef>
#include <span>
#include <vector>

#include "motion/evaluate/body_track.hpp"
#include "motion/figures/figure_model.hpp"

namespace raks::motion {

/// One landing that was matched with a learnt one.
struct Landing {
    Side side = Side::left;  ///< which foot
    int count = 1;           ///< of the figure, 1..beats
    double time = 0.0;       ///< seconds from the track's first frame
    double error = 0.0;  ///< seconds after the learnt landing (count + offset); early is negative
    const FigureModel* figure = nullptr;  ///< danced then; never null in a report
};

/// Landings against the music: the measure of synchrony between feet and beats.
struct LandingReport {
    std::vector<Landing> landings;  ///< at counts where people land with that foot
    std::size_t unexpected = 0;     ///< landings at other counts
    std::size_t missing = 0;        ///< counts at which people land and this dance does not
    std::size_t off_beat = 0;       ///< landings learnt too far from a beat to be judged by it
    double mean = 0.0;              ///< of the errors; seconds
    double deviation = 0.0;         ///< standard deviation of the errors; seconds
    double within_80_ms = 0.0;      ///< share of the errors of at most 80 ms
};

/// Which learnt landings a dance is judged by.
struct JudgedLandings {
    int least_repeats = 3;  ///< of the figure that had the landing
    double farthest = 0.5;  ///< beats from its count; those beyond are LandingReport::off_beat
};

/// Computes the statistics of `landings`, for landings joined from several dances.
void summarize(LandingReport& report);

/// One count of a figure in the music.
struct AudibleCount {
    const FigureModel* figure = nullptr;  ///< that is danced then; never null
    std::size_t count = 0;                ///< from 0, < figure->beats
    double time = 0.0;                    ///< seconds from the track's first frame
    double beat = 0.0;                    ///< length of the beat, seconds
    bool is_mirrored = false;             ///< the figure is danced left for right
};

/// Detects where each foot comes down (foot_events.hpp: speed under 0.30 m/s after a step over
/// 0.60, 8 Hz) and compares that with the counts of the music plus the figure's learnt offset for
/// that foot and count.
///
/// `count_times`: seconds of the music's counts (not of the dancer's own phase), from a count 1 on,
/// ascending. Counts within 1 s of the track's ends are left out, as the low-pass needs motion on
/// both sides. A landing is matched with the nearest learnt one (count + offset), at most half a
/// beat away; a fixed window around each count would split steps that fall between two beats.
/// Offsets learnt from fewer landings than `judged` says, or of a foot that comes down twice a
/// count, are not expected. Threads: workers. Real-time: no.
[[nodiscard]] LandingReport landing_errors(const BodyTrack& track,
                                           const FigureModel& figure,
                                           std::span<const double> count_times,
                                           const JudgedLandings& judged = {});

/// The same for a dance whose figure or tempo changes: each count has its own figure. Threads:
/// workers. Real-time: no.
[[nodiscard]] LandingReport landing_errors(const BodyTrack& track,
                                           std::span<const AudibleCount> counts,
                                           const JudgedLandings& judged = {});

}  // namespace raks::motion
