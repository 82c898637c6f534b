#include "engine/analysis_stage.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

namespace raks::engine {
namespace {

float level_of(std::span<const float> mono) noexcept {
    double energy = 1e-12;
    for (const float sample : mono) {
        energy += static_cast<double>(sample) * static_cast<double>(sample);
    }
    return static_cast<float>(
        10.0 * std::log10(energy / static_cast<double>(std::max<std::size_t>(1, mono.size()))));
}

}  // namespace

Expected<std::unique_ptr<AnalysisStage>> AnalysisStage::create(SampleRate rate) {
    audio::MusicAnalyzer analyzer;
    if (auto prepared = analyzer.prepare({.sample_rate = rate}); !prepared) {
        return fail(prepared.error());
    }
    return std::unique_ptr<AnalysisStage>(new AnalysisStage(rate, std::move(analyzer)));
}

AnalysisStage::AnalysisStage(SampleRate rate, audio::MusicAnalyzer analyzer)
    : rate_(rate), analyzer_(std::move(analyzer)) {}

void AnalysisStage::analyze(std::span<const float> mono) noexcept RAKS_NONBLOCKING {
    const FlushToZeroScope flush_to_zero;
    run_commands();
    analyzer_.process(mono, queue_);
    level_dbfs_.store(level_of(mono), std::memory_order_relaxed);  // relaxed: a meter
    // release: pairs with the acquire in taken_until().
    frames_taken_.fetch_add(static_cast<std::int64_t>(mono.size()), std::memory_order_release);
}

void AnalysisStage::mark_clock(StreamTime stream, HostTime host) noexcept RAKS_NONBLOCKING {
    clock_map_.update(stream, host);
    clock_line_.write(clock_map_.line());
}

void AnalysisStage::stop_clock(StreamTime stream) noexcept RAKS_NONBLOCKING {
    if (clock_map_.line().is_running) {
        clock_map_.stop(stream);
        clock_line_.write(clock_map_.line());
    }
}

void AnalysisStage::skip(std::int64_t frames) noexcept RAKS_NONBLOCKING {
    analyzer_.skip(rate_.time_of(frames).time_since_epoch());
    frames_taken_.fetch_add(frames, std::memory_order_release);  // see analyze()
}

StreamTime AnalysisStage::taken_until() const noexcept {
    return rate_.time_of(frames_taken_.load(std::memory_order_acquire));  // see analyze()
}

void AnalysisStage::run_commands() noexcept {
    audio::AnalyzerCommand command{};
    while (commands_.pop(command)) {
        analyzer_.command(command);
    }
}

}  // namespace raks::engine
