#pragma once

#include <optional>
#include <span>
#include <string>
#include <vector>

#include "motion/evaluate/amplitude.hpp"
#include "motion/evaluate/dance_metrics.hpp"
#include "motion/evaluate/repeat_distance.hpp"

/// All metrics of this folder of one dance but its landings: the same figures for people and for
/// our dancer.
namespace raks::motion {

/// One whole repeat of a figure.
struct FigureRepeatTimes {
    std::string figure;
    std::vector<double> count_times;  ///< seconds: its counts and the next figure's count 1
};

struct FigureMeasures {
    std::string figure;
    std::vector<Amplitude> amplitudes;  ///< by repeat
    std::vector<FigureShape> shapes;    ///< by repeat
};

struct DanceMeasures {
    JerkReport jerk;
    ContactReport contacts;
    double peak_toe_speed = 0.0;  ///< divided by the pace
    double bas_motion = 0.0;      ///< FACT's form
    double bas_music = 0.0;       ///< Bailando's form
    double pfc = 0.0;
    double skating_ratio = 0.0;
    std::vector<FigureMeasures> figures;  ///< by name, in the order in which they came first
};

/// What is measured, besides the track.
struct DanceSubject {
    MetricFrames frames;
    std::vector<FigureRepeatTimes> repeats;
    std::vector<double> beat_times;      ///< of the music; seconds
    std::optional<double> floor_height;  ///< as in contacts_of
};

/// BAS, PFC and skating ratio know no frames to leave out: they are of the stretch from the first
/// counted frame to the last. Threads: workers. Real-time: no.
[[nodiscard]] DanceMeasures measure_dance(const BodyTrack& track, const DanceSubject& subject);

/// Several dances as one: samples pooled, peaks the highest, BAS and skating ratio the mean, PFC
/// the median (one fault changes it tenfold).
[[nodiscard]] DanceMeasures pooled(std::span<const DanceMeasures> dances);

}  // namespace raks::motion
