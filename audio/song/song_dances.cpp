#include "audio/song/song_dances.hpp"

#include <algorithm>

namespace raks::audio {
namespace {

constexpr std::size_t kStep = 50;  // hops: probabilities are looked at every half second
// ln of the odds against another class at any step.
constexpr double kChangeCost = 12.0;
// A probability of the model is not believed to be smaller: it was learnt on other music.
constexpr float kLeastLog = -4.0F;

// The evidence of one step: mean ln probability by class, as much as the step is of the window,
// since windows overlap. Silence has none.
std::vector<double> evidence_of(const MusicState& state, std::size_t classes, double weight) {
    std::vector<double> evidence(classes, 0.0);
    if (!state.is_silent) {
        for (std::size_t i = 0; i < classes; ++i) {
            evidence[i] =
                weight * static_cast<double>(std::max(kLeastLog, state.genre_log_probability[i]));
        }
    }
    return evidence;
}

}  // namespace

std::vector<SongSection> find_sections(std::span<const MusicState> states,
                                       std::size_t classes,
                                       double window_seconds) {
    const double weight = static_cast<double>(kStep) / kHopsPerSecond / window_seconds;
    std::vector<double> best(classes, 0.0);
    std::vector<std::vector<std::uint8_t>> came_from;
    for (std::size_t hop = kStep - 1; hop < states.size(); hop += kStep) {
        const std::vector<double> evidence = evidence_of(states[hop], classes, weight);
        const auto leader =
            static_cast<std::size_t>(std::max_element(best.begin(), best.end()) - best.begin());
        const double changed = best[leader] - kChangeCost;
        std::vector<std::uint8_t> from(classes);
        for (std::size_t i = 0; i < classes; ++i) {
            const bool stays = best[i] >= changed;
            from[i] = static_cast<std::uint8_t>(stays ? i : leader);
            best[i] = (stays ? best[i] : changed) + evidence[i];
        }
        came_from.push_back(std::move(from));
    }
    if (states.empty()) {
        return {};
    }
    auto one = static_cast<std::uint8_t>(std::max_element(best.begin(), best.end()) - best.begin());
    std::vector<SongSection> sections;
    // A window's probabilities are about its middle.
    const auto late = static_cast<std::size_t>(0.5 * window_seconds * kHopsPerSecond);
    for (std::size_t step = came_from.size(); step-- > 0;) {
        const std::uint8_t before = came_from[step][one];
        if (before != one && step > 0) {
            const std::size_t hop = step * kStep;
            sections.push_back({std::max<std::size_t>(1, hop - std::min(hop, late)), one});
        }
        one = before;
    }
    sections.push_back({0, one});
    std::reverse(sections.begin(), sections.end());
    return sections;
}

}  // namespace raks::audio
