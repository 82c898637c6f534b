#include "engine/offline_driver.hpp"

#include <algorithm>
#include <array>
#include <utility>

#include "engine/hearing.hpp"

namespace raks::engine {
namespace {

/// Hands each state of the analyzer to the dancer, and the result on.
class DanceEachState final : public audio::MusicAnalyzer::Sink {
 public:
    DanceEachState(motion::Dancer& dancer, motion::PoseTrack& track, OfflineDriver::Sink& sink)
        : dancer_(dancer), track_(track), sink_(sink) {}

    void on_state(const MusicState& state) noexcept override {
        dancer_.advance(state, track_);
        sink_.on_hop({state, track_, dancer_.status()});
    }

 private:
    motion::Dancer& dancer_;
    motion::PoseTrack& track_;
    OfflineDriver::Sink& sink_;
};

}  // namespace

Expected<OfflineDriver> OfflineDriver::create(SampleRate rate,
                                              std::shared_ptr<const motion::DanceLibrary> library,
                                              std::uint64_t seed) {
    auto analyzer = make_analyzer(rate);
    if (!analyzer) {
        return fail(analyzer.error());
    }
    motion::Dancer dancer;
    if (auto prepared = dancer.prepare(std::move(library), motion::mannequin_skeleton(), seed);
        !prepared) {
        return fail(prepared.error());
    }
    return OfflineDriver(rate, std::move(*analyzer), std::move(dancer));
}

OfflineDriver::OfflineDriver(SampleRate rate, audio::MusicAnalyzer analyzer, motion::Dancer dancer)
    : rate_(rate),
      analyzer_(std::move(analyzer)),
      dancer_(std::move(dancer)),
      track_(std::make_unique<motion::PoseTrack>()) {}

void OfflineDriver::feed(std::span<const float> mono, Sink& sink) {
    DanceEachState each(dancer_, *track_, sink);
    analyzer_.process(mono, each);
    samples_fed_ += static_cast<std::int64_t>(mono.size());
}

void OfflineDriver::finish(Sink& sink) {
    const StreamTime end = rate_.time_of(samples_fed_);
    const std::array<float, 256> silence{};
    DanceEachState each(dancer_, *track_, sink);
    // delay() of silence completes the hops before the end; one hop more absorbs rounding.
    for (Nanos left = analyzer_.delay() + kHop;
         left.count() > 0 && time_of_hop(track_->newest_final() + 1) < end;
         left -= rate_.time_of(silence.size()).time_since_epoch()) {
        analyzer_.process(silence, each);
    }
}

}  // namespace raks::engine
