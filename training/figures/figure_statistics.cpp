#include "training/figures/figure_statistics.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>
#include <vector>

#include "base/statistics.hpp"
#include "motion/figures/clip_conditioning.hpp"
#include "motion/figures/foot_events.hpp"
#include "training/figures/repeat_features.hpp"

namespace raks::motion {
namespace {

// Offsets lie in [-0.4, 0.6): dancers land late rather than early.
constexpr double kEarliest = -0.4;  // beats from the count a landing belongs to

/// Per foot: contact by frame, landings (frames) and toe speed by frame (m/s) of one clip.
struct ClipFeet {
    std::array<std::vector<bool>, 2> contacts;
    std::array<std::vector<double>, 2> landings;
    std::array<std::vector<double>, 2> toe_speeds;
};

// Faults are bridged first: a jump in bad frames would look like a step.
ClipFeet feet_of(const TrainingClip& clip) {
    std::vector<std::array<SourceFoot, 2>> feet = clip.feet;
    bridge_faults(feet, clip.faults);
    ClipFeet result;
    for (const Side side : kSides) {
        const std::size_t s = static_cast<std::size_t>(side);
        result.contacts[s] = toe_contacts(feet, side, clip.frames_per_second);
        result.landings[s] = landings(feet, side, clip.frames_per_second);
        result.toe_speeds[s] =
            toe_speed(feet, side, clip.frames_per_second, FootRules{}.contact_low_pass_hz);
    }
    return result;
}

// Adds the repeat's weight to every phase bin in whose middle the toe rests on the floor.
void add_contacts(const std::vector<bool>& contacts,
                  const FigureRepeat& repeat,
                  const PhaseWarp& warp,
                  int beats,
                  std::vector<double>& sums) {
    for (std::size_t bin = 0; bin < sums.size(); ++bin) {
        const double phase =
            (static_cast<double>(bin) + 0.5) * beats / static_cast<double>(sums.size());
        const std::size_t frame = static_cast<std::size_t>(std::lround(warp.frame_at(phase)));
        sums[bin] += contacts[std::min(frame, contacts.size() - 1)] ? repeat.weight : 0.0;
    }
}

// Sorts landings by the count they belong to; offsets from that count in beats, late positive.
void add_landings(const std::vector<double>& moments,
                  const PhaseWarp& warp,
                  int beats,
                  std::vector<std::vector<double>>& offsets) {
    for (const double frame : moments) {
        const double beat = warp.beat_at(frame);
        const double count = std::floor(beat - kEarliest);
        if (count >= 0.0 && count < beats) {
            offsets[static_cast<std::size_t>(count)].push_back(beat - count);
        }
    }
}

/// The highest speed of the faster toe in each repeat, m/s; the median over the repeats, because
/// one badly captured repeat would dominate a maximum.
double peak_toe_speed(std::span<const TrainingClip> clips,
                      std::span<const FigureRepeat> repeats,
                      const std::vector<std::array<std::vector<double>, 2>>& speeds) {
    std::vector<double> peaks;
    for (const FigureRepeat& repeat : repeats) {
        double peak = 0.0;
        const std::size_t last = clips[repeat.clip].poses.size() - 1;
        const auto end = std::min(static_cast<std::size_t>(repeat.beat_frames.back()), last);
        for (auto i = static_cast<std::size_t>(repeat.beat_frames.front()); i <= end; ++i) {
            peak = std::max({peak, speeds[repeat.clip][0][i], speeds[repeat.clip][1][i]});
        }
        peaks.push_back(peak);
    }
    return upper_median(std::move(peaks));
}

// Median and sample standard deviation of the landings at one count.
LandingOffset summary_of(std::vector<double> offsets) {
    LandingOffset result;
    result.repeats = static_cast<int>(offsets.size());
    if (offsets.empty()) {
        return result;
    }
    std::sort(offsets.begin(), offsets.end());
    result.median = Beats(*median(offsets));
    double mean = 0.0;
    for (const double offset : offsets) {
        mean += offset / static_cast<double>(offsets.size());
    }
    double square = 0.0;
    for (const double offset : offsets) {
        square += (offset - mean) * (offset - mean);
    }
    // n - 1, and 1 for a single landing, whose deviation is then 0.
    const double freedom = std::max(static_cast<double>(offsets.size()) - 1.0, 1.0);
    result.deviation = Beats(std::sqrt(square / freedom));
    return result;
}

}  // namespace

void learn_feet(std::span<const TrainingClip> clips,
                std::span<const FigureRepeat> repeats,
                FigureModel& model) {
    // By clip, not by repeat: several repeats share a clip.
    std::vector<ClipFeet> feet;
    for (const TrainingClip& clip : clips) {
        feet.push_back(feet_of(clip));
    }
    std::vector<std::array<std::vector<double>, 2>> toe_speeds;
    for (const ClipFeet& one : feet) {
        toe_speeds.push_back(one.toe_speeds);
    }
    model.peak_toe_speed = peak_toe_speed(clips, repeats, toe_speeds);
    double weight_sum = 0.0;
    for (const FigureRepeat& repeat : repeats) {
        weight_sum += repeat.weight;
    }
    for (std::size_t s = 0; s < 2; ++s) {
        std::vector<std::vector<double>> offsets(static_cast<std::size_t>(model.beats));
        std::fill(model.contact[s].begin(), model.contact[s].end(), 0.0);
        // Contacts are weighted; landings are not, because their summary is a median.
        for (const FigureRepeat& repeat : repeats) {
            const PhaseWarp warp(repeat.beat_frames);
            add_contacts(
                feet[repeat.clip].contacts[s], repeat, warp, model.beats, model.contact[s]);
            add_landings(feet[repeat.clip].landings[s], warp, model.beats, offsets);
        }
        // Rounding may bring the weighted mean just above 1.
        for (double& chance : model.contact[s]) {
            chance = std::min(chance / weight_sum, 1.0);
        }
        model.landings[s].clear();
        for (std::vector<double>& one : offsets) {
            model.landings[s].push_back(summary_of(std::move(one)));
        }
    }
}

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
