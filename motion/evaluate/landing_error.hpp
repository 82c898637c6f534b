#pragma once

#include <cstddef>
#include <span>
#include <vector>

#include "motion/evaluate/body_track.hpp"
#include "motion/figures/figure_model.hpp"

namespace raks::motion {

/// One step that came down.
struct Landing {
    Side side = Side::left;
    int count = 1;       ///< of the figure, 1..beats
    double time = 0.0;   ///< seconds from the track's first frame
    double error = 0.0;  ///< seconds after count + learnt offset; early is negative
    const FigureModel* figure = nullptr;  ///< never null in a report
};

/// Landings against the music: DESIGN 5's measure of synchrony.
struct LandingReport {
    std::vector<Landing> landings;  ///< those at counts where people land with that foot
    std::size_t unexpected = 0;     ///< landings at any other count
    std::size_t missing = 0;        ///< counts where people land and this dance did not
    double mean = 0.0;              ///< of the errors; seconds
    double deviation = 0.0;         ///< standard deviation of the errors; seconds
    double within_80_ms = 0.0;      ///< share
};

/// Fills in what follows from `landings`: for those of several dances.
void summarize(LandingReport& report);

/// One count of a figure as it sounded.
struct AudibleCount {
    const FigureModel* figure = nullptr;  ///< danced then; never null
    std::size_t count = 0;                ///< from 0, < figure->beats
    double time = 0.0;                    ///< seconds from the track's first frame
    double beat = 0.0;                    ///< seconds to the next count
};

/// Where each foot comes down (foot_events.hpp: speed under 0.30 m/s after a step over 0.60, 8 Hz)
/// against the counts of the music and the figure's learnt offset for that foot and count.
///
/// `count_times`: seconds of the counts heard, from a count 1 on, ascending; not the dancer's own
/// phase. Counts near the track's ends (1 s) are left out: the low-pass has no future there. A
/// landing belongs to the learnt one (count + offset) that is nearest, at most half a beat away:
/// steps between the beats lie where the windows of two counts meet. Offsets learnt from less than
/// `least_repeats` landings are not expected, nor where a foot comes down twice a count.
/// Threads: workers. Real-time: no.
[[nodiscard]] LandingReport landing_errors(const BodyTrack& track,
                                           const FigureModel& figure,
                                           std::span<const double> count_times,
                                           int least_repeats = 3);

/// The same where the figure, or the tempo, changes on the way: each count with its own figure.
[[nodiscard]] LandingReport landing_errors(const BodyTrack& track,
                                           std::span<const AudibleCount> counts,
                                           int least_repeats = 3);

}  // namespace raks::motion
