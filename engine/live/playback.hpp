#pragma once

#include <atomic>
#include <cstdint>
#include <filesystem>
#include <memory>
#include <vector>

#include "audio/io/file_player.hpp"
#include "audio/io/stream_callback.hpp"
#include "audio/resample/resampler.hpp"
#include "base/expected.hpp"
#include "engine/live/analysis_stage.hpp"

namespace raks::engine {

/// The output callback of `play`: pulls the decoded file, analyzes the file's own samples, and
/// fills the device's block with them, resampled to the device's rate.
///
/// Stream time counts the file's samples as they are played; a seek does not turn it back, it makes
/// a discontinuity. Threads: on_output from the device (or PacedClock), the rest from main.
class Playback final : public audio::StreamCallback {
 public:
    /// `player` plays one file. Errors: a rate that the analyzer refuses.
    [[nodiscard]] static Expected<std::unique_ptr<Playback>> create(
        std::unique_ptr<audio::FilePlayer> player, const AnalyzerModels& models);

    /// Sets the rate of what will call; before the first callback, and again when the device
    /// changes while no callback runs. Errors: the resampler refuses the rate.
    [[nodiscard]] Expected<void> prepare(SampleRate device_rate);

    /// The device is gone: stream time stands still until another stream calls, and its sound fades
    /// in. While no callback runs.
    void stop_clock() noexcept;

    /// *audio* Fills one block and marks the clock. Real-time: yes (no allocation).
    void on_output(std::span<float> interleaved,
                   int channels,
                   const audio::BlockTime& time) noexcept RAKS_NONBLOCKING override;

    /// The stage that the file's samples are analyzed by.
    [[nodiscard]] AnalysisStage& analysis() noexcept { return *analysis_; }
    /// The decoder, for its messages and counters.
    [[nodiscard]] audio::FilePlayer& player() noexcept { return *player_; }

    void set_volume(float volume) noexcept;  ///< [0, 2], clamped; the gain follows smoothly
    /// Fades out and stops, or goes on; stream time stands still in a pause.
    void set_paused(bool is_paused) noexcept;
    /// Holds the first sample back, in silence, until it is let go. Before the first callback.
    void hold_back() noexcept { is_held_back_.store(true, std::memory_order_relaxed); }
    /// Lets what is held back sound.
    void let_go() noexcept { is_held_back_.store(false, std::memory_order_relaxed); }
    /// What set_paused() was told last.
    [[nodiscard]] bool is_paused() const noexcept;
    /// Where the file plays, in seconds: a moment ahead of the loudspeaker. After a seek it is the
    /// new place at once, also in a pause.
    [[nodiscard]] double position_seconds() const noexcept;
    /// Goes to another place of the file (clamped to >= 0); behind its end, playing is finished. In
    /// a pipe it does nothing.
    void seek(double seconds);
    /// True when all of the file has been given to the device, until a seek goes back. Threads:
    /// any.
    [[nodiscard]] bool is_finished() const noexcept;
    /// Plays no further than this place (seconds in the file), to the sample.
    void set_end(double seconds) noexcept;

 private:
    Playback(std::unique_ptr<audio::FilePlayer> player, std::unique_ptr<AnalysisStage> analysis);
    std::size_t pull(std::span<float> stereo) noexcept;
    std::size_t refill() noexcept;

    std::unique_ptr<audio::FilePlayer> player_;
    std::unique_ptr<AnalysisStage> analysis_;
    SampleRate file_rate_;
    SampleRate device_rate_;
    audio::Resampler resampler_;

    // Owned by the audio thread.
    std::vector<float> pulled_;  // stereo at the file's rate
    std::vector<float> mono_;
    std::size_t pending_at_ = 0;   // frames of pulled_ that the resampler has taken
    std::size_t pending_ = 0;      // and those that it has not
    std::vector<float> stereo_;    // stereo at the device's rate
    std::int64_t frames_out_ = 0;  // at the device's rate, of the file's sound
    float gain_ = 1.0F;            // follows volume_ smoothly
    bool is_source_ended_ = false;

    std::atomic<float> volume_{1.0F};
    std::atomic<bool> is_paused_{false};
    std::atomic<bool> is_held_back_{false};  // relaxed: as a pause, it orders nothing
    std::atomic<bool> is_finished_{false};
    std::atomic<double> position_seconds_{0.0};
    std::atomic<double> end_seconds_{1e18};
};

}  // namespace raks::engine
