#include "motion/dance/baking/contact_windows.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include "motion/dance/body/curves.hpp"

namespace raks::motion {
namespace {

// All times in beats. The probability of contact is smoothed by a Gaussian of this deviation.
constexpr double kSmoothingBeats = 0.15;
// From this smoothed probability on a foot is in contact.
constexpr double kContactProbability = 0.45;
// Shorter gaps between two contacts are closed, then shorter contacts are dropped.
constexpr double kLeastGapBeats = 0.25;
constexpr double kLeastContactBeats = 0.34;
// A landing counts when so many repeats of the figure show it.
constexpr int kLandingRepeats = 3;
// A landing without a contact gets one of this length.
constexpr double kStepBeats = 0.4;
// A foot that passes through a step stands at least so long (what is shorter is not found as a
// landing), and flies at least so long before its next step (0.36 works as well; with 0.42 the foot
// hardly stands).
constexpr double kLeastStandBeats = 0.08;
constexpr double kLeastFlightBeats = 0.38;
// A foot is at rest so long after its landing, which is where its speed falls under 0.30 m/s.
constexpr double kRestBeatsAfterLanding = 0.012;
// A contact is moved to its landing as long as it stays longer than this.
constexpr double kLeastMovedBeats = 0.2;

/// Phases (beats) at which a foot is at rest after each of its landings. Landings of fewer than
/// kLandingRepeats repeats are left out.
std::vector<double> standing_beats(const std::vector<LandingOffset>& landings) {
    std::vector<double> beats;
    for (std::size_t count = 0; count < landings.size(); ++count) {
        if (landings[count].repeats >= kLandingRepeats) {
            beats.push_back(static_cast<double>(count) + landings[count].median.count() +
                            kRestBeatsAfterLanding);
        }
    }
    return beats;
}

/// Signed beats from `from` to `to` on a closed figure, the shorter way round.
double beats_between(double from, double to, double beats) {
    const double apart = to - from;
    return apart - beats * std::round(apart / beats);
}

/// A contact that is moved to its landing must stay longer than this, in samples.
std::ptrdiff_t shift_floor(double samples_per_beat) {
    return static_cast<std::ptrdiff_t>(kLeastMovedBeats * samples_per_beat);
}

/// Runs of `value` in a closed row; one run may go over the end. A row of nothing else is one run.
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

/// The windows together with `stands`, sorted by their first sample.
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

/// Adds a contact of kStepBeats for each landing that no window is near: dancers spin on that foot,
/// its toe hardly rests, and without a contact the foot would slide through its landing.
std::vector<ContactWindow> with_steps(std::vector<ContactWindow> windows,
                                      const std::vector<LandingOffset>& landings,
                                      double samples_per_beat,
                                      std::size_t samples) {
    const double beats = static_cast<double>(samples) / samples_per_beat;
    std::vector<Stand> steps;
    for (const double landing : standing_beats(landings)) {
        const auto is_near = [&](const ContactWindow& window) {
            const Stand own = in_beats(window, samples_per_beat);
            // Near: the landing lies within the window, or too close for another contact and a gap.
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

std::vector<ContactWindow> contact_windows(std::span<const double> chance,
                                           int beats,
                                           std::size_t samples) {
    const double bins_per_beat = static_cast<double>(chance.size()) / beats;
    const std::vector<double> smooth = smoothed(std::vector<double>(chance.begin(), chance.end()),
                                                kSmoothingBeats * bins_per_beat);
    std::vector<bool> row(samples);
    for (std::size_t i = 0; i < samples; ++i) {
        row[i] = smooth[i * smooth.size() / samples] > kContactProbability;
    }
    const double samples_per_beat = static_cast<double>(samples) / beats;
    // Gaps first: two halves of one contact must not be dropped each for being short.
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
                                             double reach,
                                             double samples_per_beat,
                                             std::size_t samples) {
    for (ContactWindow& window : windows) {
        double best = reach;
        for (const double landing : standing_beats(landings)) {
            const double away = beats_between(static_cast<double>(window.first) / samples_per_beat,
                                              landing,
                                              static_cast<double>(samples) / samples_per_beat);
            best = std::abs(away) < std::abs(best) ? away : best;
        }
        // Only the start moves, so the length changes by as much; one that would get too short
        // stays as it is.
        const auto shift = static_cast<std::ptrdiff_t>(std::lround(best * samples_per_beat));
        const auto length = static_cast<std::ptrdiff_t>(window.length) - shift;
        if (std::abs(best) < reach && length > shift_floor(samples_per_beat)) {
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
        // It may stand until kLeastFlightBeats before the next window; not at all where a window
        // has this landing already.
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
