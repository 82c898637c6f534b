#pragma once

#include <span>
#include <vector>

#include "audio/resample/resampler.hpp"
#include "base/expected.hpp"
#include "base/time.hpp"

namespace raks::audio {

/// Cuts a stream of any supported rate into the analyzer's windows: 1,024 samples at 32 kHz, number
/// n centred on time_of_hop(n), with zeros before the stream. For whole files and pictures; the
/// analyzer cuts its own.
///
/// Threads: one. Real-time: no (that is up to the callback).
class RhythmFrames {
 public:
    static constexpr int kSampleRate = 32'000;    ///< hertz
    static constexpr std::size_t kHop = 320;      ///< samples: 10 ms
    static constexpr std::size_t kWindow = 1024;  ///< samples

    /// Sets up the resampler and starts a stream. Errors: no resampler can be set up.
    [[nodiscard]] Expected<void> prepare(SampleRate rate);

    /// Takes samples, calls `on_window(std::span<const float>)` for each window that became full.
    template <typename OnWindow>
    void process(std::span<const float> mono, OnWindow&& on_window) {
        while (!mono.empty()) {
            const auto progress = resampler_.process(mono, resampled_);
            mono = mono.subspan(progress.taken);
            for (std::size_t i = 0; i < progress.made; ++i) {
                window_[filled_++] = resampled_[i];
                if (filled_ == kWindow) {
                    on_window(std::span<const float>(window_));
                    advance();
                }
            }
        }
    }

    /// Longest time from a sample in the middle of a window to the call of `on_window`.
    [[nodiscard]] Nanos delay() const noexcept;

 private:
    void advance() noexcept;

    Resampler resampler_;
    std::vector<float> resampled_ = std::vector<float>(2048);
    std::vector<float> window_ = std::vector<float>(kWindow);
    std::size_t filled_ = kWindow / 2;
};

}  // namespace raks::audio
