#include "apps/reports/genre_track.hpp"

#include <cmath>

namespace raks::apps {
namespace {

// Seconds until a wrong dance counts, and until the decision is judged.
constexpr double kBegun = 5.0;
constexpr double kSettled = 10.0;

double share_of(int part, int whole) noexcept {
    return whole > 0 ? static_cast<double>(part) / whole : 0.0;
}

}  // namespace

std::vector<audio::Claim> shown_claims(const GenreTrack& track,
                                       GenreVoice voice,
                                       std::size_t truth) {
    const auto of = static_cast<std::size_t>(voice);
    const std::size_t none = track.genres.size();
    std::vector<audio::Claim> claims;
    for (const GenreStep& step : track.steps) {
        const std::size_t shown = step.shown[of];
        if (step.seconds >= kBegun && shown != none) {
            claims.push_back({std::exp(step.logs[of][shown]), shown == truth});
        }
    }
    return claims;
}

void ShownDanceTally::add(double seconds, std::size_t shown) noexcept {
    // The first decision is no switch, and neither is what follows "unknown".
    switches_ += shown != last_ && last_ != none_ ? 1 : 0;
    last_ = shown;
    seconds_ = seconds;
    // The first seconds have too little music for a decision.
    if (seconds >= kBegun) {
        ++danced_;
        wrong_ += shown != truth_ && shown != none_ ? 1 : 0;
    }
    if (seconds >= kSettled) {
        ++counted_;
        right_ += shown == truth_ ? 1 : 0;
    }
}

ShownDance ShownDanceTally::result() const noexcept {
    return {.seconds = seconds_,
            .switches = switches_,
            .right_share = share_of(right_, counted_),
            .at_end = last_,
            .wrong_share = share_of(wrong_, danced_)};
}

}  // namespace raks::apps
