#include "audio/genre/song_judgement.hpp"

#include <algorithm>
#include <cmath>

#include "audio/genre/pattern_network.hpp"

namespace raks::audio {
namespace {

// A single moment says no more than this: ln of a probability.
constexpr float kLeast = -8.0F;
// A moment speaks by so many nats for another class at most; another song is told by so many nats
// times seconds: in two seconds where all speaks for it.
constexpr float kMostOfMoment = 4.0F;
constexpr double kAnother = 8.0;

}  // namespace

void SongJudgement::Sum::add(const Values& logs, double own) noexcept {
    for (std::size_t c = 0; c < sum.size(); ++c) {
        sum[c] += static_cast<float>(own) * std::max(kLeast, logs[c]);
    }
    weight += own;
}

void SongJudgement::Sum::add_to(float factor, Values& out, std::size_t classes) const noexcept {
    if (weight > 0.0) {
        for (std::size_t c = 0; c < classes; ++c) {
            out[c] += factor * sum[c] / static_cast<float>(weight);
        }
    }
}

void SongJudgement::reset() noexcept RAKS_NONBLOCKING {
    own_ = {};
    tags_ = {};
    others_ = {};
}

std::size_t SongJudgement::best_of(const Sum& own) const noexcept {
    const auto end = own.sum.begin() + static_cast<std::ptrdiff_t>(classes_);
    return static_cast<std::size_t>(std::max_element(own.sum.begin(), end) - own.sum.begin());
}

void SongJudgement::add(const Values& logs,
                        double sureness,
                        double seconds) noexcept RAKS_NONBLOCKING {
    const double weight = seconds * sureness;
    own_.add(logs, weight);
    if (songs_ == Songs::any) {
        watch_for_another(logs, weight, seconds);
    }
}

void SongJudgement::watch_for_another(const Values& logs, double weight, double seconds) noexcept {
    if (!(own_.weight > 0.0)) {
        return;
    }
    const std::size_t song = best_of(own_);
    for (std::size_t c = 0; c < classes_; ++c) {
        Other& other = others_[c];
        const float lead = std::max(kLeast, logs[c]) - std::max(kLeast, logs[song]);
        other.nats +=
            seconds * static_cast<double>(std::clamp(lead, -kMostOfMoment, kMostOfMoment));
        if (c == song || other.nats <= 0.0) {
            other = {};
            continue;
        }
        other.since.add(logs, weight);
        if (other.nats >= kAnother) {
            const Sum begun = other.since;
            reset();
            own_ = begun;
            return;
        }
    }
}

void SongJudgement::add(const TaggerWord& word,
                        const TaggerClasses& tagger) noexcept RAKS_NONBLOCKING {
    if (word.patches == 0 || (word.patches == patches_ && word.until == patch_.until)) {
        return;
    }
    patches_ = word.patches;
    patch_.until = word.until;
    ++patch_.number;
    tagger.log_chances(word.embedding, std::span(patch_.logs).first(classes_));
    add(patch_);
}

SongJudgement::Values SongJudgement::log_chances(
    Asked asked, int beats_per_bar, std::span<const int> bars) const noexcept RAKS_NONBLOCKING {
    Values logs{};
    if (!((asked == Asked::tagger ? tags_ : own_).weight > 0.0)) {
        logs.fill(2.0F * kLeast);
        logs[classes_ - 1] = 0.0F;
        return logs;
    }
    if (asked != Asked::tagger) {
        own_.add_to(asked == Asked::both ? kOwnWeight : 1.0F, logs, classes_);
    }
    if (asked != Asked::own_parts) {
        tags_.add_to(asked == Asked::both ? kTaggerWeight : 1.0F, logs, classes_);
    }
    for (std::size_t c = 0; c + 1 < classes_; ++c) {
        const bool is_of_three = bars[c] % 3 == 0;
        const bool has_three = beats_per_bar % 3 == 0;
        if (beats_per_bar > 0 && bars[c] > 0 && is_of_three != has_three) {
            logs[c] -= kOtherBar;
        }
    }
    normalize_logs(std::span(logs).first(classes_));
    return logs;
}

}  // namespace raks::audio
