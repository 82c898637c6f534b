#include "engine/offline/offline_driver.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <utility>

#include "engine/setup/analyzer_setup.hpp"

namespace raks::engine {
namespace {

// Passes each state of the analyzer to the dancers, and the result to the sink: the same order of
// calls as on the motion thread.
class DanceEachState final : public audio::MusicAnalyzer::Sink {
 public:
    DanceEachState(motion::Ensemble& dancers,
                   std::span<motion::PoseTrack> tracks,
                   OfflineDriver::Sink& sink)
        : dancers_(dancers), tracks_(tracks), sink_(sink) {}

    void on_state(const MusicState& state) noexcept override {
        dancers_.advance(state, tracks_);
        sink_.on_hop({state,
                      tracks_.front(),
                      tracks_,
                      dancers_.status(),
                      dancers_.held(),
                      dancers_.places()});
    }

 private:
    motion::Ensemble& dancers_;
    std::span<motion::PoseTrack> tracks_;
    OfflineDriver::Sink& sink_;
};

}  // namespace

Expected<OfflineDriver> OfflineDriver::create(SampleRate rate,
                                              const AnalyzerModels& models,
                                              const Cast& cast) {
    // The dancers' bodies and seeds are in the cast; everything that can fail fails here.
    auto analyzer = make_analyzer(rate, models, audio::BeatMethod::pointer, make_tagger(models));
    if (!analyzer) {
        return fail(analyzer.error());
    }
    motion::Ensemble dancers;
    if (auto prepared = dancers.prepare(cast); !prepared) {
        return fail(prepared.error());
    }
    return OfflineDriver(rate, std::move(*analyzer), std::move(dancers));
}

Expected<OfflineDriver> OfflineDriver::create(SampleRate rate,
                                              std::shared_ptr<const audio::SongPlan> plan,
                                              StreamTime start,
                                              const Cast& cast) {
    motion::Ensemble dancers;
    if (auto prepared = dancers.prepare(cast); !prepared) {
        return fail(prepared.error());
    }
    OfflineDriver driver(rate, audio::MusicAnalyzer(), std::move(dancers));
    driver.plan_ = std::move(plan);
    driver.plan_start_ = start;
    return driver;
}

OfflineDriver::OfflineDriver(SampleRate rate,
                             audio::MusicAnalyzer analyzer,
                             motion::Ensemble dancers)
    : rate_(rate),
      analyzer_(std::move(analyzer)),
      dancers_(std::move(dancers)),
      tracks_(dancers_.size()) {}

void OfflineDriver::feed(std::span<const float> mono, Sink& sink) {
    samples_fed_ += static_cast<std::int64_t>(mono.size());
    if (plan_) {
        perform_until(rate_.time_of(samples_fed_), sink);
        return;
    }
    // Made anew for each call: it only holds references.
    DanceEachState each(dancers_, tracks_, sink);
    analyzer_.process(mono, each);
}

// The plan's hops that begin before `end`.
void OfflineDriver::perform_until(StreamTime end, Sink& sink) {
    DanceEachState each(dancers_, tracks_, sink);
    for (; time_of_hop(next_hop_) < end; ++next_hop_) {
        each.on_state(
            plan_->at(plan_start_ + time_of_hop(next_hop_).time_since_epoch(), next_hop_));
    }
}

void OfflineDriver::finish(Sink& sink) {
    const StreamTime end = rate_.time_of(samples_fed_);
    if (plan_) {
        return;  // feed() has performed every hop already
    }
    const std::array<float, 256> silence{};
    DanceEachState each(dancers_, tracks_, sink);
    // A hop is complete delay() after its time, so that much silence is needed; one hop more
    // absorbs the rounding of hops to samples.
    for (Nanos left = analyzer_.delay() + kHop;
         // Stops early once the last hop before the end is final.
         left.count() > 0 && time_of_hop(tracks_.front().newest_final() + 1) < end;
         left -= rate_.time_of(silence.size()).time_since_epoch()) {
        analyzer_.process(silence, each);
    }
}

void CollectPoses::on_hop(const PerformedHop& hop) {
    dancers.resize(hop.tracks.size());
    last_.resize(hop.tracks.size());
    // A track is final up to its newest final hop only: later poses may still change.
    for (; next_time() <= time_of_hop(hop.track.newest_final()); ++next_) {
        for (std::size_t i = 0; i < dancers.size(); ++i) {
            dancers[i].push_back(hop.tracks[i].at(next_time()));
        }
    }
    // Kept for finish(): the tracks end a little before the music does.
    for (std::size_t i = 0; i < dancers.size(); ++i) {
        last_[i] = hop.tracks[i].at_hop(hop.track.newest_final());
    }
}

void CollectPoses::finish(Nanos duration) {
    // Rounded up: the last picture of a film begins before the music ends.
    const auto count = static_cast<std::size_t>(std::ceil(to_seconds(duration) * fps_));
    for (std::size_t i = 0; i < dancers.size(); ++i) {
        dancers[i].resize(count, last_[i]);
    }
}

StreamTime CollectPoses::next_time() const {
    // Computed from the index, not accumulated: no drift over a long film.
    return stream_time_from_seconds(static_cast<double>(next_) / fps_);
}

}  // namespace raks::engine
