#include "engine/offline/clip_driver.hpp"

#include <utility>

#include "engine/offline/last_hops.hpp"

namespace raks::engine {

void ClipDriver::Performer::on_state(const MusicState& state) noexcept {
    newest = state.time;
    track_.append_final(state.hop, pose_at_(state));
    constexpr motion::DancerStatus kNobodyDances{};
    sink->on_hop({state, track_, std::span(&track_, 1), kNobodyDances});
}

Expected<ClipDriver> ClipDriver::create(SampleRate rate,
                                        const AnalyzerModels& models,
                                        PoseAt pose_at) {
    auto analyzer = make_analyzer(rate, models, audio::BeatMethod::pointer, make_tagger(models));
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
    bring_last_hops_out(*analyzer_, rate_, rate_.time_of(samples_fed_), performer_);
}

void ClipDriver::perform(StreamTime end, OfflineDriver::Sink& sink) {
    performer_.sink = &sink;
    for (HopIndex hop = performer_.newest_hop() + 1; time_of_hop(hop) < end; ++hop) {
        MusicState silence;
        silence.hop = hop;
        silence.time = time_of_hop(hop);
        performer_.on_state(silence);
    }
}

}  // namespace raks::engine
