#include "engine/trials/danced_figures.hpp"

#include <algorithm>
#include <cmath>
#include <optional>
#include <string_view>
#include <tuple>
#include <utility>

#include "base/statistics.hpp"
#include "base/time.hpp"

namespace raks::engine {
namespace {

using motion::DancerStatus;

// Beats that a hop may lie after count 1 (or before the next one) and the figure still counts as
// whole.
constexpr double kWholeSlack = 0.25;
// Beats after a count within which its landing may come: landings behind the end of a dance would
// be missed.
constexpr double kWindowEnd = 0.6;

/// Hops [first, last) in which one figure went on without a break.
struct Stretch {
    std::size_t first = 0;
    std::size_t last = 0;
};

// Time of a hop from the stream's start.
double seconds_of(std::size_t hop) { return static_cast<double>(hop) / kHopsPerSecond; }

// True while the same figure goes on: the same name, number, octave and anchoring, and a phase that
// does not fall back. A piece of a take may be followed by a later piece of the same take.
bool goes_on(const DancerStatus& before, const DancerStatus& now) {
    return now.is_dancing && before.is_dancing && now.figure == before.figure &&
           now.number == before.number && now.octave == before.octave &&
           now.reanchors == before.reanchors && now.phase >= before.phase;
}

// Splits the hops into stretches of one figure each; hops without dancing belong to none.
std::vector<Stretch> stretches_of(std::span<const DancerStatus> hops) {
    std::vector<Stretch> stretches;
    for (std::size_t h = 0; h < hops.size(); ++h) {
        if (!hops[h].is_dancing) {
            continue;
        }
        if (h == 0 || !goes_on(hops[h - 1], hops[h])) {
            stretches.push_back({h, h});
        }
        stretches.back().last = h + 1;
    }
    return stretches;
}

// Time of beat i, seconds of the stream.
double beat_seconds(std::span<const audio::ReferenceBeat> beats, std::size_t i) {
    return to_seconds(beats[i].time);
}

// Offset between the figure's beats and the music's: phase = octave x beat + offset. Each beat of
// the music that falls into the stretch gives one estimate; the median is rounded to the grid of
// counts. Nothing when no beat falls into it.
std::optional<double> count_offset(std::span<const DancerStatus> hops,
                                   const Stretch& stretch,
                                   std::span<const audio::ReferenceBeat> beats) {
    const double octave = hops[stretch.first].octave;
    std::vector<double> offsets;
    for (std::size_t b = 0; b < beats.size(); ++b) {
        const double at = beat_seconds(beats, b) * kHopsPerSecond;
        const auto hop = static_cast<std::size_t>(at);
        // The phase at the beat, from the hop before it and the rate.
        if (hop >= stretch.first && hop < stretch.last) {
            const double since = (at - std::floor(at)) / kHopsPerSecond;
            offsets.push_back(hops[hop].phase + hops[hop].rate * since -
                              octave * static_cast<double>(b));
        }
    }
    if (offsets.empty()) {
        return std::nullopt;
    }
    // At octave 0.5 half of the music's beats are counts, and either half may be: the grid is half
    // a beat then.
    const double grid = std::min(octave, 1.0);
    // The median: a beat at which the phase was just being corrected does not matter.
    return grid * std::round(upper_median(std::move(offsets)) / grid);
}

// Times of all counts, interpolated between the music's beats: counts may lie between beats at
// octave 2. Beyond the first or last beat the nearest interval goes on.
void add_counts(std::span<const audio::ReferenceBeat> beats, double offset, DancedFigure& figure) {
    for (int count = 0; count <= figure.model->beats; ++count) {
        const double beat = (count - offset) / figure.octave;
        const double last = static_cast<double>(beats.size() - 1);
        const auto before = static_cast<std::size_t>(std::clamp(std::floor(beat), 0.0, last - 1.0));
        const double share = beat - static_cast<double>(before);
        const double length = beat_seconds(beats, before + 1) - beat_seconds(beats, before);
        figure.count_times.push_back(beat_seconds(beats, before) + share * length);
        // A count is judged as audible by the beat next to it.
        const std::size_t nearest = share < 0.5 ? before : before + 1;
        figure.is_count_audible.push_back(beat >= 0.0 && beat <= last && beats[nearest].is_audible);
    }
}

// The model of the status' figure. The status holds a cut-off name: compared as far as it goes.
const motion::FigureModel* model_of(std::span<const motion::FigureModel> models,
                                    const DancerStatus& status) {
    const std::string_view name(status.figure.data());
    const auto found = std::find_if(models.begin(), models.end(), [&](const auto& model) {
        return std::string_view(model.name).substr(0, status.figure.size() - 1) == name;
    });
    return found == models.end() ? nullptr : &*found;
}

// Seconds at which the dance (from standing to standing) that contains this hop began and ended.
std::pair<double, double> dance_around(std::span<const DancerStatus> hops, std::size_t hop) {
    std::size_t first = hop;
    std::size_t last = hop;
    while (first > 0 && hops[first - 1].is_dancing) {
        --first;
    }
    while (last + 1 < hops.size() && hops[last + 1].is_dancing) {
        ++last;
    }
    return {seconds_of(first), seconds_of(last + 1)};
}

}  // namespace

std::vector<DancedFigure> danced_figures(std::span<const DancerStatus> hops,
                                         std::span<const audio::ReferenceBeat> beats,
                                         std::span<const motion::FigureModel> models) {
    std::vector<DancedFigure> figures;
    // An interval is needed to interpolate.
    if (beats.size() < 2) {
        return figures;
    }
    for (const Stretch& stretch : stretches_of(hops)) {
        const DancerStatus& begin = hops[stretch.first];
        const motion::FigureModel* const model = model_of(models, begin);
        const auto offset = count_offset(hops, stretch, beats);
        // A figure of another dance, or one during a silence: nothing to judge.
        if (model == nullptr || !offset) {
            continue;
        }
        DancedFigure& figure = figures.emplace_back();
        figure.model = model;
        figure.octave = begin.octave;
        figure.is_mirrored = begin.is_mirrored;
        figure.from = seconds_of(stretch.first);
        figure.to = seconds_of(stretch.last);
        std::tie(figure.dance_from, figure.dance_to) = dance_around(hops, stretch.first);
        const double end_phase = hops[stretch.last - 1].phase;
        figure.is_whole = begin.phase < kWholeSlack && end_phase > model->beats - kWholeSlack;
        add_counts(beats, *offset, figure);
    }
    return figures;
}

std::vector<motion::AudibleCount> audible_counts(std::span<const DancedFigure> figures,
                                                 const CountWindow& window) {
    std::vector<motion::AudibleCount> counts;
    for (const DancedFigure& figure : figures) {
        // The last entry is count 1 of the next figure and is judged there.
        for (std::size_t k = 0; k + 1 < figure.count_times.size(); ++k) {
            const double time = figure.count_times[k];
            const double beat = figure.count_times[k + 1] - time;
            // Of a figure that was cut short, or a piece of a take, only the counts that were
            // reached: the one at which the next piece begins is of that one.
            const double slack = kWholeSlack * beat;
            const bool is_danced =
                figure.is_whole || (time >= figure.from - slack && time < figure.to - slack);
            const bool is_settled = time >= figure.dance_from + window.blend_in &&
                                    time + kWindowEnd * beat < figure.dance_to;
            if (is_danced && is_settled && figure.is_count_audible[k] && time >= window.from &&
                time < window.to) {
                counts.push_back({figure.model, k, time, beat, figure.is_mirrored});
            }
        }
    }
    return counts;
}

}  // namespace raks::engine
