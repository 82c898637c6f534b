#include "audio/song/bar_path.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <numeric>

namespace raks::audio {
namespace {

// All places of all metres, one after the other.
std::vector<BarPlace> all_places() {
    std::vector<BarPlace> places;
    for (const int metre : BarModel::kMetres) {
        for (int position = 0; position < metre; ++position) {
            places.push_back({metre, position, 0.0F});
        }
    }
    return places;
}

// ln probability that a beat at `from` is followed by one at `to`.
double log_transition(const BarPlace& from, const BarPlace& to) {
    const auto prior = static_cast<double>(BarModel::prior_of(to.beats_per_bar));
    const auto leak = static_cast<double>(BarModel::kLeak);
    const auto change = static_cast<double>(BarModel::kMetreChange);
    const bool is_same = from.beats_per_bar == to.beats_per_bar;
    double follows = 0.0;
    if (from.position + 1 < from.beats_per_bar) {
        follows = is_same && to.position == from.position + 1 ? 1.0 : 0.0;
    } else if (to.position == 0) {
        follows = (is_same ? 1.0 - change : 0.0) + change * prior;
    }
    return std::log((1.0 - leak) * follows + leak * prior / to.beats_per_bar);
}

double log_likelihood(const BarLikelihood& beat, const BarPlace& place) {
    return std::log(static_cast<double>(beat.of(place.beats_per_bar, place.position)));
}

using Probabilities = std::vector<double>;  // by place

void normalize(Probabilities& values) {
    const double sum = std::accumulate(values.begin(), values.end(), 0.0);
    for (double& value : values) {
        value /= sum;
    }
}

// Forward and backward recursion: the probability of every place at every beat.
std::vector<Probabilities> probabilities_of(std::span<const BarLikelihood> beats,
                                            const std::vector<BarPlace>& places) {
    const std::size_t count = places.size();
    std::vector<double> follows(count * count);
    for (std::size_t from = 0; from < count; ++from) {
        for (std::size_t to = 0; to < count; ++to) {
            follows[from * count + to] = std::exp(log_transition(places[from], places[to]));
        }
    }
    const auto likelihood = [&](std::size_t beat, std::size_t place) {
        return std::exp(log_likelihood(beats[beat], places[place]));
    };
    std::vector<Probabilities> result(beats.size(), Probabilities(count));
    for (std::size_t beat = 0; beat < beats.size(); ++beat) {
        for (std::size_t to = 0; to < count; ++to) {
            double reached =
                beat == 0 ? static_cast<double>(BarModel::prior_of(places[to].beats_per_bar)) /
                                places[to].beats_per_bar
                          : 0.0;
            for (std::size_t from = 0; beat > 0 && from < count; ++from) {
                reached += result[beat - 1][from] * follows[from * count + to];
            }
            result[beat][to] = reached * likelihood(beat, to);
        }
        normalize(result[beat]);
    }
    Probabilities after(count, 1.0);  // likelihood of all later beats
    for (std::size_t beat = beats.size(); beat-- > 0;) {
        Probabilities before(count);
        for (std::size_t from = 0; from < count; ++from) {
            for (std::size_t to = 0; to < count; ++to) {
                before[from] += follows[from * count + to] * likelihood(beat, to) * after[to];
            }
        }
        for (std::size_t place = 0; place < count; ++place) {
            result[beat][place] *= after[place];
        }
        normalize(result[beat]);
        normalize(before);
        after = std::move(before);
    }
    return result;
}

}  // namespace

std::vector<BarPlace> find_bars(std::span<const BarLikelihood> beats) {
    const std::vector<BarPlace> places = all_places();
    const std::size_t count = places.size();
    std::vector<double> best(count);
    for (std::size_t i = 0; i < count; ++i) {
        best[i] = std::log(static_cast<double>(BarModel::prior_of(places[i].beats_per_bar)) /
                           places[i].beats_per_bar);
    }
    std::vector<std::vector<std::size_t>> came_from;  // by beat, then by place
    std::vector<double> moved(count);
    for (std::size_t beat = 0; beat < beats.size(); ++beat) {
        std::vector<std::size_t> from(count);
        for (std::size_t to = 0; to < count; ++to) {
            moved[to] = beat == 0 ? best[to] : -1e300;
            for (std::size_t i = 0; beat > 0 && i < count; ++i) {
                const double way = best[i] + log_transition(places[i], places[to]);
                if (way > moved[to]) {
                    moved[to] = way;
                    from[to] = i;
                }
            }
            moved[to] += log_likelihood(beats[beat], places[to]);
        }
        came_from.push_back(std::move(from));
        best.swap(moved);
    }
    std::vector<BarPlace> bars(beats.size());
    auto place =
        static_cast<std::size_t>(std::max_element(best.begin(), best.end()) - best.begin());
    for (std::size_t beat = beats.size(); beat-- > 0;) {
        bars[beat] = places[place];
        place = came_from[beat][place];
    }
    const std::vector<Probabilities> probable = probabilities_of(beats, places);
    for (std::size_t beat = 0; beat < bars.size(); ++beat) {
        const auto at = std::find_if(places.begin(), places.end(), [&](const BarPlace& one) {
            return one.beats_per_bar == bars[beat].beats_per_bar &&
                   one.position == bars[beat].position;
        });
        bars[beat].confidence =
            static_cast<float>(probable[beat][static_cast<std::size_t>(at - places.begin())]);
    }
    return bars;
}

}  // namespace raks::audio
