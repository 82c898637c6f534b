#include "audio/evaluate/form_scores.hpp"

#include <algorithm>
#include <chrono>

namespace raks::audio {
namespace {

// Index of the told event that matches best; told.size(): none does.
std::size_t match_of(const TrueEvent& wanted,
                     std::span<const ToldEvent> told,
                     const std::vector<char>& is_taken) {
    std::size_t best = told.size();
    for (std::size_t i = 0; i < told.size(); ++i) {
        const Nanos apart = std::chrono::abs(told[i].event.time - wanted.event.time);
        const bool fits = is_taken[i] == 0 && told[i].event.kind == wanted.event.kind &&
                          apart <= wanted.tolerance;
        if (fits && (best == told.size() ||
                     apart < std::chrono::abs(told[best].event.time - wanted.event.time))) {
            best = i;
        }
    }
    return best;
}

// Whether an event that matched none is right all the same.
bool is_excused(const MusicEvent& event, std::span<const TrueEvent> truth) {
    return std::any_of(truth.begin(), truth.end(), [&](const TrueEvent& wanted) {
        const Nanos after = event.time - wanted.event.time;
        if (wanted.event.kind == MusicEvent::Kind::end) {
            return after >= -wanted.tolerance;
        }
        return event.kind == MusicEvent::Kind::entry &&
               wanted.event.kind == MusicEvent::Kind::drop &&
               std::chrono::abs(after) <= wanted.tolerance;
    });
}

}  // namespace

double EventScore::recall() const noexcept {
    return wanted == 0 ? 1.0 : static_cast<double>(found) / static_cast<double>(wanted);
}

double EventScore::precision() const noexcept {
    const std::size_t told = found + false_ones;
    return told == 0 ? 1.0 : static_cast<double>(found) / static_cast<double>(told);
}

FormFaults score_form(std::span<const TrueEvent> truth,
                      std::span<const ToldEvent> told,
                      FormScores& scores) {
    FormFaults faults;
    std::vector<char> is_taken(told.size(), 0);
    for (const TrueEvent& wanted : truth) {
        EventScore& score = scores[static_cast<std::size_t>(wanted.event.kind)];
        ++score.wanted;
        const std::size_t match = match_of(wanted, told, is_taken);
        if (match == told.size()) {
            faults.missed.push_back(wanted.event);
            continue;
        }
        is_taken[match] = 1;
        ++score.found;
        score.offsets.push_back(to_seconds(told[match].event.time - wanted.event.time));
        score.delays.push_back(to_seconds(told[match].told - wanted.event.time));
    }
    for (std::size_t i = 0; i < told.size(); ++i) {
        if (is_taken[i] == 0 && !is_excused(told[i].event, truth)) {
            ++scores[static_cast<std::size_t>(told[i].event.kind)].false_ones;
            faults.false_ones.push_back(told[i].event);
        }
    }
    return faults;
}

}  // namespace raks::audio
