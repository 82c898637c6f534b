#include "motion/figures/state_timing.hpp"

#include <cmath>
#include <numeric>

namespace raks::motion {
namespace {

// Mean and standard deviation over the repeats.
StateStay stay_of(const std::vector<double>& lengths) {
    const double count = static_cast<double>(lengths.size());
    const double mean = std::accumulate(lengths.begin(), lengths.end(), 0.0) / count;
    double square = 0.0;
    for (const double length : lengths) {
        square += (length - mean) * (length - mean);
    }
    return {Beats(mean), Beats(std::sqrt(square / count))};
}

}  // namespace

std::vector<std::vector<double>> count_occurrence(const StatePaths& paths,
                                                  int beats,
                                                  int samples_per_beat,
                                                  std::size_t states) {
    const std::size_t a_beat = static_cast<std::size_t>(samples_per_beat);
    const double samples_of_count = static_cast<double>(paths.size() * a_beat);
    std::vector<std::vector<double>> table(static_cast<std::size_t>(beats),
                                           std::vector<double>(states, 0.0));
    for (const std::vector<std::size_t>& path : paths) {
        for (std::size_t t = 0; t < path.size(); ++t) {
            // Each sample adds its share of the count, over all repeats; so rows sum to 1.
            table[t / a_beat][path[t]] += 1.0 / samples_of_count;
        }
    }
    return table;
}

std::vector<std::vector<double>> state_lengths(const StatePaths& paths,
                                               int samples_per_beat,
                                               std::size_t states) {
    std::vector<std::vector<double>> lengths(states, std::vector<double>(paths.size(), 0.0));
    for (std::size_t r = 0; r < paths.size(); ++r) {
        for (const std::size_t state : paths[r]) {
            lengths[state][r] += 1.0 / static_cast<double>(samples_per_beat);
        }
    }
    return lengths;
}

void set_timing(const StatePaths& paths, int beats, int samples_per_beat, PartModel& part) {
    part.occurrence = count_occurrence(paths, beats, samples_per_beat, part.states.size());
    part.stays.clear();
    for (const auto& lengths : state_lengths(paths, samples_per_beat, part.states.size())) {
        part.stays.push_back(stay_of(lengths));
    }
}

void set_sliced_timing(int beats, int samples_per_beat, PartModel& part) {
    const auto samples =
        static_cast<std::size_t>(beats) * static_cast<std::size_t>(samples_per_beat);
    std::vector<std::size_t> path(samples);
    for (std::size_t t = 0; t < samples; ++t) {
        path[t] = part.state_at(t, samples);
    }
    set_timing({path}, beats, samples_per_beat, part);
}

}  // namespace raks::motion
