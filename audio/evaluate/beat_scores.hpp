#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <string_view>
#include <vector>

#include "audio/evaluate/beat_faults.hpp"

/// One tracker's result on one excerpt, by every measure, and on many.
namespace raks::audio {

/// Beats of one excerpt, annotated or estimated.
struct BeatList {
    std::vector<double> times;  ///< seconds, ascending
    /// One a beat: 1 = downbeat, 0 = unknown. Empty: no bar positions are known.
    std::vector<int> bar_positions;
    /// One a beat, [0, 1]: how sure the tracker is of the beat, and of its bar position. Empty: it
    /// does not say.
    std::vector<float> confidences = {};
    std::vector<float> bar_confidences = {};  ///< see confidences
};

/// What a tracker says of one excerpt.
struct BeatEstimate {
    BeatList beats;  ///< as announced
    /// Beats as predicted 100 ms before they sound: at time t a tracker commits a beat when its
    /// next beat lies at t + 100 ms. Seconds, ascending. Empty optional: does not predict.
    std::optional<std::vector<double>> predicted;
};

/// The measures; each is defined in beat_metrics.hpp, except as said here.
enum class BeatMeasure : std::uint8_t {
    f,            ///< f_measure at 70 ms
    cemgil,       ///< cemgil_accuracy
    p,            ///< p_score
    cml_longest,  ///< CMLc
    cml_total,    ///< CMLt
    aml_longest,  ///< AMLc
    aml_total,    ///< AMLt
    information_gain,
    downbeat_f,        ///< f_measure of the downbeats
    prediction_f,      ///< f_measure of the predictions at 35 ms
    time_to_lock,      ///< seconds
    tempo_exact,       ///< accuracy 1: 0 or 1
    tempo_octave,      ///< accuracy 2: 0 or 1
    bias,              ///< median_bias in milliseconds
    prediction_error,  ///< median_error of the predictions in milliseconds
    octave,            ///< BeatFault::is_octave: 0 or 1
    three_two,         ///< BeatFault::is_three_two
    off_beat,          ///< BeatFault::is_off_beat
    third_off,         ///< BeatFault::is_third_off
    sure_and_wrong,    ///< share of the beats announced at a confidence over 0.8 that are wrong
    sure_wrong_bar,    ///< share of the bar positions told at over 0.8 that are wrong
};
/// How many measures there are.
inline constexpr std::size_t kBeatMeasures = 21;

/// How a measure is named, summed up over excerpts and shown.
struct BeatMeasureInfo {
    enum class Unit : std::uint8_t { share, seconds, milliseconds };  ///< share: in [0, 1]
    enum class Over : std::uint8_t { mean, median };  ///< of the excerpts that have a value
    std::string_view name;                            ///< as in tables and JSON
    Unit unit;                                        ///< of the values
    Over over;                                        ///< how excerpts are summed up
};
/// Name, unit and kind of summary of a measure.
[[nodiscard]] const BeatMeasureInfo& info_of(BeatMeasure measure) noexcept;

/// Values by measure; empty where there is none: never locked, no hits, no bars, no predictions.
class BeatScores {
 public:
    /// The value of a measure, to be read or set.
    [[nodiscard]] std::optional<double>& operator[](BeatMeasure measure) noexcept {
        return values_[static_cast<std::size_t>(measure)];
    }
    /// The same to be read only.
    [[nodiscard]] const std::optional<double>& operator[](BeatMeasure measure) const noexcept {
        return values_[static_cast<std::size_t>(measure)];
    }

 private:
    std::array<std::optional<double>, kBeatMeasures> values_{};
};

/// All measures (beat_metrics.hpp). Beats before 5 s count for the time to lock only, as in the
/// common toolboxes: a tracker may need the first seconds. Downbeats are the beats at bar position
/// 1, scored by the F-measure within 70 ms; predictions are scored within 35 ms.
[[nodiscard]] BeatScores score_beats(const BeatList& reference, const BeatEstimate& estimate);

/// What a tracker said of beats and of bar positions from 5 s on, with its confidence; empty where
/// it gives none.
struct BeatClaims {
    std::vector<Claim> beats;
    std::vector<Claim> bars;
};
[[nodiscard]] BeatClaims claims_of(const BeatList& reference, const BeatEstimate& estimate);

/// One tracker over many excerpts.
struct BeatSummary {
    std::size_t excerpts = 0;      ///< how many were scored
    std::size_t never_locked = 0;  ///< excerpts without a time to lock
    BeatScores scores;             ///< means; medians of the times (BeatMeasureInfo::over)
};
/// Mean or median of each measure over the excerpts that have a value; empty where none has one.
[[nodiscard]] BeatSummary summarize(std::span<const BeatScores> excerpts);

}  // namespace raks::audio
