#include "apps/raks_train/tracked_counts.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>
#include <vector>

#include "engine/offline/music_source.hpp"
#include "engine/setup/analyzer_setup.hpp"
#include "engine/setup/dance_catalogue.hpp"

namespace raks::apps {
namespace {

constexpr float kSure = 0.35F;         // of the first beat that counts
constexpr std::size_t kEvenBeats = 8;  // that must be even to be carried back,
constexpr double kEven = 0.1;          // each interval within this share of their mean,
constexpr std::size_t kMostBack = 16;  // and by so many at most

class CollectBeats final : public audio::MusicAnalyzer::Sink {
 public:
    void on_state(const MusicState& state) noexcept override {
        if (state.has_beat) {
            beats.push_back(state.beat);
        }
        newest = state.time;
    }
    std::vector<BeatEvent> beats;
    StreamTime newest{Nanos(-1)};
};

/// Beats before the first one, at the tempo of the first eight, when these are even.
std::vector<motion::MusicBeat> carried_back(const std::vector<motion::MusicBeat>& beats) {
    if (beats.size() <= kEvenBeats) {
        return {};
    }
    const double mean = (beats[kEvenBeats].seconds - beats[0].seconds) / kEvenBeats;
    for (std::size_t i = 0; i < kEvenBeats; ++i) {
        if (std::abs(beats[i + 1].seconds - beats[i].seconds - mean) > kEven * mean) {
            return {};
        }
    }
    std::vector<motion::MusicBeat> before;
    for (std::size_t k = 1; k <= kMostBack; ++k) {
        const double seconds = beats[0].seconds - mean * static_cast<double>(k);
        if (seconds < 0.0) {
            break;
        }
        before.push_back({seconds, 0});
    }
    std::reverse(before.begin(), before.end());
    return before;
}

std::vector<motion::MusicBeat> sure_beats(const std::vector<BeatEvent>& tracked, double duration) {
    const auto first = std::find_if(tracked.begin(), tracked.end(), [](const BeatEvent& beat) {
        return beat.confidence >= kSure;
    });
    std::vector<motion::MusicBeat> beats;
    for (auto beat = first; beat != tracked.end(); ++beat) {
        const double seconds = to_seconds(beat->time);
        const bool is_later = beats.empty() || seconds > beats.back().seconds;
        if (is_later && seconds <= duration) {
            beats.push_back({seconds, beat->bar_position});
        }
    }
    std::vector<motion::MusicBeat> all = carried_back(beats);
    all.insert(all.end(), beats.begin(), beats.end());
    return all;
}

}  // namespace

Expected<TrackedCounts> track_counts(const std::filesystem::path& file) {
    auto source = engine::MusicSource::open(file);
    if (!source) {
        return fail(source.error());
    }
    const auto catalogue = engine::DanceCatalogue::load();
    if (!catalogue) {
        return fail(catalogue.error());
    }
    const auto models = engine::load_analyzer_models(catalogue->list());
    if (!models) {
        return fail(models.error());
    }
    auto analyzer = engine::make_analyzer(source->rate(), *models);
    if (!analyzer) {
        return fail(std::move(analyzer.error()).in(file.string()));
    }
    CollectBeats collect;
    for (auto block = source->next(); !block.mono.empty(); block = source->next()) {
        analyzer->process(block.mono, collect);
    }
    const StreamTime end(source->given());
    const std::array<float, 256> silence{};  // brings the last hops out
    for (Nanos fed{}; fed <= analyzer->delay() + kHop && collect.newest + kHop < end;
         fed += source->rate().time_of(silence.size()).time_since_epoch()) {
        analyzer->process(silence, collect);
    }
    TrackedCounts tracked;
    tracked.music.name = file.filename().string();
    tracked.music.duration = to_seconds(end);
    tracked.music.beats = sure_beats(collect.beats, tracked.music.duration);
    tracked.warning = source->warning();
    return tracked;
}

}  // namespace raks::apps
