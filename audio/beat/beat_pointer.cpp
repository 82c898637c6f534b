#include "audio/beat/beat_pointer.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <numeric>

#include "base/simd_clones.hpp"
#include "base/time.hpp"
#include "models/fast_exp.hpp"

namespace raks::audio {
namespace {

constexpr double kTemplateSigma = 0.022;  // seconds: how far onsets scatter around their place
constexpr double kOnHalf = 0.35;          // height of the template half way between beats
constexpr double kOnQuarter = 0.12;       // and at the quarters
// Neighbourhood of the best state that counts as the same hypothesis.
constexpr double kNearTempo = 0.06;  // ratio
constexpr double kNearPhase = 0.12;  // beats

// A network's mean probability of a beat over all hops, and the least one that counts.
constexpr float kMeanEvidence = 0.04F;
constexpr float kLeastEvidence = 1e-3F;

constexpr double kLeastTransition = 1e-10;  // smaller ones are 0: see the constructor

// Hops in a beat; of 1 BPM: hops in a minute.
double hops_of(double bpm) { return 60.0 * kHopsPerSecond / bpm; }

// Sum in eight strands: the compiler vectorizes it, and the order of additions, and so the result,
// is fixed.
float sum_of(const std::vector<float>& values) noexcept {
    std::array<float, 8> strands{};
    std::size_t i = 0;
    for (; i + strands.size() <= values.size(); i += strands.size()) {
        for (std::size_t lane = 0; lane < strands.size(); ++lane) {
            strands[lane] += values[i + lane];
        }
    }
    float total = 0.0F;
    for (; i < values.size(); ++i) {
        total += values[i];
    }
    for (const float strand : strands) {
        total += strand;
    }
    return total;
}

// Index of the greatest value, the first of equals. In strands as above: 4 us a hop faster than
// std::max_element.
std::size_t greatest(const std::vector<float>& values) noexcept {
    std::array<float, 16> strands{};  // probabilities: none is negative
    std::size_t i = 0;
    for (; i + strands.size() <= values.size(); i += strands.size()) {
        for (std::size_t lane = 0; lane < strands.size(); ++lane) {
            strands[lane] = std::max(strands[lane], values[i + lane]);
        }
    }
    float most = *std::max_element(strands.begin(), strands.end());
    for (; i < values.size(); ++i) {
        most = std::max(most, values[i]);
    }
    return static_cast<std::size_t>(std::find(values.begin(), values.end(), most) - values.begin());
}

// 1 at an event, falling off over the hops around it: as wide as the network's evidence of one.
float bump(double hops_away) {
    constexpr double kSigma = 1.5;  // hops
    const double distance = hops_away / kSigma;
    return static_cast<float>(std::exp(-0.5 * distance * distance));
}

// Template of the onset strength over one beat of this length: bumps at the beat (at both ends),
// the half and the quarters; zero mean, so that steady onset strength favours no tempo.
std::vector<float> beat_template(int hops) {
    const double period = hops / kHopsPerSecond;
    const double places[][2] = {{0.0, 1.0},
                                {period, 1.0},
                                {period / 2, kOnHalf},
                                {period / 4, kOnQuarter},
                                {3 * period / 4, kOnQuarter}};
    std::vector<double> values(static_cast<std::size_t>(hops));
    for (std::size_t i = 0; i < values.size(); ++i) {
        const double at = static_cast<double>(i) / kHopsPerSecond;
        for (const auto& [place, height] : places) {
            const double distance = (at - place) / kTemplateSigma;
            values[i] = std::max(values[i], height * std::exp(-0.5 * distance * distance));
        }
    }
    const double mean = std::accumulate(values.begin(), values.end(), 0.0) / hops;
    std::vector<float> result;
    result.reserve(values.size());
    for (const double value : values) {
        result.push_back(static_cast<float>(value - mean));
    }
    return result;
}

// One pass over all states: leak to the prior, times the likelihood of the onset strength.
RAKS_SIMD_CLONES void weigh_flux(float* __restrict states,
                                 const float* prior,
                                 const float* shape,
                                 std::size_t count,
                                 float leak,
                                 float strength) noexcept {
    for (std::size_t i = 0; i < count; ++i) {
        states[i] =
            ((1.0F - leak) * states[i] + leak * prior[i]) * models::fast_exp(shape[i] * strength);
    }
}

// Times the likelihood of the network's evidence: one number for beats, one for halves and one for
// all other places, blended by how near a state is to each.
RAKS_SIMD_CLONES void weigh_evidence(float* __restrict states,
                                     const float* on_beat,
                                     const float* on_half,
                                     std::size_t count,
                                     float other,
                                     float beat,
                                     float half) noexcept {
    for (std::size_t i = 0; i < count; ++i) {
        states[i] *= other + beat * on_beat[i] + half * on_half[i];
    }
}

}  // namespace

BeatPointer::BeatPointer(const BeatPointerConfig& config) : config_(config) {
    const double shortest = hops_of(config.highest_bpm);
    const double longest = hops_of(config.lowest_bpm);
    // Tempi in log spacing, each a whole number of hops; equal neighbours at the fast end are one.
    for (int i = 0; i < config.tempi; ++i) {
        const double share = static_cast<double>(i) / (config.tempi - 1);
        const int hops =
            static_cast<int>(std::lround(shortest * std::pow(longest / shortest, share)));
        if (tempi_.empty() || hops != tempi_.back().hops) {
            tempi_.push_back({static_cast<int>(prior_.size()), hops});
            // Log-normal tempo prior, spread evenly over the states of each tempo.
            const double octaves =
                std::log2(hops_of(1.0) / hops / config.centre_bpm) / config.octaves;
            const float prior = static_cast<float>(std::exp(-0.5 * octaves * octaves) / hops);
            prior_.insert(prior_.end(), static_cast<std::size_t>(hops), prior);
            for (const float value : beat_template(hops)) {
                template_.push_back(value);
            }
            for (int at = 0; at < hops; ++at) {
                on_beat_.push_back(bump(std::min(at, hops - at)));
                on_half_.push_back(bump(at - 0.5 * hops));
            }
        }
    }
    const float total = std::accumulate(prior_.begin(), prior_.end(), 0.0F);
    for (float& value : prior_) {
        value /= total;
    }
    // Transitions at a beat, each row normalized.
    for (const Tempo& from : tempi_) {
        std::vector<double> row;
        for (const Tempo& to : tempi_) {
            const double ratio = static_cast<double>(to.hops) / from.hops;
            const double weight = std::exp(-config.stiffness * std::abs(ratio - 1.0));
            // Another octave is reached by the leak alone. A tiny transition probability would grow
            // with the evidence, also where the user has ruled that tempo out.
            row.push_back(weight > kLeastTransition ? weight : 0.0);
        }
        const double sum = std::accumulate(row.begin(), row.end(), 0.0);
        for (const double value : row) {
            transition_.push_back(static_cast<float>(value / sum));
        }
    }
    default_prior_ = prior_;
    probability_ = prior_;
    moved_.resize(prior_.size());
    arrivals_.resize(tempi_.size());
    reset();
}

void BeatPointer::reset() noexcept RAKS_NONBLOCKING {
    expect_any_tempo();
    std::copy(prior_.begin(), prior_.end(), probability_.begin());
}

void BeatPointer::expect_any_tempo() noexcept RAKS_NONBLOCKING {
    std::copy(default_prior_.begin(), default_prior_.end(), prior_.begin());
}

// Tempo probabilities are kept, half mixed with the prior; the phase within a beat is unknown.
void BeatPointer::open_positions() noexcept RAKS_NONBLOCKING {
    for (const Tempo& tempo : tempi_) {
        const auto first = probability_.begin() + tempo.first;
        const float share =
            std::accumulate(first, first + tempo.hops, 0.0F) / static_cast<float>(tempo.hops);
        for (int i = 0; i < tempo.hops; ++i) {
            const std::size_t state = tempo.state(i);
            moved_[state] = 0.5F * (share + prior_[state]);
        }
    }
    normalize();
}

// Prediction: probability leaves the last state of each tempo and arrives at the first states of
// all; everything else moves on by one state.
void BeatPointer::move() noexcept {
    std::fill(arrivals_.begin(), arrivals_.end(), 0.0F);
    for (std::size_t from = 0; from < tempi_.size(); ++from) {
        const std::size_t last = tempi_[from].state(tempi_[from].hops - 1);
        const float leaving = probability_[last];
        const float* const row = &transition_[from * tempi_.size()];
        for (std::size_t to = 0; to < tempi_.size(); ++to) {
            arrivals_[to] += leaving * row[to];
        }
    }
    // One copy moves all tempi, as their states follow each other; first states are set below.
    std::copy(probability_.begin(), probability_.end() - 1, moved_.begin() + 1);
    for (std::size_t i = 0; i < tempi_.size(); ++i) {
        // A tempo that is ruled out (prior 0) must not be reached by many small tempo changes
        // either.
        const std::size_t beat = tempi_[i].state(0);
        moved_[beat] = prior_[beat] > 0.0F ? arrivals_[i] : 0.0F;
    }
}

// moved_ becomes the posterior.
void BeatPointer::normalize() noexcept {
    const float scale = 1.0F / sum_of(moved_);
    for (std::size_t i = 0; i < moved_.size(); ++i) {
        probability_[i] = moved_[i] * scale;
    }
}

void BeatPointer::move_and_weigh(float flux) noexcept {
    move();
    weigh_flux(moved_.data(),
               prior_.data(),
               template_.data(),
               moved_.size(),
               static_cast<float>(config_.leak),
               flux);
}

void BeatPointer::advance(float onset_strength) noexcept RAKS_NONBLOCKING {
    move_and_weigh(static_cast<float>(config_.trust) * onset_strength);
    normalize();
}

void BeatPointer::advance(float onset_strength,
                          const BeatEvidence& evidence) noexcept RAKS_NONBLOCKING {
    move_and_weigh(static_cast<float>(config_.trust_beside) * onset_strength);
    // Likelihoods of a beat, a half and neither: probability over mean probability, to the power
    // of the trust, as neighbouring hops are not independent.
    const auto trust = static_cast<float>(config_.network_trust);
    const float neither = std::max(0.02F, 1.0F - evidence.beat - evidence.half);
    const float other = std::pow(neither / (1.0F - 2.0F * kMeanEvidence), trust);
    const auto above_other = [other, trust](float probability) {
        return std::pow(std::max(probability, kLeastEvidence) / kMeanEvidence, trust) - other;
    };
    weigh_evidence(moved_.data(),
                   on_beat_.data(),
                   on_half_.data(),
                   moved_.size(),
                   other,
                   above_other(evidence.beat),
                   above_other(evidence.half));
    normalize();
}

void BeatPointer::advance_blind() noexcept RAKS_NONBLOCKING {
    move();
    normalize();
}

// Weighted means over the states near the best one: finer than a state, and stable where
// probability is shared by neighbours.
PointerEstimate BeatPointer::estimate() const noexcept RAKS_NONBLOCKING {
    const auto best = static_cast<int>(greatest(probability_));
    const auto at =
        std::upper_bound(tempi_.begin(),
                         tempi_.end(),
                         best,
                         [](int state, const Tempo& tempo) { return state < tempo.first; }) -
        1;
    const double best_hops = at->hops;
    const double best_phase = (best - at->first) / best_hops;
    double mass = 0.0;
    double period = 0.0;
    double offset = 0.0;  // of the phase, from the best state's
    for (const Tempo& tempo : tempi_) {
        if (std::abs(tempo.hops / best_hops - 1.0) > kNearTempo) {
            continue;
        }
        // The same phase in another tempo's states.
        const int centre = static_cast<int>(std::lround(best_phase * tempo.hops));
        const int reach = static_cast<int>(kNearPhase * tempo.hops) + 1;
        for (int step = -reach; step <= reach; ++step) {
            const int position = ((centre + step) % tempo.hops + tempo.hops) % tempo.hops;
            const double p = static_cast<double>(probability_[tempo.state(position)]);
            double distance = position / static_cast<double>(tempo.hops) - best_phase;
            distance -= std::round(distance);  // phases are circular
            mass += p;
            period += p * tempo.hops;
            offset += p * distance;
        }
    }
    PointerEstimate estimate;
    estimate.period_hops = period / mass;
    estimate.phase = best_phase + offset / mass;
    estimate.phase -= std::floor(estimate.phase);
    estimate.mass = static_cast<float>(std::min(1.0, mass));
    return estimate;
}

void BeatPointer::expect_tempo(double bpm) noexcept RAKS_NONBLOCKING {
    for (const Tempo& tempo : tempi_) {
        constexpr double kReach = 0.3;  // in the logarithm: music may slow down, not halve
        constexpr double kLeast = 1e-6;
        const double ratio = hops_of(bpm) / tempo.hops;
        const double distance = (ratio - 1.0) / 0.03;
        // Other tempi get exactly 0: the smallest rest would grow again.
        const float weight =
            std::abs(std::log(ratio)) < kReach
                ? static_cast<float>(std::max(kLeast, std::exp(-0.5 * distance * distance)))
                : 0.0F;
        for (int i = 0; i < tempo.hops; ++i) {
            moved_[tempo.state(i)] = weight / static_cast<float>(tempo.hops);
        }
    }
    normalize();
    std::copy(probability_.begin(), probability_.end(), prior_.begin());
}

void BeatPointer::believe(double bpm, double phase) noexcept RAKS_NONBLOCKING {
    constexpr double kTempoSigma = 0.02;
    constexpr double kPhaseSigma = 0.05;  // beats
    for (const Tempo& tempo : tempi_) {
        const double tempo_off = (hops_of(bpm) / tempo.hops - 1.0) / kTempoSigma;
        const double weight = std::exp(-0.5 * tempo_off * tempo_off) / tempo.hops;
        for (int i = 0; i < tempo.hops; ++i) {
            double off = i / static_cast<double>(tempo.hops) - phase;
            off = (off - std::round(off)) / kPhaseSigma;
            const std::size_t state = tempo.state(i);
            // A tempo that is ruled out stays so: the smallest rest would grow again.
            moved_[state] = prior_[state] > 0.0F
                                ? static_cast<float>(weight * std::exp(-0.5 * off * off) + 1e-12)
                                : 0.0F;
        }
    }
    normalize();
}

// Zero in the prior keeps faster tempi from arriving at their beats, see move().
void BeatPointer::expect_below(double bpm) noexcept RAKS_NONBLOCKING {
    for (const Tempo& tempo : tempi_) {
        const bool is_open = tempo.hops > hops_of(bpm);
        for (int i = 0; i < tempo.hops; ++i) {
            const std::size_t state = tempo.state(i);
            prior_[state] = is_open ? default_prior_[state] : 0.0F;
        }
    }
}

void BeatPointer::expect_range(double lowest_bpm, double highest_bpm) noexcept RAKS_NONBLOCKING {
    constexpr float kOutside = 0.25F;
    float total = 0.0F;
    for (const Tempo& tempo : tempi_) {
        const double bpm = hops_of(1.0) / tempo.hops;
        const float weight = bpm < lowest_bpm || bpm > highest_bpm ? kOutside : 1.0F;
        for (int i = 0; i < tempo.hops; ++i) {
            prior_[tempo.state(i)] = weight * default_prior_[tempo.state(i)];
            total += prior_[tempo.state(i)];
        }
    }
    for (float& value : prior_) {
        value /= total;
    }
}

void BeatPointer::expect_beat() noexcept RAKS_NONBLOCKING {
    constexpr double kPhaseSigma = 0.06;  // beats
    for (const Tempo& tempo : tempi_) {
        for (int i = 0; i < tempo.hops; ++i) {
            const std::size_t state = tempo.state(i);
            double phase = i / static_cast<double>(tempo.hops);
            phase = (phase - std::round(phase)) / kPhaseSigma;
            moved_[state] =
                prior_[state] * static_cast<float>(std::exp(-0.5 * phase * phase) + 1e-4);
        }
    }
    normalize();
}

}  // namespace raks::audio
