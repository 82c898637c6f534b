#pragma once

#include <array>
#include <cstdint>
#include <filesystem>
#include <span>
#include <vector>

#include "audio/beat/paper_beat.hpp"
#include "audio/features/rhythm_frames.hpp"
#include "base/expected.hpp"
#include "base/music_state.hpp"

namespace raks::apps {

inline constexpr std::size_t kPlotBands = 96;  ///< of the spectrogram, mel scale, 30 Hz to 16 kHz

/// A stretch of the picture's time axis: one hop, or several neighbours merged.
struct PlotColumn {
    int hops = 0;             ///< merged; 0: nothing is known
    float low = 0.0F;         ///< lowest sample
    float high = 0.0F;        ///< highest sample
    float strength = 0.0F;    ///< onset strength (PaperFlux), highest of the hops
    float threshold = 0.0F;   ///< its threshold, highest of the hops
    double bpm = 0.0;         ///< sum over the hops that have a state
    double confidence = 0.0;  ///< sum over the hops that have a state
    int states = 0;
    std::array<float, kPlotBands> level{};  ///< dBFS of a sine in the band, loudest of the hops
};

/// What a picture of an analysis shows, in bounded memory however long the file: when the columns
/// are full, neighbours are merged. Threads: one. Real-time: no.
class PlotData {
 public:
    static constexpr std::size_t kColumns = 4096;

    PlotData();
    /// Errors: no resampler can be set up.
    [[nodiscard]] Expected<void> prepare(SampleRate rate);
    /// The file's next samples, mono, in [-1, 1].
    void add(std::span<const float> mono);
    /// The analyzer's next state.
    void add(const MusicState& state);
    /// Beats in place of those of the states, after all of them; tempo and confidence become
    /// theirs.
    void replace_beats(std::vector<BeatEvent> beats);
    /// Brings the last hops out; `duration`: length of the file.
    void finish(Nanos duration);

    [[nodiscard]] std::span<const PlotColumn> columns() const noexcept { return columns_; }
    [[nodiscard]] double seconds_per_column() const noexcept;
    [[nodiscard]] std::span<const BeatEvent> beats() const noexcept { return beats_; }
    [[nodiscard]] double duration() const noexcept { return duration_; }

 private:
    PlotColumn& column_of(HopIndex hop);
    void take(std::span<const float> window);

    audio::RhythmFrames windows_;
    audio::PaperFlux flux_;
    audio::PowerSpectrum spectrum_;
    std::array<double, kPlotBands + 1> edges_{};  // of the bands, in bins
    HopIndex next_window_ = 0;
    HopIndex hops_per_column_ = 1;
    std::vector<PlotColumn> columns_;
    std::vector<BeatEvent> beats_;
    double duration_ = 0.0;
};

/// Reads reference beats: one a line, seconds and, after white space, the position in the bar (1 is
/// the downbeat; 0 or absent: unknown); empty lines and lines from '#' on are passed over. Errors:
/// the file cannot be read, a line that is no beat, times that do not rise.
[[nodiscard]] Expected<std::vector<BeatEvent>> read_reference_beats(
    const std::filesystem::path& path);

}  // namespace raks::apps
