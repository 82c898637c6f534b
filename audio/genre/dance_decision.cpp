#include "audio/genre/dance_decision.hpp"

#include <algorithm>
#include <cmath>
#include <span>

#include "audio/genre/genre_model.hpp"

namespace raks::audio {
namespace {

// ln probability of what is out of the question.
constexpr float kRuledOut = -20.0F;
// Of the grid: beats and bars are sure from here on.
constexpr float kSureBeat = 0.6F;
constexpr float kSureBars = 0.7F;
// Music must have been heard for so long before its metre rules a dance out.
constexpr std::int64_t kMetreHops = 1000;

bool is_in_threes(int beats_per_bar) noexcept { return beats_per_bar % 3 == 0; }

}  // namespace

bool contradicts(const BeatGrid& grid, int bars) noexcept {
    return bars > 0 && grid.confidence > kSureBeat && grid.bar_confidence > kSureBars &&
           is_in_threes(bars) != is_in_threes(grid.beats_per_bar);
}

DanceDecision::DanceDecision(std::size_t classes,
                             const ClassBars& bars,
                             const GenreLogProbabilities& prior,
                             const DecisionRules& rules) noexcept
    : classes_(classes), bars_(bars), prior_(prior), rules_(rules) {
    reset();
}

void DanceDecision::expect(const GenreLogProbabilities& prior) noexcept RAKS_NONBLOCKING {
    prior_ = prior;
    if (!has_heard_) {
        reset();
    }
}

void DanceDecision::reset() noexcept RAKS_NONBLOCKING {
    has_heard_ = false;
    // "None of them" with probability 1 until music is known.
    log_chances_.fill(kRuledOut);
    log_chances_[classes_ - 1] = 0.0F;
    shown_ = challenger_ = heard_ = classes_ - 1;
    leads_for_ = 0.0;
    const std::span<const float> prior = std::span(prior_).first(classes_);
    const auto likeliest = std::max_element(prior.begin(), prior.end());
    if (*likeliest > 0.0F) {
        std::copy(prior.begin(), prior.end(), log_chances_.begin());
        normalize_logs(std::span(log_chances_).first(classes_));
        shown_ = challenger_ = static_cast<std::size_t>(likeliest - prior.begin());
    }
}

std::size_t DanceDecision::best() const noexcept {
    const auto end = log_chances_.begin() + static_cast<std::ptrdiff_t>(classes_);
    return static_cast<std::size_t>(std::max_element(log_chances_.begin(), end) -
                                    log_chances_.begin());
}

// The class that leads; none of them where it is not likely enough.
std::size_t DanceDecision::weigh(const Values& heard,
                                 std::int64_t heard_hops,
                                 const BeatGrid& grid) noexcept {
    has_heard_ = true;
    log_chances_ = heard;
    heard_ = best();
    add_prior(heard_hops, grid);
    rule_out_metres(heard_hops, grid);
    const std::size_t likeliest = best();
    return std::exp(log_chances_[likeliest]) < rules_.least_chance ? classes_ - 1 : likeliest;
}

void DanceDecision::advance(const Values& heard,
                            std::int64_t heard_hops,
                            const BeatGrid& grid) noexcept RAKS_NONBLOCKING {
    challenge(weigh(heard, heard_hops, grid), grid);
}

void DanceDecision::settle(const Values& heard,
                           std::int64_t heard_hops,
                           const BeatGrid& grid) noexcept {
    shown_ = weigh(heard, heard_hops, grid);
}

// Bars of another metre than a dance's take its prior away.
void DanceDecision::add_prior(std::int64_t heard_hops, const BeatGrid& grid) noexcept {
    bool is_changed = false;
    for (std::size_t c = 0; c < classes_; ++c) {
        const bool is_forbidden =
            heard_hops >= kMetreHops && prior_[c] < kCertainPrior && contradicts(grid, bars_[c]);
        if (prior_[c] != 0.0F && !is_forbidden) {
            log_chances_[c] += prior_[c];
            is_changed = true;
        }
    }
    // Without a prior the values stay as they are, to the bit.
    if (is_changed) {
        normalize_logs(std::span(log_chances_).first(classes_));
    }
}

void DanceDecision::rule_out_metres(std::int64_t heard_hops, const BeatGrid& grid) noexcept {
    bool is_changed = false;
    for (std::size_t c = 0; heard_hops >= kMetreHops && c + 1 < classes_; ++c) {
        if (prior_[c] < kCertainPrior && contradicts(grid, bars_[c])) {
            log_chances_[c] = kRuledOut;
            is_changed = true;
        }
    }
    if (is_changed) {
        normalize_logs(std::span(log_chances_).first(classes_));
    }
}

void DanceDecision::challenge(std::size_t best, const BeatGrid& grid) noexcept {
    const std::size_t none = classes_ - 1;
    const auto chance = [&](std::size_t c) { return std::exp(log_chances_[c]); };
    // Applause, talk, the gap between two songs: sound without a beat does not end a dance. From
    // "none of them" any dance may be entered.
    const bool is_beatless = shown_ != none && grid.confidence < rules_.least_confidence;
    // The lead must last without a break: anything else starts its time anew.
    if (best == shown_ || is_beatless || chance(best) < chance(shown_) + rules_.margin) {
        leads_for_ = 0.0;
        challenger_ = best;
        return;
    }
    // Another challenger than before starts at its own first step.
    leads_for_ = best == challenger_ ? leads_for_ + kStep : kStep;
    challenger_ = best;
    if (leads_for_ >= (best == none ? rules_.give_up_seconds : rules_.switch_seconds)) {
        shown_ = best;
        leads_for_ = 0.0;
    }
}

}  // namespace raks::audio
