#include "audio/song/bar_path.hpp"

#include <algorithm>
#include <array>
#include <cmath>

namespace raks::audio {
namespace {

// All places of all metres, one after the other.
std::vector<BarPlace> all_places() {
    std::vector<BarPlace> places;
    for (const int metre : BarModel::kMetres) {
        for (int position = 0; position < metre; ++position) {
            places.push_back({metre, position});
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
    return bars;
}

}  // namespace raks::audio
