#include "audio/beat/pointer_states.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <numeric>

#include "base/simd_clones.hpp"
#include "models/fast_exp.hpp"

namespace raks::audio {
namespace {

constexpr double kTemplateSigma = 0.022;  // seconds: how far onsets scatter around their place
constexpr double kOnHalf = 0.35;          // height of the template half way between beats
constexpr double kOnQuarter = 0.12;       // and at the quarters

// A network's mean probability of a beat over all hops, and the least one that counts.
constexpr float kMeanEvidence = 0.04F;
constexpr float kLeastEvidence = 1e-3F;

constexpr double kLeastTransition = 1e-10;  // smaller ones are 0: see add_transitions()

// Of a tempo that is easily taken for the told one: what it loses where a tempo is sought, and at
// each of its beats, as factors.
constexpr float kMistakenAtFirst = 0.05F;
constexpr float kMistakenAtBeat = 0.6F;

// Whether one tempo is easily taken for the other: an octave, two or a third of three, 3:2 or 4:3.
bool is_mistaken(double bpm, double told_bpm) {
    constexpr double kReach = 0.05;  // in the logarithm: tags are rounded, and players drift
    constexpr std::array kRatios = {2.0, 3.0, 1.5, 4.0 / 3.0};
    if (told_bpm <= 0.0) {
        return false;
    }
    const double away = std::abs(std::log(bpm / told_bpm));
    return std::any_of(kRatios.begin(), kRatios.end(), [away](double ratio) {
        return std::abs(away - std::log(ratio)) < kReach;
    });
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

PointerStates::PointerStates(const BeatPointerConfig& config) : config_(config) {
    const double shortest = hops_of(config.highest_bpm);
    const double longest = hops_of(config.lowest_bpm);
    // Tempi in log spacing, each a whole number of hops; equal neighbours at the fast end are one.
    for (int i = 0; i < config.tempi; ++i) {
        const double share = static_cast<double>(i) / (config.tempi - 1);
        const int hops =
            static_cast<int>(std::lround(shortest * std::pow(longest / shortest, share)));
        if (tempi_.empty() || hops != tempi_.back().hops) {
            add_tempo(hops);
        }
    }
    const float total = std::accumulate(prior_.begin(), prior_.end(), 0.0F);
    for (float& value : prior_) {
        value /= total;
    }
    for (const Tempo& from : tempi_) {
        add_transitions(from);
    }
}

// Log-normal tempo prior, spread evenly over the states of each tempo.
void PointerStates::add_tempo(int hops) {
    tempi_.push_back({static_cast<int>(prior_.size()), hops});
    const double octaves = std::log2(hops_of(1.0) / hops / config_.centre_bpm) / config_.octaves;
    const bool is_wrong = is_mistaken(hops_of(1.0) / hops, config_.told_bpm);
    const float prior = static_cast<float>(std::exp(-0.5 * octaves * octaves) / hops) *
                        (is_wrong ? kMistakenAtFirst : 1.0F);
    prior_.insert(prior_.end(), static_cast<std::size_t>(hops), prior);
    for (const float value : beat_template(hops)) {
        template_.push_back(value);
    }
    for (int at = 0; at < hops; ++at) {
        on_beat_.push_back(bump(std::min(at, hops - at)));
        on_half_.push_back(bump(at - 0.5 * hops));
    }
}

// Transitions at a beat of one tempo, normalized.
void PointerStates::add_transitions(const Tempo& from) {
    std::vector<double> row;
    for (const Tempo& to : tempi_) {
        const double ratio = static_cast<double>(to.hops) / from.hops;
        const double weight = std::exp(-config_.stiffness * std::abs(ratio - 1.0));
        // Another octave is reached by the leak alone. A tiny transition probability would grow
        // with the evidence, also where the user has ruled that tempo out.
        row.push_back(weight > kLeastTransition ? weight : 0.0);
    }
    const double sum = std::accumulate(row.begin(), row.end(), 0.0);
    const bool is_wrong = is_mistaken(hops_of(1.0) / from.hops, config_.told_bpm);
    for (const double value : row) {
        transition_.push_back(static_cast<float>(value / sum) *
                              (is_wrong ? kMistakenAtBeat : 1.0F));
    }
}

void PointerStates::weigh(std::span<float> states,
                          std::span<const float> prior,
                          float leak,
                          float onset_strength) const noexcept RAKS_NONBLOCKING {
    weigh_flux(states.data(),
               prior.data(),
               template_.data(),
               states.size(),
               leak,
               static_cast<float>(config_.trust) * onset_strength);
}

void PointerStates::weigh(std::span<float> states,
                          std::span<const float> prior,
                          float leak,
                          float onset_strength,
                          const BeatEvidence& evidence) const noexcept RAKS_NONBLOCKING {
    weigh_flux(states.data(),
               prior.data(),
               template_.data(),
               states.size(),
               leak,
               static_cast<float>(config_.trust_beside) * onset_strength);
    // Likelihoods of a beat, a half and neither: probability over mean probability, to the power
    // of the trust, as neighbouring hops are not independent.
    const auto trust = static_cast<float>(config_.network_trust);
    const float neither = std::max(0.02F, 1.0F - evidence.beat - evidence.half);
    const float other = std::pow(neither / (1.0F - 2.0F * kMeanEvidence), trust);
    const auto above_other = [other, trust](float probability) {
        return std::pow(std::max(probability, kLeastEvidence) / kMeanEvidence, trust) - other;
    };
    weigh_evidence(states.data(),
                   on_beat_.data(),
                   on_half_.data(),
                   states.size(),
                   other,
                   above_other(evidence.beat),
                   above_other(evidence.half));
}

}  // namespace raks::audio
