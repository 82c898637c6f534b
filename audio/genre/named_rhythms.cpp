#include "audio/genre/named_rhythms.hpp"

#include <algorithm>
#include <cmath>
#include <functional>
#include <numeric>
#include <string_view>

namespace raks::audio {
namespace {

constexpr float kLeastDeviation = 1e-4F;  // of a group's onsets; less is no pattern

// One line a group, one character a step: 'x' is a hit. An empty line: any hits.
struct Rhythm {
    std::size_t cycle;                     // beats that it is looked for in
    std::array<std::size_t, 2> step;       // quarters of a beat that a step may last
    std::array<std::string_view, 3> hits;  // low, middle, high
};

// The low drum (dum) sounds in the low group, the high one (tek) in both others.
constexpr std::array<Rhythm, NamedRhythms::kRhythms> kTable = {{
    {8, {1, 2}, {"x.......x.......", "..x...x.....x...", "..x...x.....x..."}},
    {8, {1, 2}, {"x.....x.x.......", "..x.........x...", "..x.........x..."}},
    {8, {1, 2}, {"x.......x.......", "...x..x....x..x.", "...x..x....x..x."}},
    {9, {2, 4}, {"x...x....", "..x...xxx", "..x...xxx"}},
    {8, {1, 2}, {"", "x..x..x...x.x...", ""}},
    {8, {1, 2}, {"...x..x....x..x.", "", ""}},
    {8, {1, 2}, {"x...x...x...x...", "", "..x...x...x...x."}},
    {8, {1, 2}, {"x......x..x.....", "....x.......x...", ""}},
    {8, {1, 2}, {"x.......x.......", "....x.......x...", "x.x.x.x.x.x.x.x."}},
    {6, {1, 2}, {"x...........", "....x...x...", ""}},
}};

// Mean onset strength of each slot, brought to mean 0 and deviation 1; all 0 without a pattern.
template <std::size_t Slots>
std::array<float, Slots> standardized(const std::array<float, Slots>& sums,
                                      const std::array<float, Slots>& hops) noexcept {
    std::array<float, Slots> values{};
    float mean = 0.0F;
    for (std::size_t i = 0; i < Slots; ++i) {
        values[i] = hops[i] > 0.0F ? sums[i] / hops[i] : 0.0F;
        mean += values[i] / static_cast<float>(Slots);
    }
    float square = 0.0F;
    for (float& value : values) {
        value -= mean;
        square += value * value / static_cast<float>(Slots);
    }
    const float deviation = std::sqrt(square);
    const float scale = deviation > kLeastDeviation ? 1.0F / deviation : 0.0F;
    for (float& value : values) {
        value *= scale;
    }
    return values;
}

// Correlation of one group, begun at slot `start`, with hits that repeat over the cycle.
template <std::size_t Slots>
float correlation(const std::array<float, Slots>& pattern,
                  std::string_view hits,
                  std::size_t step,
                  std::size_t start) noexcept {
    const std::size_t length = hits.size() * step;
    float sum = 0.0F;
    float count = 0.0F;
    for (std::size_t i = 0; i < hits.size(); ++i) {
        if (hits[i] != 'x') {
            continue;
        }
        for (std::size_t slot = start + i * step; slot < start + Slots; slot += length) {
            sum += pattern[slot % Slots];
            count += 1.0F;
        }
    }
    const float share = count / static_cast<float>(Slots);
    return sum / (static_cast<float>(Slots) * std::sqrt(share * (1.0F - share)));
}

// The highest mean over the groups that have hits, of all speeds and beginnings.
template <std::size_t Slots>
float likeness_to(const Rhythm& rhythm,
                  const std::array<std::array<float, Slots>, 3>& patterns) noexcept {
    float best = -1.0F;
    for (const std::size_t step : rhythm.step) {
        for (std::size_t start = 0; start < Slots; start += 4) {
            float sum = 0.0F;
            float groups = 0.0F;
            for (std::size_t group = 0; group < patterns.size(); ++group) {
                if (!rhythm.hits[group].empty()) {
                    sum += correlation(patterns[group], rhythm.hits[group], step, start);
                    groups += 1.0F;
                }
            }
            best = std::max(best, sum / groups);
        }
    }
    return best;
}

// Likeness to the rhythms that are looked for in a cycle of `beats`.
template <class Cycle>
void compare(const Cycle& cycle, std::size_t beats, std::span<float> out) noexcept {
    std::array<std::array<float, Cycle::kSlots>, 3> patterns{};
    for (std::size_t group = 0; group < patterns.size(); ++group) {
        patterns[group] = standardized(cycle.onsets[group], cycle.hops);
    }
    for (std::size_t i = 0; i < kTable.size(); ++i) {
        if (kTable[i].cycle == beats) {
            out[i] = likeness_to(kTable[i], patterns);
        }
    }
}

template <class Cycle>
void count(Cycle& cycle, std::span<const float> onsets, double beats) noexcept {
    constexpr auto kSlots = static_cast<double>(Cycle::kSlots);
    const double nearest = std::floor(4.0 * beats + 0.5);
    const double inside = nearest - kSlots * std::floor(nearest / kSlots);
    const auto slot = static_cast<std::size_t>(std::clamp(inside, 0.0, kSlots - 1.0));
    for (std::size_t group = 0; group < cycle.onsets.size(); ++group) {
        cycle.onsets[group][slot] += onsets[group];
    }
    cycle.hops[slot] += 1.0F;
}

template <class Cycle>
void join(Cycle& cycle, const Cycle& more) noexcept {
    const auto sum = [](auto& to, const auto& from) {
        std::transform(to.begin(), to.end(), from.begin(), to.begin(), std::plus<>());
    };
    for (std::size_t group = 0; group < cycle.onsets.size(); ++group) {
        sum(cycle.onsets[group], more.onsets[group]);
    }
    sum(cycle.hops, more.hops);
}

}  // namespace

void NamedRhythms::add(std::span<const float, kGroups> onsets,
                       double beats) noexcept RAKS_NONBLOCKING {
    count(fours_, onsets, beats);
    count(threes_, onsets, beats);
    count(nines_, onsets, beats);
}

void NamedRhythms::add(const NamedRhythms& other) noexcept RAKS_NONBLOCKING {
    join(fours_, other.fours_);
    join(threes_, other.threes_);
    join(nines_, other.nines_);
}

std::array<float, NamedRhythms::kRhythms> NamedRhythms::likeness() const noexcept RAKS_NONBLOCKING {
    std::array<float, kRhythms> found{};
    compare(fours_, 8, found);
    compare(threes_, 6, found);
    compare(nines_, 9, found);
    return found;
}

}  // namespace raks::audio
