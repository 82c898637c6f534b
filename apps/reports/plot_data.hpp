#pragma once

#include <array>
#include <cstdint>
#include <filesystem>
#include <span>
#include <vector>

#include "apps/reports/music_table.hpp"
#include "audio/beat/paper_beat.hpp"
#include "audio/features/rhythm_frames.hpp"
#include "base/expected.hpp"
#include "base/music_state.hpp"

namespace raks::apps {

inline constexpr std::size_t kPlotBands = 96;  ///< of the spectrogram, mel scale, 30 Hz to 16 kHz

/// One column of the picture's time axis: a hop, or several neighbouring hops merged.
struct PlotColumn {
    int hops = 0;                           ///< merged; 0: nothing is known
    float low = 0.0F;                       ///< lowest sample
    float high = 0.0F;                      ///< highest sample
    float strength = 0.0F;                  ///< onset strength (PaperFlux), highest of the hops
    float threshold = 0.0F;                 ///< its threshold, highest of the hops
    double bpm = 0.0;                       ///< sum over the hops that have a tempo
    double confidence = 0.0;                ///< sum over the hops that have a tempo
    double bar_confidence = 0.0;            ///< likewise, of the place in the bar
    int in_three = 0;                       ///< of these hops, those whose beats have three parts
    RivalTempo rival;                       ///< the most probable one of the hops
    int tempi = 0;                          ///< hops that have a tempo
    MusicNumbers music{};                   ///< of what is drawn: sums over `states`
    int states = 0;                         ///< hops that have a state
    std::array<float, kPlotBands> level{};  ///< dBFS of a sine in the band, loudest of the hops
};

/// What music does from a time on.
struct PlotPart {
    StreamTime time{};                    ///< at which it begins
    MusicPart part = MusicPart::stopped;  ///< until the next one
};

/// A bar of a song that is known.
struct PlotBar {
    StreamTime time{};  ///< at which it begins
    int repeats = -1;   ///< the earlier bar that it repeats; -1: none
};

/// The data of a picture of an analysis, in bounded memory for a file of any length: when the
/// columns are full, neighbours are merged. Threads: one. Real-time: no.
class PlotData {
 public:
    /// Columns kept at most; 41 s at one hop each.
    static constexpr std::size_t kColumns = 4096;

    /// Empty until prepare().
    PlotData();
    /// Starts a file of this rate. Errors: the resampler cannot be set up.
    [[nodiscard]] Expected<void> prepare(SampleRate rate);
    /// Takes the file's next samples, mono, in [-1, 1].
    void add(std::span<const float> mono);
    /// Takes the analyzer's next state.
    void add(const MusicState& state);
    /// Replaces the beats of the states by others; tempo and confidence become those of these
    /// beats. After all states.
    void replace_beats(std::vector<BeatEvent> beats);
    /// Completes the last hops with silence. `duration`: length of the file.
    void finish(Nanos duration);

    /// All columns from the start of the file.
    [[nodiscard]] std::span<const PlotColumn> columns() const noexcept { return columns_; }
    /// Length of a column.
    [[nodiscard]] double seconds_per_column() const noexcept;
    /// The beats, ascending.
    [[nodiscard]] std::span<const BeatEvent> beats() const noexcept { return beats_; }
    /// The parts of the music, ascending.
    [[nodiscard]] std::span<const PlotPart> parts() const noexcept { return parts_; }
    /// Its events, in the order in which they were told.
    [[nodiscard]] std::span<const MusicEvent> events() const noexcept { return events_; }
    /// Its accents, ascending.
    [[nodiscard]] std::span<const MusicAccent> accents() const noexcept { return accents_; }
    /// The bars of a song that is known, by number; empty: it came live.
    [[nodiscard]] std::span<const PlotBar> bars() const noexcept { return bars_; }
    /// Length of the file in seconds, as finish() was told.
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
    std::vector<PlotPart> parts_;
    std::vector<MusicEvent> events_;
    std::vector<MusicAccent> accents_;
    std::vector<PlotBar> bars_;
    double duration_ = 0.0;
};

/// Reads reference beats, one a line: seconds and, after white space, the position in the bar (1 is
/// the downbeat; 0 or absent: unknown). Empty lines, and everything from '#' on, are skipped.
/// Errors: the file cannot be read; a line that is no beat; times that do not ascend; no beat at
/// all.
[[nodiscard]] Expected<std::vector<BeatEvent>> read_reference_beats(
    const std::filesystem::path& path);

}  // namespace raks::apps
