#include "audio/evaluate/beat_faults.hpp"

#include <algorithm>
#include <array>
#include <cstddef>

namespace raks::audio {
namespace {

constexpr double kRight = 0.9;    // F-measure of beats that count as right
constexpr double kFollows = 0.8;  // F-measure of an estimate with the pulse that it follows

// Rate and offset of a pulse, see other_pulse().
struct Pulse {
    double rate = 1.0;
    double offset = 0.0;
};

template <std::size_t Count>
bool follows_any(BeatTimes reference, BeatTimes estimate, const std::array<Pulse, Count>& pulses) {
    return std::any_of(pulses.begin(), pulses.end(), [&](const Pulse& pulse) {
        const std::vector<double> other = other_pulse(reference, pulse.rate, pulse.offset);
        return f_measure(other, estimate) >= kFollows;
    });
}

/// The reference beat that each announced beat hits, or -1. Both ascend, and a beat is hit once.
std::vector<int> hits_of(BeatTimes reference, BeatTimes estimate) {
    std::vector<int> hits(estimate.size(), -1);
    std::size_t next = 0;
    for (std::size_t i = 0; i < estimate.size(); ++i) {
        while (next < reference.size() && reference[next] < estimate[i] - kHitTolerance) {
            ++next;
        }
        if (next < reference.size() && reference[next] <= estimate[i] + kHitTolerance) {
            hits[i] = static_cast<int>(next++);
        }
    }
    return hits;
}

}  // namespace

std::vector<double> other_pulse(BeatTimes reference, double rate, double offset) {
    std::vector<double> times;
    for (std::size_t i = 0;; ++i) {
        const double place = offset + static_cast<double>(i) / rate;
        const auto beat = static_cast<std::size_t>(place);
        if (beat + 1 >= reference.size()) {
            return times;
        }
        const double part = place - static_cast<double>(beat);
        times.push_back(reference[beat] + part * (reference[beat + 1] - reference[beat]));
    }
}

BeatFault fault_of(BeatTimes reference, BeatTimes estimate) {
    if (f_measure(reference, estimate) >= kRight) {
        return {};
    }
    constexpr double kThird = 1.0 / 3.0;
    constexpr std::array<Pulse, 3> kOctaves = {{{2.0, 0.0}, {0.5, 0.0}, {0.5, 1.0}}};
    constexpr std::array<Pulse, 7> kThreeTwo = {{{1.5, 0.0},
                                                 {1.5, kThird},
                                                 {2.0 / 3.0, 0.0},
                                                 {2.0 / 3.0, 0.5},
                                                 {2.0 / 3.0, 1.0},
                                                 {0.75, 0.0},
                                                 {0.75, 2.0 * kThird}}};
    constexpr std::array<Pulse, 1> kOff = {{{1.0, 0.5}}};
    constexpr std::array<Pulse, 2> kThirds = {{{1.0, kThird}, {1.0, 2.0 * kThird}}};
    return {follows_any(reference, estimate, kOctaves),
            follows_any(reference, estimate, kThreeTwo),
            follows_any(reference, estimate, kOff),
            follows_any(reference, estimate, kThirds)};
}

std::vector<Claim> beat_claims(BeatTimes reference,
                               BeatTimes estimate,
                               std::span<const float> confidences) {
    std::vector<Claim> claims;
    if (reference.empty()) {
        return claims;
    }
    const std::vector<int> hits = hits_of(reference, estimate);
    for (std::size_t i = 0; i < estimate.size(); ++i) {
        // Where nothing is annotated, nothing is known to be wrong.
        if (estimate[i] >= reference.front() - kHitTolerance &&
            estimate[i] <= reference.back() + kHitTolerance) {
            claims.push_back({confidences[i], hits[i] >= 0});
        }
    }
    return claims;
}

std::vector<Claim> bar_claims(BeatTimes reference,
                              std::span<const int> reference_positions,
                              BeatTimes estimate,
                              std::span<const int> positions,
                              std::span<const float> bar_confidences) {
    std::vector<Claim> claims;
    if (reference_positions.empty() || positions.empty()) {
        return claims;
    }
    const std::vector<int> hits = hits_of(reference, estimate);
    for (std::size_t i = 0; i < estimate.size(); ++i) {
        if (hits[i] >= 0) {
            const int right = reference_positions[static_cast<std::size_t>(hits[i])];
            claims.push_back({bar_confidences[i], positions[i] == right});
        }
    }
    return claims;
}

}  // namespace raks::audio
