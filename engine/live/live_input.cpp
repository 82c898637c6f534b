#include "engine/live/live_input.hpp"

#include <algorithm>
#include <utility>

#include "audio/io/downmix.hpp"

namespace raks::engine {
namespace {

// A block is mixed down in pieces of this many frames: the device may send any size, and the buffer
// must not grow on the audio thread.
constexpr std::size_t kMixFrames = 512;
// Shorter gaps are jitter of the callback; stream time does not move for them.
constexpr Nanos kLeastLoss = std::chrono::milliseconds(3);
// At most this much is skipped: a longer gap comes from a machine that slept.
constexpr Nanos kMostLoss = std::chrono::seconds(5);

}  // namespace

Expected<std::unique_ptr<LiveInput>> LiveInput::create(SampleRate device_rate,
                                                       const AnalyzerModels& models) {
    auto analysis = AnalysisStage::create(device_rate, models);
    if (!analysis) {
        return fail(analysis.error());
    }
    return std::unique_ptr<LiveInput>(new LiveInput(device_rate, std::move(*analysis)));
}

LiveInput::LiveInput(SampleRate rate, std::unique_ptr<AnalysisStage> analysis)
    : rate_(rate), analysis_(std::move(analysis)), mono_(kMixFrames) {}

// The xrun flag says that audio was lost but not how much: the time between the two callbacks minus
// the length of the block before is the estimate.
void LiveInput::skip_lost(const audio::BlockTime& time) noexcept {
    const Nanos block = rate_.time_of(last_frames_).time_since_epoch();
    const Nanos gap = std::min(time.entered - last_entered_ - block, kMostLoss);
    if (gap > kLeastLoss) {
        // The analyzer and the stream time skip as many frames as the gap lasted, so that beats
        // keep their place.
        const std::int64_t frames = rate_.index_at(StreamTime(gap));
        analysis_->skip(frames);
        lost_frames_.fetch_add(frames, std::memory_order_relaxed);  // relaxed: a statistic
    }
}

void LiveInput::on_input(std::span<const float> interleaved,
                         int channels,
                         const audio::BlockTime& time) noexcept {
    const HostTime start = HostClock::now();
    const std::size_t stride = static_cast<std::size_t>(channels);
    const std::size_t frames = interleaved.size() / stride;
    if (time.is_xrun && last_frames_ > 0) {
        analysis_->loosen_clock();
        skip_lost(time);
    }
    // The last sample of the block has just arrived: `entered` is the host time of the block's end.
    const StreamTime end = analysis_->taken_until() +
                           rate_.time_of(static_cast<std::int64_t>(frames)).time_since_epoch();
    analysis_->mark_clock(end, time.entered);
    for (std::size_t at = 0; at < frames; at += kMixFrames) {
        const std::size_t count = std::min(kMixFrames, frames - at);
        const std::span<float> mono = std::span(mono_).first(count);
        audio::downmix_to_mono(interleaved.subspan(at * stride, count * stride), stride, mono);
        analysis_->analyze(mono);
    }
    last_entered_ = time.entered;
    last_frames_ = static_cast<std::int64_t>(frames);
    analysis_->add_callback_time(HostClock::now() - start);
}

std::int64_t LiveInput::lost_frames() const noexcept {
    return lost_frames_.load(std::memory_order_relaxed);  // relaxed: a statistic
}

}  // namespace raks::engine
