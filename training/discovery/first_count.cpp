#include "training/discovery/first_count.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>
#include <vector>

namespace raks::motion {
namespace {

constexpr double kLikelyTempo = 120.0;  // BPM
constexpr double kSlowest = 50.0;       // BPM: slower beats are bars
constexpr double kFastest = 210.0;      // BPM: faster ones are halves of beats
constexpr std::size_t kPhases = 64;
constexpr double kWidth = 0.03;       // of a repeat: how far landings of one step lie apart
constexpr double kMostRest = 0.3;     // of a repeat: a longer rest is no better
constexpr double kSureShare = 0.6;    // of the repeats: a step that more of them have is no better
constexpr double kLeastShare = 0.35;  // of the surest step's landings: less is no step
constexpr double kPartnerReach = 0.05;  // of a repeat: half a repeat may be so uneven
constexpr double kOnBeats = 0.1;        // weight of landings on beats, in shares of a repeat

/// One landing within a repeat.
struct PhasedLanding {
    double phase;  ///< 0 to 1
    double rest;   ///< since the landing before it, of either foot, in repeats; at most kMostRest
};
using LandingsBySide = std::array<std::vector<PhasedLanding>, 2>;
using PhaseCurve = std::array<double, kPhases>;

double phase_at(std::size_t i) { return (static_cast<double>(i) + 0.5) / kPhases; }

LandingsBySide within_repeats(std::span<const SignalLanding> landings,
                              std::span<const RepeatSpan> repeats) {
    LandingsBySide phased;
    for (std::size_t i = 0; i < landings.size(); ++i) {
        for (const RepeatSpan& repeat : repeats) {
            if (landings[i].row < repeat.start || landings[i].row >= repeat.end()) {
                continue;
            }
            const double rest =
                i == 0 ? kMostRest : (landings[i].row - landings[i - 1].row) / repeat.length;
            phased[static_cast<std::size_t>(landings[i].side)].push_back(
                {(landings[i].row - repeat.start) / repeat.length, std::min(rest, kMostRest)});
        }
    }
    return phased;
}

/// Of one foot, by phase.
struct StepCurves {
    PhaseCurve share{};  ///< of the repeats, that land there
    PhaseCurve pause{};  ///< mean rest before, less where fewer than kSureShare land
};

StepCurves curves_of(const std::vector<PhasedLanding>& landings, std::size_t repeats) {
    StepCurves curves;
    for (std::size_t i = 0; i < kPhases; ++i) {
        double weight = 0.0;
        double rest = 0.0;
        for (const PhasedLanding& landing : landings) {
            const double d = std::remainder(landing.phase - phase_at(i), 1.0) / kWidth;
            const double near = std::exp(-0.5 * d * d);
            weight += near;
            rest += near * landing.rest;
        }
        curves.share[i] = weight / static_cast<double>(repeats);
        curves.pause[i] = weight > 1e-9 ? rest / weight : 0.0;
        curves.pause[i] *= std::sqrt(std::min(1.0, curves.share[i] / kSureShare));
    }
    return curves;
}

/// The longest pause of the other foot about half a repeat later.
double partner_pause(const PhaseCurve& pause, std::size_t at) {
    const auto reach = static_cast<std::ptrdiff_t>(kPartnerReach * kPhases);
    double most = 0.0;
    for (std::ptrdiff_t k = -reach; k <= reach; ++k) {
        const auto i = static_cast<std::size_t>(static_cast<std::ptrdiff_t>(at + kPhases / 2) + k);
        most = std::max(most, pause[i % kPhases]);
    }
    return most;
}

/// Mean cosine of all landings against a grid of beats from a phase: 1 where all lie on beats.
double on_beats(const LandingsBySide& landings, double phase, int beats) {
    double sum = 0.0;
    for (const auto& side : landings) {
        for (const PhasedLanding& landing : side) {
            sum += std::cos(2.0 * M_PI * beats * (landing.phase - phase));
        }
    }
    const std::size_t count = landings[0].size() + landings[1].size();
    return count > 0 ? sum / static_cast<double>(count) : 0.0;
}

}  // namespace

int beats_of_repeat(double seconds, double landings, int beats_per_bar) {
    int best = beats_per_bar;
    double least = 1e9;
    for (const double bars : {0.5, 1.0, 2.0, 4.0}) {
        const double beats = bars * beats_per_bar;
        const double tempo = 60.0 * beats / seconds;
        if (beats != std::floor(beats)) {
            continue;
        }
        double misfit = std::abs(std::log2(tempo / kLikelyTempo));
        misfit += std::max(0.0, std::log2(landings / beats));
        // Outside of what people dance only where nothing else is left.
        misfit += tempo < kSlowest || tempo > kFastest ? 10.0 : 0.0;
        if (misfit < least) {
            least = misfit;
            best = static_cast<int>(beats);
        }
    }
    return best;
}

double landings_of_repeat(std::span<const SignalLanding> landings,
                          std::span<const RepeatSpan> repeats) {
    const LandingsBySide phased = within_repeats(landings, repeats);
    return repeats.empty() ? 0.0
                           : static_cast<double>(phased[0].size() + phased[1].size()) /
                                 static_cast<double>(repeats.size());
}

std::optional<double> phase_of_count_1(std::span<const SignalLanding> landings,
                                       std::span<const RepeatSpan> repeats,
                                       DanceRole role,
                                       int beats,
                                       const std::function<double(double)>& bonus) {
    if (repeats.empty()) {
        return std::nullopt;
    }
    const LandingsBySide phased = within_repeats(landings, repeats);
    const std::size_t leading = role == DanceRole::lead ? 0 : 1;
    const StepCurves own = curves_of(phased[leading], repeats.size());
    const StepCurves other = curves_of(phased[1 - leading], repeats.size());
    const double surest = *std::max_element(own.share.begin(), own.share.end());
    if (surest < 1.0 / 3.0) {
        return std::nullopt;
    }
    std::optional<double> best;
    double most = 0.0;
    for (std::size_t i = 0; i < kPhases; ++i) {
        const bool is_step = own.share[i] > own.share[(i + kPhases - 1) % kPhases] &&
                             own.share[i] >= own.share[(i + 1) % kPhases] &&
                             own.share[i] > kLeastShare * surest;
        if (!is_step) {
            continue;
        }
        double score = own.pause[i] + partner_pause(other.pause, i);
        score += kOnBeats * on_beats(phased, phase_at(i), beats);
        score += bonus ? bonus(phase_at(i)) : 0.0;
        if (!best || score > most) {
            best = phase_at(i);
            most = score;
        }
    }
    return best;
}

}  // namespace raks::motion
