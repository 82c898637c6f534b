#include "engine/live/analysis_stage.hpp"

#include <algorithm>
#include <utility>

#include "audio/io/downmix.hpp"
#include "base/decibels.hpp"
#include "engine/setup/analyzer_setup.hpp"

namespace raks::engine {
namespace {

// A meter falls slowly enough to be read: IEC 60268-10 type I, 20 dB in 1.7 s.
constexpr float kMeterFallPerSecond = 20.0F / 1.7F;

// RMS level of a block in dBFS; the floor of -120 dBFS keeps silence finite.
float level_of(std::span<const float> mono) noexcept {
    return static_cast<float>(decibels_of_power(std::max(mean_square(mono), 1e-12)));
}

}  // namespace

Expected<std::unique_ptr<AnalysisStage>> AnalysisStage::create(SampleRate rate,
                                                               const AnalyzerModels& models) {
    auto analyzer = make_analyzer(rate, models);
    if (!analyzer) {
        return fail(analyzer.error());
    }
    return std::unique_ptr<AnalysisStage>(new AnalysisStage(rate, std::move(*analyzer)));
}

AnalysisStage::AnalysisStage(SampleRate rate, audio::MusicAnalyzer analyzer)
    : rate_(rate), analyzer_(std::move(analyzer)) {}

void AnalysisStage::analyze(std::span<const float> mono) noexcept RAKS_NONBLOCKING {
    // Subnormal numbers, which filters produce in silence, are slow on the processor.
    const FlushToZeroScope flush_to_zero;
    // Commands first, so that one which is due takes effect within this block.
    run_commands();
    analyzer_.process(mono, queue_);
    const float seconds = static_cast<float>(mono.size()) / static_cast<float>(rate_.hertz());
    // The meter rises at once and falls at a fixed rate per second of audio, not per block.
    // relaxed: a meter, written here alone
    const float fallen =
        level_dbfs_.load(std::memory_order_relaxed) - seconds * kMeterFallPerSecond;
    level_dbfs_.store(std::max(level_of(mono), fallen), std::memory_order_relaxed);
    // release: pairs with the acquire in taken_until().
    frames_taken_.fetch_add(static_cast<std::int64_t>(mono.size()), std::memory_order_release);
}

void AnalysisStage::mark_clock(StreamTime stream, HostTime host) noexcept RAKS_NONBLOCKING {
    clock_map_.update(stream, host);
    // The reader on the main thread gets the whole line at once, never half of an update.
    clock_line_.write(clock_map_.line());
}

void AnalysisStage::stop_clock(StreamTime stream) noexcept RAKS_NONBLOCKING {
    // A pause calls this with every block; only the first call changes anything.
    if (clock_map_.line().is_running) {
        clock_map_.stop(stream);
        clock_line_.write(clock_map_.line());
    }
}

void AnalysisStage::skip(std::int64_t frames) noexcept RAKS_NONBLOCKING {
    // The analyzer advances its grid over the gap; the sample count must advance by the same.
    analyzer_.skip(rate_.time_of(frames).time_since_epoch());
    frames_taken_.fetch_add(frames, std::memory_order_release);  // see analyze()
}

StreamTime AnalysisStage::taken_until() const noexcept {
    return rate_.time_of(frames_taken_.load(std::memory_order_acquire));  // see analyze()
}

void AnalysisStage::run_commands() noexcept {
    // At most as many as the queue holds: bounded, as the audio thread needs.
    audio::AnalyzerCommand command{};
    while (commands_.pop(command)) {
        // Whoever sets beats by hand leads, until the tempo is given back to the music.
        planned_.let_person_lead(command.kind != audio::AnalyzerCommand::Kind::release_tempo);
        analyzer_.command(command);
    }
}

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
