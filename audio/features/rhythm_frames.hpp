#pragma once

#include <span>
#include <vector>

#include "audio/resample/resampler.hpp"
#include "base/expected.hpp"
#include "base/time.hpp"

namespace raks::audio {

/// Cuts a stream of any supported rate into the analyzer's windows: 1,024 samples at 32 kHz, number
/// n centred on time_of_hop(n), zeros before the stream. For whole-file work and pictures; the
/// analyzer has its own.
///
/// Threads: one. Real-time: no (the callback's matter).
class RhythmFrames {
 public:
    static constexpr int kSampleRate = 32'000;
    static constexpr std::size_t kHop = 320;
    static constexpr std::size_t kWindow = 1024;

    /// Errors: no resampler can be set up.
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

    /// Age of a window's middle when it comes out.
    [[nodiscard]] Nanos delay() const noexcept;

 private:
    void advance() noexcept;

    Resampler resampler_;
    std::vector<float> resampled_ = std::vector<float>(2048);
    std::vector<float> window_ = std::vector<float>(kWindow);
    std::size_t filled_ = kWindow / 2;
};

}  // namespace raks::audio
