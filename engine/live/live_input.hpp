#pragma once

#include <atomic>
#include <memory>
#include <vector>

#include "audio/io/device_stream.hpp"
#include "base/expected.hpp"
#include "engine/live/analysis_stage.hpp"

namespace raks::engine {

/// The input callback of `live`: turns a microphone's blocks into analyzed mono samples. Threads:
/// on_input from the device (or PacedClock after the device died), the rest from main.
class LiveInput final : public audio::StreamCallback {
 public:
    /// Errors: a rate that the analyzer refuses.
    [[nodiscard]] static Expected<std::unique_ptr<LiveInput>> create(SampleRate device_rate,
                                                                     const AnalyzerModels& models);

    /// *audio* Marks the clock, mixes down and analyzes one block. Real-time: yes (no allocation).
    void on_input(std::span<const float> interleaved,
                  int channels,
                  const audio::BlockTime& time) noexcept override;

    /// The stage that the blocks are analyzed by.
    [[nodiscard]] AnalysisStage& analysis() noexcept { return *analysis_; }
    /// Frames that the device lost so far, estimated from its xrun flags and the clock. Threads:
    /// any.
    [[nodiscard]] std::int64_t lost_frames() const noexcept;

 private:
    LiveInput(SampleRate rate, std::unique_ptr<AnalysisStage> analysis);
    void skip_lost(const audio::BlockTime& time) noexcept;

    SampleRate rate_;
    std::unique_ptr<AnalysisStage> analysis_;
    std::vector<float> mono_;
    HostTime last_entered_{};       // audio thread's own
    std::int64_t last_frames_ = 0;  // of the block before
    std::atomic<std::int64_t> lost_frames_{0};
};

}  // namespace raks::engine
