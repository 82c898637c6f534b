#include "audio/beat/bar_belief.hpp"

#include <algorithm>
#include <cmath>
#include <numeric>

namespace raks::audio {
namespace {

constexpr float kLevelShare = 0.1F;        // of a beat in the running level of each band
constexpr float kStatisticsShare = 0.06F;  // of a beat in mean and variance of the change
constexpr float kCompression = 4.0F;       // log(1 + 4 x magnitude / level)
constexpr float kQuietestLevel = 1e-9F;    // digital silence has no level
constexpr int kFirstBeats = 4;             // beats before the statistics are used
constexpr float kMost = 3.0F;              // standard deviations

}  // namespace

void BeatChange::reset() noexcept RAKS_NONBLOCKING {
    sum_ = level_ = before_ = {};
    hops_ = beats_ = 0;
    mean_ = variance_ = 0.0F;
}

// Sums; the mean is taken when the beat ends and its length is known.
void BeatChange::add(std::span<const float, OnsetDetector::kMelBands> magnitudes) noexcept
    RAKS_NONBLOCKING {
    for (std::size_t i = 0; i < sum_.size(); ++i) {
        sum_[i] += magnitudes[i];
    }
    ++hops_;
}

// Distance of the two beats' spectra: mean absolute difference over the bands.
float BeatChange::next_beat() noexcept RAKS_NONBLOCKING {
    if (hops_ == 0) {
        return 0.0F;
    }
    float change = 0.0F;
    for (std::size_t i = 0; i < sum_.size(); ++i) {
        const float mean = sum_[i] / static_cast<float>(hops_);
        level_[i] += (beats_ == 0 ? 1.0F : kLevelShare) * (mean - level_[i]);
        const float now = std::log1p(kCompression * mean / (level_[i] + kQuietestLevel));
        change += std::abs(now - before_[i]) / static_cast<float>(sum_.size());
        before_[i] = now;
    }
    sum_ = {};
    hops_ = 0;
    ++beats_;
    if (beats_ == 1) {
        return 0.0F;
    }
    // Plain mean and variance at first, exponential ones later (Welford's update).
    const float share = std::max(kStatisticsShare, 1.0F / static_cast<float>(beats_ - 1));
    // Against the statistics before this beat: it must not excuse itself.
    const float apart = change - mean_;
    const float deviation = std::sqrt(variance_) + kQuietestLevel;
    mean_ += share * apart;
    variance_ += share * (apart * (change - mean_) - variance_);
    return beats_ < kFirstBeats ? 0.0F : std::clamp(apart / deviation, -kMost, kMost);
}

namespace {

constexpr float kPriorDownbeat = 0.3F;  // share of downbeats among beats
constexpr float kTrust = 0.8F;          // exponent: a bar's beats are not independent evidence
constexpr float kLikeFirst = 0.5F;      // share of bar middles with the evidence of a downbeat
constexpr float kChangeTrust = 0.6F;    // ln likelihood for one standard deviation of change
// A network's probabilities are divided by how often each class occurs. The exponent is below 1, as
// a recurrent network's answers on successive beats depend on each other.
constexpr BarEvidence kUsual = {0.28F, 0.18F, 0.54F};
constexpr float kNetworkTrust = 0.6F;
constexpr float kLeastOfBar = 0.01F;  // lowest probability of the network that counts
// Four of five songs begin on the first beat of a bar: odds against each other place of a bar of 4.
constexpr float kStartsOnFirst = 12.0F;
constexpr float kStay = 1.3F;  // another place must be likelier by this factor to be published

}  // namespace

void BarBelief::reset() noexcept RAKS_NONBLOCKING {
    for (std::size_t metre = 0; metre < kMetres.size(); ++metre) {
        const int beats = kMetres[metre];
        probability_[metre].fill(0.0F);
        std::fill_n(probability_[metre].begin(),
                    beats,
                    BarModel::prior_of(beats) / static_cast<float>(beats));
    }
    number_ = origin_ = 0;
    has_beat_ = is_held_ = false;
    beats_per_bar_ = 4;
    confidence_ = 0.0F;
}

// Prediction: every position moves on by one beat; at a bar's end the metre may change.
void BarBelief::step() noexcept {
    std::array<float, kMetres.size()> arriving{};  // at a downbeat, by metre
    float total = 0.0F;
    for (std::size_t metre = 0; metre < kMetres.size(); ++metre) {
        arriving[metre] = probability_[metre][static_cast<std::size_t>(kMetres[metre] - 1)];
        total += arriving[metre];
    }
    for (std::size_t metre = 0; metre < kMetres.size(); ++metre) {
        const int beats = kMetres[metre];
        Positions& places = probability_[metre];
        for (std::size_t place = static_cast<std::size_t>(beats - 1); place > 0; --place) {
            places[place] = places[place - 1];
        }
        const float prior = BarModel::prior_of(beats);
        places[0] = (1.0F - BarModel::kMetreChange) * arriving[metre] +
                    BarModel::kMetreChange * total * prior;
        // The leak to the prior lets a wrong count be left.
        for (int place = 0; place < beats; ++place) {
            float& value = places[static_cast<std::size_t>(place)];
            value = (1.0F - BarModel::kLeak) * value +
                    BarModel::kLeak * prior / static_cast<float>(beats);
        }
    }
}

// A step for each beat that the number moves on, bounded in case the grid was set anew.
void BarBelief::next_beat(long number) noexcept RAKS_NONBLOCKING {
    constexpr long kMostSteps = 8;
    const long steps = has_beat_ ? std::clamp(number - number_, 0L, kMostSteps) : 1;
    for (long i = 0; i < steps; ++i) {
        step();
    }
    number_ = number;
    has_beat_ = true;
    tell();
}

// Ratio of posterior to prior probability, as a likelihood up to a factor.
BarLikelihood BarLikelihood::of_downbeat(float probability) noexcept {
    const float downbeat = std::clamp(probability, 0.02F, 0.98F);
    const float first = std::pow(downbeat / kPriorDownbeat, kTrust);
    const float other = std::pow((1.0F - downbeat) / (1.0F - kPriorDownbeat), kTrust);
    return {first, kLikeFirst * first + (1.0F - kLikeFirst) * other, other};
}

// Only first beats gain by a change: harmony and bass line change where bars begin.
BarLikelihood BarLikelihood::of_change(float deviations) noexcept {
    return {std::exp(kChangeTrust * deviations), 1.0F, 1.0F};
}

BarLikelihood BarLikelihood::of_bar(const BarEvidence& evidence) noexcept {
    const auto likelihood = [](float probability, float usual) {
        return std::pow(std::max(probability, kLeastOfBar) / usual, kNetworkTrust);
    };
    return {likelihood(evidence.first, kUsual.first),
            likelihood(evidence.middle, kUsual.middle),
            likelihood(evidence.other, kUsual.other)};
}

void BarBelief::observe_downbeat(float probability) noexcept RAKS_NONBLOCKING {
    weigh(BarLikelihood::of_downbeat(probability));
}

void BarBelief::observe_change(float deviations) noexcept RAKS_NONBLOCKING {
    weigh(BarLikelihood::of_change(deviations));
}

void BarBelief::observe_bar(const BarEvidence& evidence) noexcept RAKS_NONBLOCKING {
    weigh(BarLikelihood::of_bar(evidence));
}

// Multiplies in the likelihoods of the last beat's evidence, then normalizes.
void BarBelief::weigh(const BarLikelihood& likelihood) noexcept {
    for (std::size_t metre = 0; metre < kMetres.size(); ++metre) {
        for (int place = 0; place < kMetres[metre]; ++place) {
            probability_[metre][static_cast<std::size_t>(place)] *=
                likelihood.of(kMetres[metre], place);
        }
    }
    normalize();
}

void BarBelief::observe_start(long number) noexcept RAKS_NONBLOCKING {
    for (std::size_t metre = 0; metre < kMetres.size(); ++metre) {
        const long beats = kMetres[metre];
        const long place = ((number_ - number) % beats + beats) % beats;
        probability_[metre][static_cast<std::size_t>(place)] *= kStartsOnFirst;
    }
    normalize();
}

void BarBelief::normalize() noexcept {
    float total = 0.0F;
    for (const Positions& places : probability_) {
        total = std::accumulate(places.begin(), places.end(), total);
    }
    for (Positions& places : probability_) {
        for (float& value : places) {
            value /= total;
        }
    }
    tell();
}

// Chooses what is published: the most likely place, but another one than before only when it is
// likelier by kStay, so that the bars do not flicker.
void BarBelief::tell() noexcept {
    float best = 0.0F;
    float told = 0.0F;
    int best_beats = beats_per_bar_;
    long best_origin = origin_;
    for (std::size_t metre = 0; metre < kMetres.size(); ++metre) {
        for (long place = 0; place < kMetres[metre]; ++place) {
            const float value = probability_[metre][static_cast<std::size_t>(place)];
            // Whether this metre and position are the published ones.
            const bool is_told = kMetres[metre] == beats_per_bar_ &&
                                 (number_ - place - origin_) % beats_per_bar_ == 0;
            told = is_told ? value : told;
            if (value > best) {
                best = value;
                best_beats = kMetres[metre];
                best_origin = number_ - place;
            }
        }
    }
    if (is_held_) {
        confidence_ = 1.0F;
        return;
    }
    const bool changes = best > kStay * told;
    beats_per_bar_ = changes ? best_beats : beats_per_bar_;
    origin_ = changes ? best_origin : origin_;
    confidence_ = changes ? best : told;
}

// Numbers of other beats make the probabilities useless; metre and hold stay.
void BarBelief::recount(long origin) noexcept RAKS_NONBLOCKING {
    const bool was_held = is_held_;
    const int beats = beats_per_bar_;
    reset();
    beats_per_bar_ = beats;
    origin_ = origin;
    is_held_ = was_held;
}

void BarBelief::hold(long number) noexcept RAKS_NONBLOCKING {
    origin_ = number;
    is_held_ = true;
}

}  // namespace raks::audio
