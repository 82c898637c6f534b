#pragma once

#include <optional>
#include <span>
#include <string>
#include <vector>

#include "motion/evaluate/dance_metrics.hpp"
#include "motion/evaluate/repeat_measures.hpp"

/// Dance measures: all metrics of this folder, except landings, for one dance; the same ones for
/// people and for the dancer.
namespace raks::motion {

/// One whole repeat of a figure.
struct FigureRepeatTimes {
    std::string figure;               ///< name
    std::vector<double> count_times;  ///< seconds: its counts and the next figure's count 1
};

/// Measures of the repeats of one figure.
struct FigureMeasures {
    std::string figure;                 ///< name
    std::vector<Amplitude> amplitudes;  ///< by repeat
    std::vector<FigureShape> shapes;    ///< by repeat
};

/// Measures of one dance, or of several pooled.
struct DanceMeasures {
    JerkReport jerk;                      ///< dance_metrics.hpp
    ContactReport contacts;               ///< dance_metrics.hpp
    double peak_toe_speed = 0.0;          ///< divided by the pace; m/s
    double bas_motion = 0.0;              ///< beat alignment in FACT's form
    double bas_music = 0.0;               ///< beat alignment in Bailando's form
    double pfc = 0.0;                     ///< physical foot contact (published_metrics.hpp)
    double skating_ratio = 0.0;           ///< published_metrics.hpp
    std::vector<FigureMeasures> figures;  ///< one a name, in the order of their first repeats
};

/// What is measured of a track.
struct DanceSubject {
    MetricFrames frames;                     ///< that count, and their pace
    std::vector<FigureRepeatTimes> repeats;  ///< whole repeats of figures
    std::vector<double> beat_times;          ///< of the music; seconds
    std::optional<double> floor_height;      ///< metres; as in contacts_of()
};

/// Measures a dance. BAS, PFC and skating ratio cannot leave single frames out, so they cover the
/// stretch from the first counted frame to the last. Threads: workers. Real-time: no.
[[nodiscard]] DanceMeasures measure_dance(const BodyTrack& track, const DanceSubject& subject);

/// Pools several dances: samples are joined, peaks are maxima, BAS and skating ratio means, and PFC
/// the median (a single fault changes it tenfold). Threads: workers. Real-time: no.
[[nodiscard]] DanceMeasures pooled(std::span<const DanceMeasures> dances);

}  // namespace raks::motion
