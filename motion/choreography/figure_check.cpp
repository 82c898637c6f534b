#include "motion/choreography/figure_check.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <string_view>

#include <glm/geometric.hpp>

namespace raks::motion {
namespace {

constexpr std::array<std::string_view, 2> kFootNames = {"left foot", "right foot"};  // by Side

std::string_view name_of(Side side) { return kFootNames[static_cast<std::size_t>(side)]; }

std::string_view unit_of(ControlUnit unit) {
    switch (unit) {
        case ControlUnit::centimetres:
            return " cm";
        case ControlUnit::degrees:
            return " degrees";
        case ControlUnit::share:
            return "";
    }
    return "";
}

// Keys must lie in [0, beats): the next repeat has its own key at `beats`.
std::optional<FigureFault> fault_in_keys(const AuthoredFigure& figure) {
    for (std::size_t i = 0; i < kControlCount; ++i) {
        for (const Track& track : figure.body[i]) {
            if (!track.has_keys()) {
                continue;
            }
            const double first = track.keys.front().beat;
            const double last = track.keys.back().beat;
            if (first < 0.0 || last >= figure.beats) {
                return FigureFault{
                    figure.line,
                    fmt::format("beat {}: a key of {} lies outside the figure's {} beats (0 is its "
                                "first; the next repeat begins at {})",
                                first < 0.0 ? first : last,
                                info_of(static_cast<Control>(i)).name,
                                figure.beats,
                                figure.beats)};
            }
        }
    }
    return std::nullopt;
}

/// The beat at which one track of a control is furthest out, for the message. `direction`: +1 up,
/// -1 down.
double beat_of_extreme(const std::vector<Track>& tracks, double direction) {
    double beat = 0.0;
    double most = -1e300;
    for (const Track& track : tracks) {
        if (!track.has_keys() && track.wave != 0.0 && direction * track.wave > most) {
            most = direction * track.wave;
            beat = track.peak;
        }
        for (const TrackKey& key : track.keys) {
            if (direction * key.value > most) {
                most = direction * key.value;
                beat = key.beat;
            }
        }
    }
    return beat;
}

// The sum of the tracks' extremes: an upper bound, as they may lie at different beats.
std::optional<FigureFault> fault_in_limits(const AuthoredFigure& figure) {
    constexpr double kRounding = 1e-9;
    for (std::size_t i = 0; i < kControlCount; ++i) {
        const ControlInfo& info = info_of(static_cast<Control>(i));
        double low = 0.0;
        double high = 0.0;
        for (const Track& track : figure.body[i]) {
            low += track.lowest();
            high += track.highest();
        }
        const bool is_high = high > info.highest + kRounding;
        if (is_high || low < info.lowest - kRounding) {
            return FigureFault{
                figure.line,
                fmt::format("beat {:.4g}: {} comes to {:.4g}{}, must stay within {} to {}",
                            beat_of_extreme(figure.body[i], is_high ? 1.0 : -1.0),
                            info.name,
                            is_high ? high : low,
                            unit_of(info.unit),
                            info.lowest,
                            info.highest)};
        }
    }
    return std::nullopt;
}

/// The steps of one foot in order, followed by the first one that it makes in the next repeat.
std::vector<FootStep> steps_of(const AuthoredFigure& figure, Side side) {
    std::vector<FootStep> steps;
    for (const FootStep& step : figure.steps) {
        if (step.foot == side) {
            steps.push_back(step);
        }
    }
    // A mirrored repeat begins with the other foot's steps in this one's place.
    const auto follows =
        std::find_if(figure.steps.begin(), figure.steps.end(), [&](const FootStep& step) {
            return (step.foot == side) != figure.is_mirrored;
        });
    if (follows != figure.steps.end()) {
        steps.push_back(*follows);
        steps.back().at += figure.beats;
    }
    return steps;
}

/// Steps of a foot may overlap a little, as the later one is then shortened (separate() in
/// step_layout.cpp), but at least half of its time in the air must be left.
std::optional<FigureFault> fault_in_steps(const AuthoredFigure& figure) {
    constexpr double kLeastShare = 0.5;
    for (const Side side : kSides) {
        const std::vector<FootStep> steps = steps_of(figure, side);
        for (std::size_t i = 1; i < steps.size(); ++i) {
            const double gap = steps[i].at + steps[i].land - steps[i - 1].at - steps[i - 1].land;
            if (gap < kLeastShare * steps[i].air) {
                return FigureFault{
                    steps[i].line,
                    fmt::format(
                        "beat {:.4g}: {} leaves the floor at {:.4g} and only lands from the "
                        "step before at {:.4g}; shorten air or land later",
                        steps[i].at,
                        name_of(side),
                        steps[i].at + steps[i].land - steps[i].air,
                        steps[i - 1].at + steps[i - 1].land)};
            }
        }
    }
    return std::nullopt;
}

/// The balls of both feet must not be closer than a foot is wide.
std::optional<FigureFault> fault_in_places(const AuthoredFigure& figure) {
    constexpr double kFootWidth = 4.0;  // cm; balls nearer than this stand on one another
    std::array<std::optional<glm::dvec2>, 2> places;
    // Two rounds: at the start of the figure the other foot stands where its last step left it.
    for (int round = 0; round < 2; ++round) {
        for (const FootStep& step : figure.steps) {
            const auto s = static_cast<std::size_t>(step.foot);
            if (step.to) {
                places[s] = *step.to;
            }
            const auto& other = places[1 - s];
            // Only in figures that stay: in others places of different repeats are in different
            // frames.
            if (figure.stays() && !figure.is_mirrored && places[s] && other &&
                glm::length(*places[s] - *other) < kFootWidth) {
                return FigureFault{step.line,
                                   fmt::format("beat {:.4g}: {} lands on the {} ({:.1f} cm between "
                                               "the balls, must be {})",
                                               step.at,
                                               name_of(step.foot),
                                               name_of(kSides[1 - s]),
                                               glm::length(*places[s] - *other),
                                               kFootWidth)};
            }
        }
    }
    return std::nullopt;
}

}  // namespace

std::optional<FigureFault> first_fault(const AuthoredFigure& figure) {
    for (const auto& check : {fault_in_keys, fault_in_limits, fault_in_steps, fault_in_places}) {
        if (auto fault = check(figure)) {
            return fault;
        }
    }
    return std::nullopt;
}

}  // namespace raks::motion
