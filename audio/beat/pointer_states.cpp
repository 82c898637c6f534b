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
constexpr double kOnThird = 0.35;         // and at the thirds of beats of three parts

// A network's mean probability of a beat over all hops, and the least one that counts.
constexpr float kMeanEvidence = 0.04F;
constexpr float kLeastEvidence = 1e-3F;

constexpr double kLeastTransition = 1e-10;  // smaller ones are 0: see add_transitions()

// Of a tempo that is easily taken for the told one: what it loses where a tempo is sought, and at
// each of its beats, as factors.
constexpr float kMistakenAtFirst = 0.05F;
constexpr float kMistakenAtBeat = 0.12F;

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

// A place in the beat where onsets are expected, and how strong they are against the beat's.
struct TemplatePlace {
    double phase = 0.0;
    double height = 0.0;
};
using TemplatePlaces = std::array<TemplatePlace, 5>;
// The beat stands at both ends. Places of height 0 change nothing.
constexpr TemplatePlaces kInTwo = {
    {{0.0, 1.0}, {1.0, 1.0}, {0.5, kOnHalf}, {0.25, kOnQuarter}, {0.75, kOnQuarter}}};
constexpr TemplatePlaces kInThree = {
    {{0.0, 1.0}, {1.0, 1.0}, {1.0 / 3.0, kOnThird}, {2.0 / 3.0, kOnThird}, {0.5, 0.0}}};

// Template of the onset strength over one beat of this length: bumps at the beat and at its parts;
// zero mean, so that steady onset strength favours no tempo.
std::vector<float> beat_template(int hops, const TemplatePlaces& places) {
    const double period = hops / kHopsPerSecond;
    std::vector<double> values(static_cast<std::size_t>(hops));
    for (std::size_t i = 0; i < values.size(); ++i) {
        const double at = static_cast<double>(i) / kHopsPerSecond;
        for (const auto& [phase, height] : places) {
            const double distance = (at - phase * period) / kTemplateSigma;
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

// Times the likelihood of the networks' evidence: one number for beats, one for their parts and one
// for all other places, blended by how near a state is to each.
RAKS_SIMD_CLONES void weigh_evidence(float* __restrict states,
                                     const float* on_beat,
                                     const float* on_part,
                                     std::size_t count,
                                     float other,
                                     float beat,
                                     float part) noexcept {
    for (std::size_t i = 0; i < count; ++i) {
        states[i] *= other + beat * on_beat[i] + part * on_part[i];
    }
}

}  // namespace

float event_bump(double hops_away) noexcept {
    constexpr double kSigma = 1.5;  // hops
    const double distance = hops_away / kSigma;
    return static_cast<float>(std::exp(-0.5 * distance * distance));
}

EvidenceLikelihood likelihood_of(const BeatEvidence& evidence, double trust) {
    const auto exponent = static_cast<float>(trust);
    const float neither = std::max(0.02F, 1.0F - evidence.beat - evidence.half - evidence.third);
    const auto likelihood = [exponent](float probability) {
        return std::pow(std::max(probability, kLeastEvidence) / kMeanEvidence, exponent);
    };
    return {std::pow(neither / (1.0F - 2.0F * kMeanEvidence), exponent),
            likelihood(evidence.beat),
            likelihood(evidence.half),
            likelihood(evidence.third)};
}

PointerStates::PointerStates(const BeatPointerConfig& config) : config_(config) {
    const double shortest = hops_of(config.highest_bpm);
    const double longest = hops_of(config.lowest_bpm);
    // Tempi in log spacing, each a whole number of hops; equal neighbours at the fast end are one.
    for (const int parts : {2, 3}) {
        first_in_three_ = prior_.size();
        int last = 0;
        for (int i = 0; i < config.tempi; ++i) {
            const double share = static_cast<double>(i) / (config.tempi - 1);
            const int hops =
                static_cast<int>(std::lround(shortest * std::pow(longest / shortest, share)));
            if (hops != last) {
                add_tempo(hops, parts);
            }
            last = hops;
        }
    }
    for (const Tempo& from : tempi_) {
        add_transitions(from);
    }
    transition_ = untold_transition_;
    expect_told(config.told_bpm);
}

// Log-normal tempo prior, spread evenly over the states of each tempo.
void PointerStates::expect_told(double bpm) noexcept RAKS_NONBLOCKING {
    config_.told_bpm = bpm;
    for (std::size_t i = 0; i < tempi_.size(); ++i) {
        const Tempo& tempo = tempi_[i];
        const double tempo_bpm = hops_of(1.0) / tempo.hops;
        const double octaves = std::log2(tempo_bpm / config_.centre_bpm) / config_.octaves;
        const bool is_wrong = is_mistaken(tempo_bpm, bpm);
        const float prior =
            static_cast<float>(std::exp(-0.5 * octaves * octaves) / tempo.hops) *
            static_cast<float>(tempo.parts == 3 ? config_.in_three : 1.0 - config_.in_three) *
            (is_wrong ? kMistakenAtFirst : 1.0F);
        std::fill_n(prior_.begin() + tempo.first, tempo.hops, prior);
        const auto row = static_cast<std::ptrdiff_t>(i * tempi_.size());
        const auto untold = untold_transition_.begin() + row;
        std::transform(
            untold,
            untold + static_cast<std::ptrdiff_t>(tempi_.size()),
            transition_.begin() + row,
            [is_wrong](float value) { return value * (is_wrong ? kMistakenAtBeat : 1.0F); });
    }
    const float total = std::accumulate(prior_.begin(), prior_.end(), 0.0F);
    for (float& value : prior_) {
        value /= total;
    }
}

void PointerStates::add_tempo(int hops, int parts) {
    tempi_.push_back({static_cast<int>(prior_.size()), hops, parts});
    prior_.insert(prior_.end(), static_cast<std::size_t>(hops), 0.0F);
    for (const float value : beat_template(hops, parts == 3 ? kInThree : kInTwo)) {
        template_.push_back(value);
    }
    for (int at = 0; at < hops; ++at) {
        on_beat_.push_back(event_bump(std::min(at, hops - at)));
        on_part_.push_back(
            parts == 3 ? std::max(event_bump(at - hops / 3.0), event_bump(at - 2.0 * hops / 3.0))
                       : event_bump(at - 0.5 * hops));
    }
}

// Transitions at a beat of one tempo, normalized.
void PointerStates::add_transitions(const Tempo& from) {
    std::vector<double> row;
    for (const Tempo& to : tempi_) {
        const double ratio = static_cast<double>(to.hops) / from.hops;
        const double weight = std::exp(-config_.stiffness * std::abs(ratio - 1.0)) *
                              (to.parts == from.parts ? 1.0 : config_.parts_change);
        // Another octave is reached by the leak alone. A tiny transition probability would grow
        // with the evidence, also where the user has ruled that tempo out.
        row.push_back(weight > kLeastTransition ? weight : 0.0);
    }
    const double sum = std::accumulate(row.begin(), row.end(), 0.0);
    for (const double value : row) {
        untold_transition_.push_back(static_cast<float>(value / sum));
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
    const EvidenceLikelihood likelihood = likelihood_of(evidence, config_.network_trust);
    const auto weigh_from = [&](std::size_t first, std::size_t end, float part) {
        weigh_evidence(states.data() + first,
                       on_beat_.data() + first,
                       on_part_.data() + first,
                       end - first,
                       likelihood.other,
                       likelihood.beat - likelihood.other,
                       part - likelihood.other);
    };
    weigh_from(0, first_in_three_, likelihood.half);
    weigh_from(first_in_three_, states.size(), likelihood.third);
}

}  // namespace raks::audio
