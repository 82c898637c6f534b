#include "apps/dances/tracked_counts.hpp"

#include <algorithm>
#include <cmath>
#include <utility>
#include <vector>

#include "apps/dances/known_dances.hpp"
#include "engine/offline/last_hops.hpp"
#include "engine/offline/music_source.hpp"
#include "engine/setup/analyzer_setup.hpp"

namespace raks::apps {
namespace {

// Confidence of the first beat that counts: earlier ones come from a tracker that still searches.
constexpr float kSure = 0.35F;
// Intervals that must be even before beats are extrapolated from them.
constexpr std::size_t kEvenBeats = 8;
// Largest deviation of one of these intervals from their mean, as a share of the mean.
constexpr double kEven = 0.1;
// Beats that are extrapolated at most.
constexpr std::size_t kMostBack = 16;

// Collects the announced beats, and the time of the newest state.
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

// Beats before the first one, extrapolated at the mean of the first eight intervals; none where
// these are uneven. Their place in the bar is not known: 0.
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

// Beats from the first confident one on, with the extrapolated ones before them.
std::vector<motion::MusicBeat> sure_beats(const std::vector<BeatEvent>& tracked, double duration) {
    const auto first = std::find_if(tracked.begin(), tracked.end(), [](const BeatEvent& beat) {
        return beat.confidence >= kSure;
    });
    std::vector<motion::MusicBeat> beats;
    for (auto beat = first; beat != tracked.end(); ++beat) {
        const double seconds = to_seconds(beat->time);
        // Beats must ascend; those in the silence after the end do not belong to the music.
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
    const auto models = load_models_of_known_dances();
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
    engine::bring_last_hops_out(*analyzer, source->rate(), end, collect);
    TrackedCounts tracked;
    tracked.music.name = file.filename().string();
    tracked.music.duration = to_seconds(end);
    tracked.music.beats = sure_beats(collect.beats, tracked.music.duration);
    tracked.warning = source->warning();
    return tracked;
}

}  // namespace raks::apps
