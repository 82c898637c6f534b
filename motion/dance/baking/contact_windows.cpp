#include "motion/dance/baking/contact_windows.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include "motion/dance/body/closed_curve.hpp"

namespace raks::motion {
namespace {

constexpr double kSmoothBeats = 0.15;
constexpr double kLeastGapBeats = 0.25;
constexpr double kLeastContactBeats = 0.34;
constexpr double kContactChance = 0.45;
constexpr double kLandingReach = 0.75;  // beats between a contact's start and its landing
constexpr int kLandingRepeats = 3;
constexpr double kStepBeats = 0.4;  // that a step stands which people hardly rest on
// Of a foot that passes: it stands so long at the least (less is not seen as a landing), and flies
// on for so long (0.36 beats: as good; 0.42: it hardly stands).
constexpr double kLeastStandBeats = 0.08;
constexpr double kLeastFlightBeats = 0.38;
// Beats from the landing (the foot falls under 0.30 m/s) until it stands still.
constexpr double kRestAfterLanding = 0.012;

/// Beats of the figure on which a foot stands still after its landings, but for those of few
/// repeats.
std::vector<double> standing_beats(const std::vector<LandingOffset>& landings) {
    std::vector<double> beats;
    for (std::size_t count = 0; count < landings.size(); ++count) {
        if (landings[count].repeats >= kLandingRepeats) {
            beats.push_back(static_cast<double>(count) + landings[count].median.count() +
                            kRestAfterLanding);
        }
    }
    return beats;
}

/// Beats from `from` to `to` on a closed figure, nearest way.
double beats_between(double from, double to, double beats) {
    const double apart = to - from;
    return apart - beats * std::round(apart / beats);
}

/// Shortest contact that is worth locking, in samples.
std::ptrdiff_t shift_floor(double samples_per_beat) {
    return static_cast<std::ptrdiff_t>(0.2 * samples_per_beat);
}

/// Runs of `value` in a closed row.
std::vector<ContactWindow> runs_of(const std::vector<bool>& row, bool value) {
    std::vector<ContactWindow> runs;
    const std::size_t size = row.size();
    if (std::find(row.begin(), row.end(), !value) == row.end()) {
        return {{0, size}};
    }
    for (std::size_t i = 0; i < size; ++i) {
        if (row[i] != value || row[wrap(static_cast<std::ptrdiff_t>(i) - 1, size)] == value) {
            continue;
        }
        std::size_t length = 0;
        while (length < size && row[(i + length) % size] == value) {
            ++length;
        }
        runs.push_back({i, length});
    }
    return runs;
}

void fill(std::vector<bool>& row, const ContactWindow& window, bool value) {
    for (std::size_t k = 0; k < window.length; ++k) {
        row[(window.first + k) % row.size()] = value;
    }
}

/// A contact, or what is planned of one, in beats of the figure.
struct Stand {
    double first = 0.0;
    double length = 0.0;
};

Stand in_beats(const ContactWindow& window, double samples_per_beat) {
    return {static_cast<double>(window.first) / samples_per_beat,
            static_cast<double>(window.length) / samples_per_beat};
}

/// The windows and steps that stand so, by their start.
std::vector<ContactWindow> with_stands(std::vector<ContactWindow> windows,
                                       const std::vector<Stand>& stands,
                                       bool is_passing,
                                       double samples_per_beat,
                                       std::size_t samples) {
    for (const Stand& stand : stands) {
        const auto first = static_cast<std::ptrdiff_t>(std::lround(stand.first * samples_per_beat));
        const auto length = static_cast<std::size_t>(stand.length * samples_per_beat);
        windows.push_back({wrap(first, samples), length, true, is_passing});
    }
    std::sort(windows.begin(), windows.end(), [](const auto& a, const auto& b) {
        return a.first < b.first;
    });
    return windows;
}

/// A step that comes down where no contact is (dancers spin on it, the toe hardly rests) stands for
/// a moment, too: else it would slide through its landing.
std::vector<ContactWindow> with_steps(std::vector<ContactWindow> windows,
                                      const std::vector<LandingOffset>& landings,
                                      double samples_per_beat,
                                      std::size_t samples) {
    const double beats = static_cast<double>(samples) / samples_per_beat;
    std::vector<Stand> steps;
    for (const double landing : standing_beats(landings)) {
        const auto is_near = [&](const ContactWindow& window) {
            const Stand own = in_beats(window, samples_per_beat);
            return std::abs(beats_between(own.first + 0.5 * own.length, landing, beats)) <
                   0.5 * own.length + kStepBeats + kLeastGapBeats;
        };
        if (std::none_of(windows.begin(), windows.end(), is_near)) {
            steps.push_back({landing, kStepBeats});
        }
    }
    return with_stands(std::move(windows), steps, false, samples_per_beat, samples);
}

}  // namespace

std::vector<ContactWindow> contact_windows(const std::array<double, kContactBins>& chance,
                                           int beats,
                                           std::size_t samples) {
    const double bins_per_beat = static_cast<double>(kContactBins) / beats;
    const std::vector<double> smooth =
        smoothed(std::vector<double>(chance.begin(), chance.end()), kSmoothBeats * bins_per_beat);
    std::vector<bool> row(samples);
    for (std::size_t i = 0; i < samples; ++i) {
        row[i] = smooth[i * kContactBins / samples] > kContactChance;
    }
    const double samples_per_beat = static_cast<double>(samples) / beats;
    for (const ContactWindow& gap : runs_of(row, false)) {
        if (static_cast<double>(gap.length) < kLeastGapBeats * samples_per_beat) {
            fill(row, gap, true);
        }
    }
    for (const ContactWindow& contact : runs_of(row, true)) {
        if (static_cast<double>(contact.length) < kLeastContactBeats * samples_per_beat) {
            fill(row, contact, false);
        }
    }
    return runs_of(row, true);
}

std::vector<ContactWindow> start_at_landings(std::vector<ContactWindow> windows,
                                             const std::vector<LandingOffset>& landings,
                                             double samples_per_beat,
                                             std::size_t samples) {
    for (ContactWindow& window : windows) {
        double best = kLandingReach;
        for (const double landing : standing_beats(landings)) {
            const double away = beats_between(static_cast<double>(window.first) / samples_per_beat,
                                              landing,
                                              static_cast<double>(samples) / samples_per_beat);
            best = std::abs(away) < std::abs(best) ? away : best;
        }
        const auto shift = static_cast<std::ptrdiff_t>(std::lround(best * samples_per_beat));
        const auto length = static_cast<std::ptrdiff_t>(window.length) - shift;
        if (std::abs(best) < kLandingReach && length > shift_floor(samples_per_beat)) {
            window.first = wrap(static_cast<std::ptrdiff_t>(window.first) + shift, samples);
            window.length = static_cast<std::size_t>(length);
            window.is_step = true;
        }
    }
    return with_steps(std::move(windows), landings, samples_per_beat, samples);
}

std::vector<ContactWindow> with_passing_steps(std::vector<ContactWindow> windows,
                                              const std::vector<LandingOffset>& landings,
                                              double samples_per_beat,
                                              std::size_t samples) {
    const double beats = static_cast<double>(samples) / samples_per_beat;
    std::vector<Stand> steps;
    for (const double landing : standing_beats(landings)) {
        double stands = kStepBeats;
        for (const ContactWindow& window : windows) {
            const Stand own = in_beats(window, samples_per_beat);
            const double since = beats_between(own.first, landing, beats);
            const double after = since < 0.0 ? since + beats : since;
            const bool has_it = after < own.length || std::abs(since) < kLeastStandBeats;
            stands = std::min(stands, has_it ? 0.0 : beats - after - kLeastFlightBeats);
        }
        if (stands >= kLeastStandBeats) {
            steps.push_back({landing, stands});
        }
    }
    return with_stands(std::move(windows), steps, true, samples_per_beat, samples);
}

}  // namespace raks::motion
