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
// A longer gap is lost audio, whether the device says so or not: a process that was stopped.
constexpr Nanos kStall = std::chrono::milliseconds(250);
// At most this much is skipped: the analyzer's bound.
constexpr Nanos kMostLoss = std::chrono::seconds(10);
// After a longer gap the music may be elsewhere: the beat is sought anew.
constexpr Nanos kLongestBlindGap = std::chrono::milliseconds(200);
// So long the grid runs on without sound; a dance longer than that would be to nothing.
constexpr Nanos kBlindFor = std::chrono::seconds(8);

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

Expected<void> LiveInput::resume(SampleRate device_rate) {
    if (device_rate != rate_) {
        if (auto changed = analysis_->change_rate(device_rate); !changed) {
            return changed;
        }
        rate_ = device_rate;
    }
    is_resuming_ = true;
    return {};
}

void LiveInput::note_sleep(Nanos span) noexcept {
    slept_ns_.fetch_add(span.count(), std::memory_order_relaxed);  // relaxed: a sum by itself
}

// The analyzer and the stream time skip as many frames as the gap lasted, so that beats keep their
// place.
void LiveInput::skip_lost(Nanos gap) noexcept {
    if (gap > Nanos(0)) {
        const std::int64_t frames = rate_.index_at(StreamTime(std::min(gap, kMostLoss)));
        analysis_->skip(frames);
        lost_frames_.fetch_add(frames, std::memory_order_relaxed);  // relaxed: a statistic
    }
}

void LiveInput::skip_sleep() noexcept {
    if (const std::int64_t slept = slept_ns_.exchange(0, std::memory_order_relaxed); slept > 0) {
        skip_lost(Nanos(slept));
        analysis_->skip(0);
    }
}

void LiveInput::on_input(std::span<const float> interleaved,
                         int channels,
                         const audio::BlockTime& time) noexcept RAKS_NONBLOCKING {
    const HostTime start = host_now();
    const std::size_t stride = static_cast<std::size_t>(channels);
    const std::size_t frames = interleaved.size() / stride;
    const Nanos block = rate_.time_of(static_cast<std::int64_t>(frames)).time_since_epoch();
    // An xrun flag says that audio was lost but not how much: what the clock says is the estimate.
    const Nanos gap = time.entered - last_entered_ - block;
    if (has_begun_ && (time.is_xrun || is_resuming_ || gap > kStall)) {
        analysis_->loosen_clock();
        // Between two streams every bit counts: they would add up.
        if (is_resuming_ || gap > kLeastLoss) {
            skip_lost(gap);
        }
        if (time.entered - last_sound_ - block > kLongestBlindGap) {
            analysis_->skip(0);
        }
    }
    skip_sleep();
    is_resuming_ = false;
    has_begun_ = true;
    // The last sample of the block has just arrived: `entered` is the host time of the block's end.
    analysis_->mark_clock(analysis_->taken_until() + block, time.entered);
    for (std::size_t at = 0; at < frames; at += kMixFrames) {
        const std::size_t count = std::min(kMixFrames, frames - at);
        const std::span<float> mono = std::span(mono_).first(count);
        const std::span<const float> part = interleaved.subspan(at * stride, count * stride);
        analysis_->pass_on(part, stride);
        audio::downmix_to_mono(part, stride, mono);
        analysis_->analyze(mono);
    }
    last_entered_ = last_sound_ = time.entered;
    analysis_->add_callback_time(host_now() - start);
}

// Whole hops, by the clock alone: stream time is where it would be with the device.
void LiveInput::pass_gap(HostTime now) noexcept RAKS_NONBLOCKING {
    if (!has_begun_) {
        last_entered_ = last_sound_ = now;
        has_begun_ = true;
    }
    // A machine that stood still: the same bound as for a device.
    last_entered_ = std::max(last_entered_, now - kMostLoss);
    skip_sleep();
    while (now - last_entered_ >= kHop) {
        last_entered_ += kHop;
        if (last_entered_ - last_sound_ < kBlindFor) {
            analysis_->pass_blind_hop();
        } else {
            const auto frames = static_cast<std::size_t>(rate_.index_at(StreamTime(kHop)));
            for (std::size_t at = 0; at < frames; at += kMixFrames) {
                const std::size_t count = std::min(kMixFrames, frames - at);
                std::fill_n(mono_.begin(), count, 0.0F);
                analysis_->analyze(std::span(mono_).first(count));
            }
        }
        analysis_->mark_clock(analysis_->taken_until(), last_entered_);
    }
}

std::int64_t LiveInput::lost_frames() const noexcept {
    return lost_frames_.load(std::memory_order_relaxed);  // relaxed: a statistic
}

}  // namespace raks::engine
