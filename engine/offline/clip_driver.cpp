#include "engine/offline/clip_driver.hpp"

#include <array>
#include <utility>

namespace raks::engine {

void ClipDriver::Performer::on_state(const MusicState& state) noexcept {
    track_.append_final(state.hop, pose_at_(to_seconds(state.time)));
    constexpr motion::DancerStatus kNobodyDances{};
    sink->on_hop({state, track_, std::span(&track_, 1), kNobodyDances});
}

Expected<ClipDriver> ClipDriver::create(SampleRate rate,
                                        const AnalyzerModels& models,
                                        PoseAt pose_at) {
    auto analyzer = make_analyzer(rate, models);
    if (!analyzer) {
        return fail(analyzer.error());
    }
    ClipDriver driver(std::move(pose_at));
    driver.analyzer_ = std::move(*analyzer);
    driver.rate_ = rate;
    return driver;
}

void ClipDriver::feed(std::span<const float> mono, OfflineDriver::Sink& sink) {
    samples_fed_ += static_cast<std::int64_t>(mono.size());
    performer_.sink = &sink;
    analyzer_->process(mono, performer_);
}

void ClipDriver::finish(OfflineDriver::Sink& sink) {
    performer_.sink = &sink;
    const StreamTime end = rate_.time_of(samples_fed_);
    const std::array<float, 256> silence{};
    for (Nanos left = analyzer_->delay() + kHop;
         left.count() > 0 && time_of_hop(performer_.newest() + 1) < end;
         left -= rate_.time_of(silence.size()).time_since_epoch()) {
        analyzer_->process(silence, performer_);
    }
}

void ClipDriver::perform(StreamTime end, OfflineDriver::Sink& sink) {
    performer_.sink = &sink;
    for (HopIndex hop = performer_.newest() + 1; time_of_hop(hop) < end; ++hop) {
        MusicState silence;
        silence.hop = hop;
        silence.time = time_of_hop(hop);
        performer_.on_state(silence);
    }
}

}  // namespace raks::engine
