#include <cmath>
#include <string>
#include <utility>

#include "engine/trials/dance_trial.hpp"

#include <fmt/format.h>

namespace raks::engine {
namespace {

using audio::Style;

// Length of a steady trial.
constexpr double kSteadySeconds = 60.0;
// Relative change of the tempo per second.
constexpr double kRampPerSecond = 0.02;
// Seconds before a ramp begins: the tempo is tracked, and the dance has started and blended in.
constexpr double kBeforeRamp = 15.0;
// Seconds after a ramp, so that its last landings lie well inside the music.
constexpr double kBehindRamp = 10.0;

// Mono, as the analyzer takes it, at a constant tempo.
audio::MusicPlan music(Style style, double bpm, double seconds) {
    audio::MusicPlan plan;
    plan.style = style;
    plan.tempo = {{0.0, bpm}};
    plan.seconds = seconds;
    plan.channels = 1;
    return plan;
}

// A style of music with the name that its trials carry.
struct TrialMusic {
    std::string name;
    Style style = Style::drums;
};

// Music of another style than the dance's own.
TrialMusic other(Style style) { return {std::string(audio::name_of(style)), style}; }

DanceTrial steady(const TrialMusic& of, double bpm) {
    return {fmt::format("{}-{:.0f}", of.name, bpm),
            TrialKind::steady,
            music(of.style, bpm, kSteadySeconds)};
}

// The tempo changes by 2 % every second, from one tempo to the other; landings are judged
// meanwhile. The points follow the exponential, one a second.
DanceTrial ramp(const TrialMusic& of, double from, double to) {
    // Number of seconds at that rate.
    const double seconds = std::abs(std::log(to / from)) / std::log1p(kRampPerSecond);
    DanceTrial trial{fmt::format("{}-{:.0f}-to-{:.0f}", of.name, from, to),
                     TrialKind::ramp,
                     music(of.style, from, kBeforeRamp + seconds + kBehindRamp)};
    trial.music.tempo.clear();
    for (double t = 0.0; t < seconds; t += 1.0) {
        trial.music.tempo.push_back({kBeforeRamp + t, from * std::pow(to / from, t / seconds)});
    }
    trial.music.tempo.push_back({kBeforeRamp + seconds, to});
    trial.judged_from = kBeforeRamp;
    trial.judged_to = kBeforeRamp + seconds;
    return trial;
}

// The same music of 90 s with silences at the given seconds.
DanceTrial with_silences(DanceTrial trial, std::vector<audio::Silence> silences) {
    trial.kind = TrialKind::breaks;
    trial.name += "-silences";
    trial.music.seconds = 90.0;
    trial.music.silences = std::move(silences);
    return trial;
}

// Stops for 3 s and goes on at another tempo: the old beat must not be kept.
DanceTrial with_jump(const TrialMusic& of, double from, double to) {
    DanceTrial trial{fmt::format("{}-{:.0f}-jump-{:.0f}", of.name, from, to),
                     TrialKind::breaks,
                     music(of.style, from, 70.0)};
    // Two points at the same time make the jump.
    trial.music.tempo = {{0.0, from}, {30.0, from}, {30.0, to}};
    trial.music.silences = {{30.0, 33.0}};
    return trial;
}

// 100 to 200 BPM: the dance's own style from 160 BPM on, other styles below.
std::vector<DanceTrial> full_trials(const TrialMusic& own) {
    const TrialMusic drums = other(Style::drums);
    std::vector<DanceTrial> trials = {steady(drums, 100.0),
                                      steady(other(Style::maqsum), 110.0),
                                      steady(drums, 120.0),
                                      steady(other(Style::four_on_the_floor), 126.0),
                                      steady(drums, 140.0),
                                      steady(drums, 150.0)};
    for (const double bpm : {160.0, 170.0, 180.0, 190.0, 200.0}) {
        trials.push_back(steady(own, bpm));
    }
    trials.push_back(ramp(own, 160.0, 200.0));
    trials.push_back(ramp(own, 200.0, 160.0));
    trials.push_back(ramp(drums, 110.0, 160.0));
    trials.push_back(ramp(drums, 160.0, 110.0));
    // Breaks of a beat or two are danced through; in longer ones the dancer settles.
    trials.push_back(with_silences(steady(own, 180.0),
                                   {{20.0, 20.7}, {30.0, 31.4}, {40.0, 46.0}, {65.0, 67.0}}));
    trials.push_back(with_silences(steady(drums, 130.0), {{0.0, 3.0}, {25.0, 26.0}, {45.0, 50.0}}));
    trials.push_back(with_jump(own, 165.0, 190.0));
    return trials;
}

// For dances of any tempo: 15 % to either side of the learnt one.
std::vector<DanceTrial> brief_trials(const TrialMusic& own, Bpm learnt) {
    const double written = std::round(learnt.bpm());
    const double slow = std::round(0.85 * written);
    const double fast = std::round(1.15 * written);
    return {steady(own, slow),
            steady(own, written),
            steady(own, fast),
            ramp(own, slow, fast),
            ramp(own, fast, slow),
            with_silences(steady(own, written), {{20.0, 20.7}, {30.0, 32.0}, {45.0, 51.0}})};
}

}  // namespace

std::vector<DanceTrial> standard_trials(const DanceInfo& dance, Bpm learnt) {
    // A dance without a style of the generator is tried with drums.
    const Style style = audio::style_from_name(dance.style).value_or(Style::drums);
    const TrialMusic own{dance.name, style};
    return dance.trials == DanceInfo::Trials::full ? full_trials(own) : brief_trials(own, learnt);
}

}  // namespace raks::engine
