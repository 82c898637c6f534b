#include "training/figures/trajectory_statistics.hpp"

#include <algorithm>
#include <array>
#include <vector>

namespace raks::motion {
namespace {

/// Least variance of a state, as a share of the feature's variance over the whole figure; never
/// below kSmallestVariance (squared units of the feature). With few repeats a state's variance may
/// be almost zero by chance, and the trajectory would then be forced through its mean.
constexpr double kVarianceShare = 1e-3;
constexpr double kSmallestVariance = 1e-10;

using Windows = std::array<double, 3>;

/// Value, delta and delta-delta of feature `d` at sample `i`; windows as defined at FigureState.
Windows windows_at(const FeatureTrack& track, std::size_t i, std::size_t d) noexcept {
    const double before = track.row(i)[d];  // rows start at sample -1
    const double here = track.row(i + 1)[d];
    const double after = track.row(i + 2)[d];
    return {here, (after - before) / 2.0, after - 2.0 * here + before};
}

/// Weighted mean and variance of each window. Values are taken relative to an origin, so that a
/// large offset does not cancel the variance.
struct Moments {
    double weight = 0.0;
    Windows sum{};
    Windows square{};

    void add(const Windows& values, const Windows& origin, double w) noexcept {
        weight += w;
        for (std::size_t i = 0; i < values.size(); ++i) {
            const double x = values[i] - origin[i];
            sum[i] += w * x;
            square[i] += w * x * x;
        }
    }
    [[nodiscard]] double mean(std::size_t i) const noexcept { return sum[i] / weight; }
    [[nodiscard]] double variance(std::size_t i) const noexcept {
        return std::max(square[i] / weight - mean(i) * mean(i), 0.0);
    }
};

/// Moments of feature `d` over samples [first, end) of all repeats, about `origin`.
Moments moments_of(std::span<const FeatureTrack> tracks,
                   std::span<const double> weights,
                   std::size_t first,
                   std::size_t end,
                   std::size_t d,
                   const Windows& origin) {
    Moments moments;
    for (std::size_t r = 0; r < tracks.size(); ++r) {
        for (std::size_t i = first; i < end; ++i) {
            moments.add(windows_at(tracks[r], i, d), origin, weights[r]);
        }
    }
    return moments;
}

/// First sample of state k; the inverse of PartModel::state_at. For k = N it is T.
std::size_t first_sample(std::size_t state, std::size_t states, std::size_t samples) noexcept {
    return (state * samples + states - 1) / states;
}

// `mean` is set by take_hmm and keeps its size.
void resize(FigureState& state, std::size_t d) {
    for (std::vector<double>* list : {&state.variance,
                                      &state.delta_mean,
                                      &state.delta_variance,
                                      &state.delta_delta_mean,
                                      &state.delta_delta_variance}) {
        list->resize(d);
    }
}

// Variance of the feature within a repeat, averaged over the repeats: differences between the
// repeats' means do not count. The trajectory is scaled to it.
double global_variance(std::span<const FeatureTrack> tracks,
                       std::span<const double> weights,
                       std::size_t samples,
                       std::size_t d) {
    double sum = 0.0;
    double weight = 0.0;
    for (std::size_t r = 0; r < tracks.size(); ++r) {
        const Windows origin = windows_at(tracks[r], 0, d);
        const Moments one =
            moments_of(tracks.subspan(r, 1), weights.subspan(r, 1), 0, samples, d, origin);
        sum += weights[r] * one.variance(0);
        weight += weights[r];
    }
    return std::max(sum / weight, kSmallestVariance);
}

}  // namespace

void learn_trajectory(std::span<const FeatureTrack> tracks,
                      std::span<const double> weights,
                      std::size_t samples,
                      PartModel& part) {
    const std::size_t states = part.states.size();
    part.global_variance.resize(part.dimension());
    for (FigureState& state : part.states) {
        resize(state, part.dimension());
    }
    for (std::size_t d = 0; d < part.dimension(); ++d) {
        part.global_variance[d] = global_variance(tracks, weights, samples, d);
        // Any sample will do as origin; it only has to be near the values.
        const Windows origin = windows_at(tracks[0], 0, d);
        // Over all states: the reference for the floor.
        const Moments whole = moments_of(tracks, weights, 0, samples, d, origin);
        const auto floored = [&](const Moments& moments, std::size_t window) {
            return std::max({moments.variance(window),
                             kVarianceShare * whole.variance(window),
                             kSmallestVariance});
        };
        for (std::size_t k = 0; k < states; ++k) {
            const Moments slice = moments_of(tracks,
                                             weights,
                                             first_sample(k, states, samples),
                                             first_sample(k + 1, states, samples),
                                             d,
                                             origin);
            FigureState& state = part.states[k];
            state.variance[d] = floored(slice, 0);
            // The value's own mean stays that of the HMM; only deltas get theirs here.
            state.delta_mean[d] = origin[1] + slice.mean(1);
            state.delta_variance[d] = floored(slice, 1);
            state.delta_delta_mean[d] = origin[2] + slice.mean(2);
            state.delta_delta_variance[d] = floored(slice, 2);
        }
    }
}

}  // namespace raks::motion
