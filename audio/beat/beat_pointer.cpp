#include "audio/beat/beat_pointer.hpp"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <span>

#include "base/simd_lanes.hpp"
#include "models/dense_product.hpp"

namespace raks::audio {
namespace {

// Neighbourhood of the best state that counts as the same hypothesis.
constexpr double kNearTempo = 0.06;  // ratio
constexpr double kNearPhase = 0.12;  // beats

// Sum in eight strands: the order of additions, and so the result, is fixed.
RAKS_SIMD_CLONES float sum_of(const float* values, std::size_t count) noexcept {
    Lanes lanes{};
    std::size_t i = 0;
    for (; i + kLanes <= count; i += kLanes) {
        lanes += lanes_at(values + i);
    }
    float total = 0.0F;
    for (; i < count; ++i) {
        total += values[i];
    }
    for (std::size_t lane = 0; lane < kLanes; ++lane) {
        total += lanes[lane];
    }
    return total;
}

RAKS_SIMD_CLONES void scale_values(const float* values,
                                   std::size_t count,
                                   float scale,
                                   float* __restrict scaled) noexcept {
    for (std::size_t i = 0; i < count; ++i) {
        scaled[i] = values[i] * scale;
    }
}

// Index of the greatest value, the first of equals; none is negative.
RAKS_SIMD_CLONES std::size_t greatest(const float* values, std::size_t count) noexcept {
    constexpr std::size_t kBlock = 128;
    // The first block that holds the greatest, then the place in it.
    float most = -1.0F;
    std::size_t block = 0;
    for (std::size_t first = 0; first < count; first += kBlock) {
        const std::size_t end = std::min(first + kBlock, count);
        Lanes lanes{};
        std::size_t i = first;
        for (; i + kLanes <= end; i += kLanes) {
            const Lanes next = lanes_at(values + i);
            lanes = lanes < next ? next : lanes;
        }
        float here = 0.0F;
        for (std::size_t lane = 0; lane < kLanes; ++lane) {
            here = std::max(here, lanes[lane]);
        }
        for (; i < end; ++i) {
            here = std::max(here, values[i]);
        }
        if (here > most) {
            most = here;
            block = first;
        }
    }
    return static_cast<std::size_t>(std::find(values + block, values + count, most) - values);
}

}  // namespace

BeatPointer::BeatPointer(const BeatPointerConfig& config)
    : states_(config),
      prior_(states_.size()),
      probability_(states_.size()),
      moved_(states_.size()),
      leavings_(states_.tempi().size()),
      arrivals_(states_.tempi().size()) {
    reset();
}

void BeatPointer::reset() noexcept RAKS_NONBLOCKING {
    expect_any_tempo();
    std::copy(prior_.begin(), prior_.end(), probability_.begin());
}

void BeatPointer::expect_any_tempo() noexcept RAKS_NONBLOCKING {
    const std::span<const float> prior = states_.prior();
    std::copy(prior.begin(), prior.end(), prior_.begin());
}

// Tempo probabilities are kept, half mixed with the prior; the phase within a beat is unknown.
void BeatPointer::open_positions() noexcept RAKS_NONBLOCKING {
    for (const PointerStates::Tempo& tempo : states_.tempi()) {
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
    const std::span<const PointerStates::Tempo> tempi = states_.tempi();
    std::fill(arrivals_.begin(), arrivals_.end(), 0.0F);
    std::transform(
        tempi.begin(), tempi.end(), leavings_.begin(), [this](const PointerStates::Tempo& tempo) {
            return probability_[tempo.state(tempo.hops - 1)];
        });
    models::add_product(leavings_.data(),
                        tempi.size(),
                        states_.transitions().data(),
                        tempi.size(),
                        arrivals_.data());
    // Tempo by tempo: glibc makes one long copy byte by byte.
    for (std::size_t i = 0; i < tempi.size(); ++i) {
        const std::size_t beat = tempi[i].state(0);
        std::copy_n(&probability_[beat], tempi[i].hops - 1, &moved_[beat + 1]);
        // A tempo that is ruled out (prior 0) must not be reached by many small tempo changes
        // either.
        moved_[beat] = prior_[beat] > 0.0F ? arrivals_[i] : 0.0F;
    }
}

// moved_ becomes the posterior.
void BeatPointer::normalize() noexcept {
    const float scale = 1.0F / sum_of(moved_.data(), moved_.size());
    scale_values(moved_.data(), moved_.size(), scale, probability_.data());
}

void BeatPointer::advance(float onset_strength) noexcept RAKS_NONBLOCKING {
    move();
    states_.weigh(moved_, prior_, states_.leak(), onset_strength);
    normalize();
}

void BeatPointer::advance(float onset_strength,
                          const BeatEvidence& evidence) noexcept RAKS_NONBLOCKING {
    move();
    states_.weigh(moved_, prior_, states_.leak(), onset_strength, evidence);
    normalize();
}

void BeatPointer::advance_blind() noexcept RAKS_NONBLOCKING {
    move();
    normalize();
}

// Weighted means over the states near the best one: finer than a state, and stable where
// probability is shared by neighbours.
PointerEstimate BeatPointer::estimate() const noexcept RAKS_NONBLOCKING {
    const auto best = static_cast<int>(greatest(probability_.data(), probability_.size()));
    const auto at = std::upper_bound(states_.tempi().begin(),
                                     states_.tempi().end(),
                                     best,
                                     [](int state, const PointerStates::Tempo& tempo) {
                                         return state < tempo.first;
                                     }) -
                    1;
    const double best_hops = at->hops;
    const double best_phase = (best - at->first) / best_hops;
    double mass = 0.0;
    double period = 0.0;
    double offset = 0.0;  // of the phase, from the best state's
    for (const PointerStates::Tempo& tempo : states_.tempi()) {
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
    for (const PointerStates::Tempo& tempo : states_.tempi()) {
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
    for (const PointerStates::Tempo& tempo : states_.tempi()) {
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
    for (const PointerStates::Tempo& tempo : states_.tempi()) {
        const bool is_open = tempo.hops > hops_of(bpm);
        for (int i = 0; i < tempo.hops; ++i) {
            const std::size_t state = tempo.state(i);
            prior_[state] = is_open ? states_.prior()[state] : 0.0F;
        }
    }
}

void BeatPointer::expect_range(double lowest_bpm, double highest_bpm) noexcept RAKS_NONBLOCKING {
    constexpr float kOutside = 0.25F;
    float total = 0.0F;
    for (const PointerStates::Tempo& tempo : states_.tempi()) {
        const double bpm = hops_of(1.0) / tempo.hops;
        const float weight = bpm < lowest_bpm || bpm > highest_bpm ? kOutside : 1.0F;
        for (int i = 0; i < tempo.hops; ++i) {
            prior_[tempo.state(i)] = weight * states_.prior()[tempo.state(i)];
            total += prior_[tempo.state(i)];
        }
    }
    for (float& value : prior_) {
        value /= total;
    }
}

void BeatPointer::expect_beat() noexcept RAKS_NONBLOCKING {
    constexpr double kPhaseSigma = 0.06;  // beats
    for (const PointerStates::Tempo& tempo : states_.tempi()) {
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
