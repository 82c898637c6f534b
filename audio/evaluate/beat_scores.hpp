#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <string_view>
#include <vector>

/// One tracker's result on one excerpt, by every measure, and on many.
namespace raks::audio {

/// Beats of one excerpt, annotated or estimated.
struct BeatList {
    std::vector<double> times;  ///< seconds, ascending
    std::vector<int>
        bar_positions;  ///< one a beat, 1 = downbeat, 0 = unknown; empty: tells no bars
};

struct BeatEstimate {
    BeatList beats;  ///< as announced
    /// Beats as predicted 100 ms before they sound: at time t a tracker commits a beat when its
    /// next beat lies at t + 100 ms. Seconds, ascending. Empty optional: does not predict.
    std::optional<std::vector<double>> predicted;
};

enum class BeatMeasure : std::uint8_t {
    f,
    cemgil,
    p,
    cml_longest,
    cml_total,
    aml_longest,
    aml_total,
    information_gain,
    downbeat_f,
    prediction_f,
    time_to_lock,
    tempo_exact,
    tempo_octave,
    bias,
    prediction_error,
};
inline constexpr std::size_t kBeatMeasures = 15;

/// How a measure is named, summed up over excerpts and shown.
struct BeatMeasureInfo {
    enum class Unit : std::uint8_t { share, seconds, milliseconds };
    enum class Over : std::uint8_t { mean, median };  ///< of the excerpts that have a value
    std::string_view name;                            ///< as in tables and JSON
    Unit unit;                                        ///< values are shares [0, 1] or seconds, ms
    Over over;
};
[[nodiscard]] const BeatMeasureInfo& info_of(BeatMeasure measure) noexcept;

/// Values by measure; empty where there is none: never locked, no hits, no bars, no predictions.
class BeatScores {
 public:
    [[nodiscard]] std::optional<double>& operator[](BeatMeasure measure) noexcept {
        return values_[static_cast<std::size_t>(measure)];
    }
    [[nodiscard]] const std::optional<double>& operator[](BeatMeasure measure) const noexcept {
        return values_[static_cast<std::size_t>(measure)];
    }

 private:
    std::array<std::optional<double>, kBeatMeasures> values_{};
};

/// All measures (beat_metrics.hpp). Beats before 5 s count for the time to lock only, as the common
/// toolboxes do: a tracker may listen first. Downbeats are the beats at bar position 1, F-measure
/// within 70 ms; predictions are scored within 35 ms.
[[nodiscard]] BeatScores score_beats(const BeatList& reference, const BeatEstimate& estimate);

struct BeatSummary {
    std::size_t excerpts = 0;
    std::size_t never_locked = 0;
    BeatScores scores;  ///< means; medians of the times (BeatMeasureInfo::over)
};
[[nodiscard]] BeatSummary summarize(std::span<const BeatScores> excerpts);

}  // namespace raks::audio
