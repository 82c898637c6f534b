#pragma once

#include <optional>
#include <span>

/// How well estimated beats fit annotated ones: the measures of the field, each as mir_eval
/// computes it (Raffel et al. 2014, "mir_eval: a transparent implementation of common MIR metrics",
/// ISMIR; its reference vectors agree within 1e-12), and those that matter on a stage.
///
/// Times are seconds, ascending; an empty list means that nothing was found. Scores lie in [0, 1],
/// 1 is perfect, and are 0 when a list is too short for the measure. Nothing is left out here:
/// beat_scores.hpp drops the first 5 s.
/// Every function is pure. Threads: any. Real-time: no (some allocate).
namespace raks::audio {

/// Beat times of one excerpt: seconds, ascending.
using BeatTimes = std::span<const double>;

inline constexpr double kHitTolerance = 0.070;         ///< seconds; F-measure (Dixon 2001)
inline constexpr double kPredictionTolerance = 0.035;  ///< seconds; half of it, for dance steps

/// F-measure: 2 x hits / (reference beats + estimated beats). A hit is a pair within `tolerance`
/// (seconds, inclusive), one to one, as many as can be paired. (Dixon 2001; Davies, Degara and
/// Plumbley 2009, "Evaluation methods for musical audio beat tracking algorithms", 3.1.1)
[[nodiscard]] double f_measure(BeatTimes reference,
                               BeatTimes estimate,
                               double tolerance = kHitTolerance);

/// Cemgil's accuracy: for each reference beat a Gaussian (sigma 40 ms) of the distance to its
/// nearest estimate; the sum over the mean of the two counts. (Cemgil et al. 2001; Davies 2009,
/// 3.1.2)
[[nodiscard]] double cemgil_accuracy(BeatTimes reference, BeatTimes estimate);

/// P-score: cross-correlation of both lists as pulse trains on a 10 ms grid, over lags up to 20 %
/// of the median reference interval; hits over the greater count. At least 2 beats each. (McKinney
/// et al. 2007; Davies 2009, 3.1.4)
[[nodiscard]] double p_score(BeatTimes reference, BeatTimes estimate);

/// Continuity. An estimate is right when it lies within 17.5 % of the reference interval from its
/// nearest reference beat, its interval to the beat before (after, for the first) differs by less
/// than 17.5 %, and no earlier right estimate has that reference beat. Over the greater count.
/// (Hainsworth 2004; Klapuri et al. 2006; Davies 2009, 3.1.5)
struct Continuity {
    double cml_longest = 0.0;  ///< CMLc: share of the beats in the longest run, annotated level
    double cml_total = 0.0;    ///< CMLt: all right beats at the annotated level
    double aml_longest = 0.0;  ///< AMLc: the best of the annotated level, the off-beat, double
                               ///< tempo and half tempo on odd or even beats
    double aml_total = 0.0;    ///< AMLt: the same for all right beats
};
/// At least 2 beats each.
[[nodiscard]] Continuity continuity(BeatTimes reference, BeatTimes estimate);

/// Information gain: how far the histogram (41 bins) of beat errors, as shares of the local
/// interval of the other list, is from a uniform one: 1 - entropy / log2(41), by the direction that
/// is worse. At least 2 beats each. (Davies, Degara and Plumbley 2011, "Measuring the performance
/// of beat tracking algorithms using a beat error histogram")
///
/// A quirk of the reference implementation is kept so that figures compare: a beat before the first
/// of the other list is divided by the interval from the *last* one (its index wraps around), hence
/// counts as nearly exact.
[[nodiscard]] double information_gain(BeatTimes reference, BeatTimes estimate);

/// Seconds from the first reference beat to the first of 4 reference beats in a row that are all
/// hit within 70 ms, with no estimate between them. Empty: never locked.
[[nodiscard]] std::optional<double> time_to_lock(BeatTimes reference, BeatTimes estimate);

/// Tempo: median of beats a second, estimate against reference, within 4 %. (Gouyon et al. 2006,
/// "An experimental comparison of audio tempo induction algorithms")
struct TempoAccuracy {
    bool is_exact = false;   ///< accuracy 1: the annotated tempo
    bool is_octave = false;  ///< accuracy 2: that, its double, triple, half or third
};
/// At least 3 beats each.
[[nodiscard]] TempoAccuracy tempo_accuracy(BeatTimes reference, BeatTimes estimate);

/// Median of (estimate - reference) over the hits within 70 ms; seconds, late is positive. Empty:
/// no hits.
[[nodiscard]] std::optional<double> median_bias(BeatTimes reference, BeatTimes estimate);

/// Median of |estimate - reference| over the hits within 70 ms; seconds. Empty: no hits.
[[nodiscard]] std::optional<double> median_error(BeatTimes reference, BeatTimes estimate);

}  // namespace raks::audio
