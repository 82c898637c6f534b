#include <algorithm>
#include <array>
#include <cmath>
#include <utility>

#include "engine/trials/dance_trial.hpp"

#include <fmt/format.h>

namespace raks::engine {
namespace {

using audio::Style;

constexpr double kSteadySeconds = 60.0;
constexpr double kRampPerSecond = 0.02;
constexpr double kBeforeRamp = 15.0;  // seconds: tracked, started, blended in
constexpr double kBehindRamp = 10.0;

audio::MusicPlan music(Style style, double bpm, double seconds) {
    audio::MusicPlan plan;
    plan.style = style;
    plan.tempo = {{0.0, bpm}};
    plan.seconds = seconds;
    plan.channels = 1;
    return plan;
}

DanceTrial steady(Style style, double bpm) {
    return {fmt::format("{}-{:.0f}", audio::name_of(style), bpm),
            TrialKind::steady,
            music(style, bpm, kSteadySeconds)};
}

/// Every second 2 % faster or slower than the one before.
DanceTrial ramp(Style style, double from, double to) {
    const double seconds = std::abs(std::log(to / from)) / std::log1p(kRampPerSecond);
    DanceTrial trial{fmt::format("{}-{:.0f}-to-{:.0f}", audio::name_of(style), from, to),
                     TrialKind::ramp,
                     music(style, from, kBeforeRamp + seconds + kBehindRamp)};
    trial.music.tempo.clear();
    for (double t = 0.0; t < seconds; t += 1.0) {
        trial.music.tempo.push_back({kBeforeRamp + t, from * std::pow(to / from, t / seconds)});
    }
    trial.music.tempo.push_back({kBeforeRamp + seconds, to});
    trial.judged_from = kBeforeRamp;
    trial.judged_to = kBeforeRamp + seconds;
    return trial;
}

DanceTrial with_silences(DanceTrial trial, std::vector<audio::Silence> silences) {
    trial.kind = TrialKind::breaks;
    trial.name += "-silences";
    trial.music.seconds = 90.0;
    trial.music.silences = std::move(silences);
    return trial;
}

/// Stops, and goes on at another tempo.
DanceTrial with_jump(Style style, double from, double to) {
    DanceTrial trial{fmt::format("{}-{:.0f}-jump-{:.0f}", audio::name_of(style), from, to),
                     TrialKind::breaks,
                     music(style, from, 70.0)};
    trial.music.tempo = {{0.0, from}, {30.0, from}, {30.0, to}};
    trial.music.silences = {{30.0, 33.0}};
    return trial;
}

std::vector<DanceTrial> salsa_trials() {
    std::vector<DanceTrial> trials = {steady(Style::drums, 100.0),
                                      steady(Style::maqsum, 110.0),
                                      steady(Style::drums, 120.0),
                                      steady(Style::house, 126.0),
                                      steady(Style::drums, 140.0),
                                      steady(Style::drums, 150.0)};
    for (const double bpm : {160.0, 170.0, 180.0, 190.0, 200.0}) {
        trials.push_back(steady(Style::salsa, bpm));
    }
    trials.push_back(ramp(Style::salsa, 160.0, 200.0));
    trials.push_back(ramp(Style::salsa, 200.0, 160.0));
    trials.push_back(ramp(Style::drums, 110.0, 160.0));
    trials.push_back(ramp(Style::drums, 160.0, 110.0));
    // A break of a beat or two is danced through, a longer one settled in.
    trials.push_back(with_silences(steady(Style::salsa, 180.0),
                                   {{20.0, 20.7}, {30.0, 31.4}, {40.0, 46.0}, {65.0, 67.0}}));
    trials.push_back(
        with_silences(steady(Style::drums, 130.0), {{0.0, 3.0}, {25.0, 26.0}, {45.0, 50.0}}));
    trials.push_back(with_jump(Style::salsa, 165.0, 190.0));
    return trials;
}

Style style_of(std::string_view dance) {
    constexpr std::array<std::pair<std::string_view, Style>, 5> kStyles = {{
        {"belly", Style::maqsum},
        {"house", Style::house},
        {"hiphop", Style::hiphop},
        {"rock", Style::rock},
        {"waltz", Style::waltz},
    }};
    const auto found = std::find_if(
        kStyles.begin(), kStyles.end(), [&](const auto& one) { return one.first == dance; });
    return found != kStyles.end() ? found->second : Style::drums;
}

}  // namespace

std::vector<DanceTrial> standard_trials(std::string_view dance, Bpm learnt) {
    if (dance == "salsa") {
        return salsa_trials();
    }
    const Style style = style_of(dance);
    const double written = std::round(learnt.bpm());
    const double slow = std::round(0.85 * written);
    const double fast = std::round(1.15 * written);
    return {steady(style, slow),
            steady(style, written),
            steady(style, fast),
            ramp(style, slow, fast),
            ramp(style, fast, slow),
            with_silences(steady(style, written), {{20.0, 20.7}, {30.0, 32.0}, {45.0, 51.0}})};
}

}  // namespace raks::engine
