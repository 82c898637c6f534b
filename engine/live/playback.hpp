#pragma once

#include <memory>
#include <span>
#include <vector>

#include "audio/io/file_player.hpp"
#include "audio/io/stream_callback.hpp"
#include "base/expected.hpp"
#include "engine/live/analysis_stage.hpp"
#include "engine/live/file_sound.hpp"

namespace raks::engine {

/// The output callback of `play`: what FileSound pulls of a file is analyzed, at the file's own
/// rate, and fills the device's block.
///
/// Stream time counts the file's samples as they are played; a seek does not turn it back, it makes
/// a discontinuity. Threads: on_output from the device (or PacedClock), the rest from main.
class Playback final : public audio::StreamCallback, public FileSound, private FileSound::Ear {
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

 private:
    Playback(std::unique_ptr<audio::FilePlayer> player, std::unique_ptr<AnalysisStage> analysis);
    void on_pulled(const audio::PulledAudio& pulled,
                   std::span<const float> stereo) noexcept RAKS_NONBLOCKING override;

    std::unique_ptr<AnalysisStage> analysis_;
    std::vector<float> mono_;  // owned by the audio thread
};

}  // namespace raks::engine
