#pragma once

#include <atomic>
#include <cstdint>
#include <memory>
#include <span>
#include <vector>

#include "audio/io/stream_callback.hpp"
#include "base/expected.hpp"
#include "base/time.hpp"
#include "engine/live/analysis_stage.hpp"
#include "engine/setup/analyzer_setup.hpp"

namespace raks::engine {

/// The input callback of `live`: turns a microphone's blocks into analyzed mono samples. Stream
/// time keeps up with the clock: what a device loses, the time that its thread did not run and the
/// gap between two streams count as lost audio.
///
/// Threads: on_input from the device, gap()'s from PacedClock while there is no device, the rest
/// from main.
class LiveInput final : public audio::StreamCallback {
 public:
    /// Errors: a rate that the analyzer refuses.
    [[nodiscard]] static Expected<std::unique_ptr<LiveInput>> create(SampleRate device_rate,
                                                                     const AnalyzerModels& models);

    /// *audio* Marks the clock, mixes down and analyzes one block. Real-time: yes (no allocation).
    void on_input(std::span<const float> interleaved,
                  int channels,
                  const audio::BlockTime& time) noexcept RAKS_NONBLOCKING override;

    /// For PacedClock while the device is gone: stream time goes on. For 8 s the grid runs on
    /// blindly, then there is silence, in which the dancer settles.
    [[nodiscard]] audio::StreamCallback& gap() noexcept { return gap_; }

    /// Another stream takes over, at this rate: while no callback runs. Errors: as create().
    [[nodiscard]] Expected<void> resume(SampleRate device_rate);

    /// The clock stood still for this long while the music went on (a computer that slept): the
    /// next block skips it.
    void note_sleep(Nanos span) noexcept;

    /// The stage that the blocks are analyzed by.
    [[nodiscard]] AnalysisStage& analysis() noexcept { return *analysis_; }
    /// Frames that were lost so far, estimated from the device's xrun flags and the clock.
    /// Threads: any.
    [[nodiscard]] std::int64_t lost_frames() const noexcept;

 private:
    class Gap final : public audio::StreamCallback {
     public:
        explicit Gap(LiveInput& input) : input_(input) {}
        void on_input(std::span<const float>,
                      int,
                      const audio::BlockTime& time) noexcept RAKS_NONBLOCKING override {
            input_.pass_gap(time.entered);
        }

     private:
        LiveInput& input_;
    };

    LiveInput(SampleRate rate, std::unique_ptr<AnalysisStage> analysis);
    void pass_gap(HostTime now) noexcept RAKS_NONBLOCKING;
    void skip_lost(Nanos gap) noexcept;
    void skip_sleep() noexcept;

    SampleRate rate_;
    std::unique_ptr<AnalysisStage> analysis_;
    std::vector<float> mono_;
    Gap gap_{*this};
    HostTime last_entered_{};  // when stream time had come so far; audio thread's own
    HostTime last_sound_{};    // when the newest block of a device came
    bool has_begun_ = false;
    bool is_resuming_ = false;  // the next block is of another stream
    std::atomic<std::int64_t> slept_ns_{0};
    std::atomic<std::int64_t> lost_frames_{0};
};

}  // namespace raks::engine
