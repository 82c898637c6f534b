#pragma once

#include <string>
#include <vector>

#include "motion/choreography/authored_dance.hpp"
#include "motion/skeleton/skeleton.hpp"

namespace raks::motion {

/// What a figure does, danced several times with noise at the written tempo.
struct FigureMeasures {
    double hip_travel = 0.0;    ///< path of the hips over the floor, cm a beat
    double toe_contacts = 0.0;  ///< contacts of both toes that begin, a bar
    double hand_delay = 0.0;    ///< beats by which the hands' speed trails the head's, [-0.5, 0.5]
    double jerk_rms = 0.0;      ///< m/s^3, motion/evaluate/dance_metrics.hpp
    double jerk_p999 = 0.0;
    double slip_p90 = 0.0;         ///< metres a contact
    double repeat_distance = 0.0;  ///< between two repeats, median; repeat_distance.hpp; metres
};

/// Threads: workers. Real-time: no (some 10 ms).
[[nodiscard]] FigureMeasures measure_figure(const AuthoredDance& dance,
                                            const AuthoredFigure& figure,
                                            const Skeleton& skeleton);

/// What is outside the figure's expectations, one line each: `belly.toml: line 12: figure "drop":
/// hips travel 0.4 cm a beat, expected 3 to 20`. Jerk: 350 m/s^3 rms and 2,000 (99.9 %) at most
/// unless the file says otherwise.
[[nodiscard]] std::vector<std::string> faults_in_measures(const AuthoredDance& dance,
                                                          const AuthoredFigure& figure,
                                                          const FigureMeasures& measures);

}  // namespace raks::motion
