#include "engine/trials/danced_figures.hpp"

#include <algorithm>
#include <cmath>
#include <optional>
#include <string_view>
#include <tuple>
#include <utility>

#include "base/time.hpp"

namespace raks::engine {
namespace {

using motion::DancerStatus;

constexpr double kWholeSlack = 0.25;  // beats from count 1 that a hop may be and yet begin there
constexpr double kWindowEnd = 0.6;    // beats behind a count that its landing may be

/// Hops [first, last) in which one figure went on without a break.
struct Stretch {
    std::size_t first = 0;
    std::size_t last = 0;
};

double seconds_of(std::size_t hop) { return static_cast<double>(hop) / kHopsPerSecond; }

bool goes_on(const DancerStatus& before, const DancerStatus& now) {
    return now.is_dancing && before.is_dancing && now.figure == before.figure &&
           now.octave == before.octave && now.reanchors == before.reanchors &&
           now.phase >= before.phase;
}

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

double beat_seconds(std::span<const audio::ReferenceBeat> beats, std::size_t i) {
    return to_seconds(beats[i].time);
}

/// Dance beats from the music's beat 0, counted at the figure's octave, to the figure's count 1,
/// the other way round: phase = octave x beat + offset. Nothing when no beat sounds meanwhile.
std::optional<double> count_offset(std::span<const DancerStatus> hops,
                                   const Stretch& stretch,
                                   std::span<const audio::ReferenceBeat> beats) {
    const double octave = hops[stretch.first].octave;
    std::vector<double> offsets;
    for (std::size_t b = 0; b < beats.size(); ++b) {
        const double at = beat_seconds(beats, b) * kHopsPerSecond;
        const auto hop = static_cast<std::size_t>(at);
        if (hop >= stretch.first && hop < stretch.last) {
            const double since = (at - std::floor(at)) / kHopsPerSecond;
            offsets.push_back(hops[hop].phase + hops[hop].rate * since -
                              octave * static_cast<double>(b));
        }
    }
    if (offsets.empty()) {
        return std::nullopt;
    }
    std::nth_element(offsets.begin(),
                     offsets.begin() + static_cast<std::ptrdiff_t>(offsets.size() / 2),
                     offsets.end());
    const double grid =
        std::min(octave, 1.0);  // where half the beats are counts, either half may be
    return grid * std::round(offsets[offsets.size() / 2] / grid);
}

void add_counts(std::span<const audio::ReferenceBeat> beats, double offset, DancedFigure& figure) {
    for (int count = 0; count <= figure.model->beats; ++count) {
        const double beat = (count - offset) / figure.octave;
        const double last = static_cast<double>(beats.size() - 1);
        const auto before = static_cast<std::size_t>(std::clamp(std::floor(beat), 0.0, last - 1.0));
        const double share = beat - static_cast<double>(before);
        const double length = beat_seconds(beats, before + 1) - beat_seconds(beats, before);
        figure.count_times.push_back(beat_seconds(beats, before) + share * length);
        const std::size_t nearest = share < 0.5 ? before : before + 1;
        figure.is_count_audible.push_back(beat >= 0.0 && beat <= last && beats[nearest].is_audible);
    }
}

const motion::FigureModel* model_of(std::span<const motion::FigureModel> models,
                                    const DancerStatus& status) {
    const std::string_view name(status.figure.data());
    const auto found = std::find_if(models.begin(), models.end(), [&](const auto& model) {
        return std::string_view(model.name).substr(0, status.figure.size() - 1) == name;
    });
    return found == models.end() ? nullptr : &*found;
}

/// Where the dance that hop `hop` is part of began and ended, seconds.
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
    if (beats.size() < 2) {
        return figures;
    }
    for (const Stretch& stretch : stretches_of(hops)) {
        const DancerStatus& begin = hops[stretch.first];
        const motion::FigureModel* const model = model_of(models, begin);
        const auto offset = count_offset(hops, stretch, beats);
        if (model == nullptr || !offset) {
            continue;
        }
        DancedFigure& figure = figures.emplace_back();
        figure.model = model;
        figure.octave = begin.octave;
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
        for (std::size_t k = 0; k + 1 < figure.count_times.size(); ++k) {
            const double time = figure.count_times[k];
            const double beat = figure.count_times[k + 1] - time;
            const bool is_danced = figure.is_whole || (time >= figure.from && time < figure.to);
            const bool is_settled = time >= figure.dance_from + window.blend_in &&
                                    time + kWindowEnd * beat < figure.dance_to;
            if (is_danced && is_settled && figure.is_count_audible[k] && time >= window.from &&
                time < window.to) {
                counts.push_back({figure.model, k, time, beat});
            }
        }
    }
    return counts;
}

}  // namespace raks::engine
