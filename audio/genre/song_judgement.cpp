#include "audio/genre/song_judgement.hpp"

#include <algorithm>
#include <cmath>

#include "audio/genre/pattern_network.hpp"

namespace raks::audio {
namespace {

// A single moment says no more than this: ln of a probability.
constexpr float kLeast = -8.0F;
// What a bar that the dance does not have takes off, in nats.
constexpr float kOtherBar = 3.0F;
// Seconds for which the last seconds must speak for another class, and in nats how much more.
constexpr double kAnother = 12.0;
constexpr float kAnotherLead = 1.0F;

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
    lately_ = {};
    other_for_ = 0.0;
}

std::size_t SongJudgement::best_of(const Sum& own) const noexcept {
    const auto end = own.sum.begin() + static_cast<std::ptrdiff_t>(classes_);
    return static_cast<std::size_t>(std::max_element(own.sum.begin(), end) - own.sum.begin());
}

void SongJudgement::add(const Values& logs,
                        double sureness,
                        double seconds) noexcept RAKS_NONBLOCKING {
    const double weight = seconds * sureness;
    watch_for_another(logs, weight, seconds);
    own_.add(logs, weight);
}

// A song whose last seconds were all for another class than its mean is another song.
void SongJudgement::watch_for_another(const Values& logs, double weight, double seconds) noexcept {
    const std::size_t song = best_of(own_);
    const auto end = logs.begin() + static_cast<std::ptrdiff_t>(classes_);
    const auto now = static_cast<std::size_t>(std::max_element(logs.begin(), end) - logs.begin());
    if (now == song || logs[now] < logs[song] + kAnotherLead) {
        lately_ = {};
        other_for_ = 0.0;
        return;
    }
    if (now != other_) {
        lately_ = {};
        other_for_ = 0.0;
        other_ = now;
    }
    lately_.add(logs, weight);
    other_for_ += seconds;
    if (other_for_ >= kAnother) {
        const Sum begun = lately_;
        reset();
        own_ = begun;
    }
}

void SongJudgement::add(const TaggerWord& word,
                        const TaggerClasses& tagger) noexcept RAKS_NONBLOCKING {
    if (word.patches == 0 || (word.patches == patches_ && word.until == until_)) {
        return;
    }
    patches_ = word.patches;
    until_ = word.until;
    Values logs{};
    tagger.log_chances(word.embedding, std::span(logs).first(classes_));
    tags_.add(logs, 1.0);
}

SongJudgement::Values SongJudgement::log_chances(
    int beats_per_bar, std::span<const int> bars) const noexcept RAKS_NONBLOCKING {
    Values logs{};
    if (!(own_.weight > 0.0)) {
        logs.fill(2.0F * kLeast);
        logs[classes_ - 1] = 0.0F;
        return logs;
    }
    own_.add_to(kOwnWeight, logs, classes_);
    tags_.add_to(kTaggerWeight, logs, classes_);
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
