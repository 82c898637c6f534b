#pragma once

#include <atomic>
#include <cstdint>
#include <filesystem>
#include <memory>
#include <vector>

#include "audio/io/device_stream.hpp"
#include "audio/io/file_player.hpp"
#include "audio/resample/resampler.hpp"
#include "base/expected.hpp"
#include "engine/live/analysis_stage.hpp"

namespace raks::engine {

/// The loudspeaker's side of `play`: what the output callback does. Pulls the decoded file,
/// analyzes the file's own samples, and fills the device's block with them, resampled to the
/// device's rate.
///
/// Stream time counts the file's samples as they are played; a seek does not turn it back, it makes
/// a discontinuity. Threads: on_output from the device (or PacedClock), the rest from main.
class Playback final : public audio::StreamCallback {
 public:
    /// `player` plays one file. Errors: a rate that the analyzer refuses.
    [[nodiscard]] static Expected<std::unique_ptr<Playback>> create(
        std::unique_ptr<audio::FilePlayer> player, const AnalyzerModels& models);

    /// Before the first callback: the rate of what will call. Errors: the resampler refuses it.
    [[nodiscard]] Expected<void> prepare(SampleRate device_rate);

    void on_output(std::span<float> interleaved,
                   int channels,
                   const audio::BlockTime& time) noexcept override;

    [[nodiscard]] AnalysisStage& analysis() noexcept { return *analysis_; }
    [[nodiscard]] audio::FilePlayer& player() noexcept { return *player_; }

    void set_volume(float volume) noexcept;  ///< [0, 2]
    void set_paused(bool is_paused) noexcept;
    [[nodiscard]] bool is_paused() const noexcept;
    /// Where the file plays, in seconds. A moment ahead of what is heard; after a seek at once the
    /// new place, also in a pause.
    [[nodiscard]] double position_seconds() const noexcept;
    /// Goes to another place of the file (clamped to >= 0); behind its end, playing is finished.
    void seek(double seconds);
    /// All of the file has been given to the device.
    [[nodiscard]] bool is_finished() const noexcept;
    /// Plays no further than this (seconds in the file), to the sample.
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
    std::atomic<bool> is_finished_{false};
    std::atomic<double> position_seconds_{0.0};
    std::atomic<double> end_seconds_{1e18};
};

}  // namespace raks::engine
