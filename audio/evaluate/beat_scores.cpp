#include "audio/evaluate/beat_scores.hpp"

#include <algorithm>
#include <numeric>

#include "audio/evaluate/beat_metrics.hpp"
#include "base/statistics.hpp"

namespace raks::audio {
namespace {

constexpr double kTrim = 5.0;          // seconds: score_beats leaves beats before this out
constexpr double kMilliseconds = 1e3;  // in a second

using Unit = BeatMeasureInfo::Unit;
using Over = BeatMeasureInfo::Over;
// In the order of BeatMeasure. Times and errors by the median: one excerpt that locks late would
// rule their mean.
constexpr std::array<BeatMeasureInfo, kBeatMeasures> kInfo = {{
    {"F", Unit::share, Over::mean},
    {"Cemgil", Unit::share, Over::mean},
    {"P", Unit::share, Over::mean},
    {"CMLc", Unit::share, Over::mean},
    {"CMLt", Unit::share, Over::mean},
    {"AMLc", Unit::share, Over::mean},
    {"AMLt", Unit::share, Over::mean},
    {"InfoGain", Unit::share, Over::mean},
    {"downF", Unit::share, Over::mean},
    {"pred35", Unit::share, Over::mean},
    {"lock_s", Unit::seconds, Over::median},
    {"Acc1", Unit::share, Over::mean},
    {"Acc2", Unit::share, Over::mean},
    {"bias_ms", Unit::milliseconds, Over::median},
    {"abspred_ms", Unit::milliseconds, Over::median},
    {"octave", Unit::share, Over::mean},
    {"3:2", Unit::share, Over::mean},
    {"off-beat", Unit::share, Over::mean},
    {"third off", Unit::share, Over::mean},
    {"sure, wrong", Unit::share, Over::mean},
    {"sure, wrong 1", Unit::share, Over::mean},
}};

// The beats from kTrim on.
BeatTimes trimmed(BeatTimes times) {
    const auto first = std::lower_bound(times.begin(), times.end(), kTrim);
    return times.subspan(static_cast<std::size_t>(first - times.begin()));
}

// Times of the beats at bar position 1; none where the list has no bar positions.
std::vector<double> downbeats(const BeatList& beats) {
    std::vector<double> times;
    for (std::size_t i = 0; i < beats.bar_positions.size(); ++i) {
        if (beats.bar_positions[i] == 1) {
            times.push_back(beats.times[i]);
        }
    }
    return times;
}

// Share of wrong ones among the claims of high confidence; empty where there are none.
std::optional<double> sure_and_wrong(const std::vector<Claim>& claims) {
    constexpr float kSure = 0.8F;
    std::size_t sure = 0;
    std::size_t wrong = 0;
    for (const Claim& claim : claims) {
        sure += claim.confidence > kSure ? 1 : 0;
        wrong += claim.confidence > kSure && !claim.is_right ? 1 : 0;
    }
    return sure == 0 ? std::nullopt
                     : std::optional(static_cast<double>(wrong) / static_cast<double>(sure));
}

std::optional<double> in_milliseconds(std::optional<double> seconds) {
    return seconds ? std::optional(kMilliseconds * *seconds) : std::nullopt;
}

}  // namespace

const BeatMeasureInfo& info_of(BeatMeasure measure) noexcept {
    return kInfo[static_cast<std::size_t>(measure)];
}

BeatScores score_beats(const BeatList& reference, const BeatEstimate& estimate) {
    using M = BeatMeasure;
    // Only time_to_lock takes the untrimmed lists: locking happens in the seconds that are trimmed.
    const BeatTimes right = trimmed(reference.times);
    const BeatTimes beats = trimmed(estimate.beats.times);
    BeatScores scores;
    scores[M::f] = f_measure(right, beats);
    scores[M::cemgil] = cemgil_accuracy(right, beats);
    scores[M::p] = p_score(right, beats);
    const Continuity levels = continuity(right, beats);
    scores[M::cml_longest] = levels.cml_longest;
    scores[M::cml_total] = levels.cml_total;
    scores[M::aml_longest] = levels.aml_longest;
    scores[M::aml_total] = levels.aml_total;
    scores[M::information_gain] = information_gain(right, beats);
    // Without annotated bar positions, or with a tracker that gives none, the measure has no value
    // rather than 0.
    const std::vector<double> right_downbeats = downbeats(reference);
    if (!right_downbeats.empty() && !estimate.beats.bar_positions.empty()) {
        scores[M::downbeat_f] =
            f_measure(trimmed(right_downbeats), trimmed(downbeats(estimate.beats)));
    }
    if (estimate.predicted) {
        const BeatTimes predicted = trimmed(*estimate.predicted);
        scores[M::prediction_f] = f_measure(right, predicted, kPredictionTolerance);
        scores[M::prediction_error] = in_milliseconds(median_error(right, predicted));
    }
    scores[M::time_to_lock] = time_to_lock(reference.times, estimate.beats.times);
    const TempoAccuracy tempo = tempo_accuracy(right, beats);
    scores[M::tempo_exact] = tempo.is_exact ? 1.0 : 0.0;
    scores[M::tempo_octave] = tempo.is_octave ? 1.0 : 0.0;
    scores[M::bias] = in_milliseconds(median_bias(right, beats));
    const BeatFault fault = fault_of(right, beats);
    scores[M::octave] = fault.is_octave ? 1.0 : 0.0;
    scores[M::three_two] = fault.is_three_two ? 1.0 : 0.0;
    scores[M::off_beat] = fault.is_off_beat ? 1.0 : 0.0;
    scores[M::third_off] = fault.is_third_off ? 1.0 : 0.0;
    const BeatClaims claims = claims_of(reference, estimate);
    scores[M::sure_and_wrong] = sure_and_wrong(claims.beats);
    scores[M::sure_wrong_bar] = sure_and_wrong(claims.bars);
    return scores;
}

BeatClaims claims_of(const BeatList& reference, const BeatEstimate& estimate) {
    const BeatList& beats = estimate.beats;
    BeatClaims claims;
    if (beats.confidences.empty()) {
        return claims;
    }
    const std::size_t first = beats.times.size() - trimmed(beats.times).size();
    const BeatTimes times = BeatTimes(beats.times).subspan(first);
    claims.beats =
        beat_claims(trimmed(reference.times), times, std::span(beats.confidences).subspan(first));
    if (!beats.bar_confidences.empty() && !reference.bar_positions.empty()) {
        claims.bars = bar_claims(reference.times,
                                 reference.bar_positions,
                                 times,
                                 std::span(beats.bar_positions).subspan(first),
                                 std::span(beats.bar_confidences).subspan(first));
    }
    return claims;
}

BeatSummary summarize(std::span<const BeatScores> excerpts) {
    BeatSummary summary;
    summary.excerpts = excerpts.size();
    for (std::size_t i = 0; i < kBeatMeasures; ++i) {
        const auto measure = static_cast<BeatMeasure>(i);
        std::vector<double> values;
        for (const BeatScores& scores : excerpts) {
            if (scores[measure]) {
                values.push_back(*scores[measure]);
            }
        }
        // Excerpts without a value never locked; the median below is over the others only.
        if (measure == BeatMeasure::time_to_lock) {
            summary.never_locked = excerpts.size() - values.size();
        }
        if (info_of(measure).over == Over::median) {
            summary.scores[measure] = median(values);
        } else if (!values.empty()) {
            summary.scores[measure] = std::accumulate(values.begin(), values.end(), 0.0) /
                                      static_cast<double>(values.size());
        }
    }
    return summary;
}

}  // namespace raks::audio
