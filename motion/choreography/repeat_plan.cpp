#include "motion/choreography/repeat_plan.hpp"

#include <algorithm>
#include <cmath>

#include "motion/choreography/splines.hpp"
#include "motion/figures/size_by_tempo.hpp"

namespace raks::motion {

RepeatPlan plan_repeats(const AuthoredFigure& figure, const EvaluationOptions& options) {
    constexpr int kRepeatsAround = 2;  // beyond the margin, for the splines' and filters' ends
    RepeatPlan plan;
    plan.figure = &figure;
    plan.tempo = options.tempo;
    // Written size at the written tempo, smaller above it and larger below it (limited by
    // size_at()).
    plan.size = size_at(figure.style.tempo_scale, options.written, options.tempo);
    plan.noise = options.noise;
    plan.seed = options.seed;
    plan.frames_per_second = options.frames_per_second;
    const double beats = figure.beats;
    const int around = static_cast<int>(std::ceil(options.margin / beats)) + kRepeatsAround;
    plan.first_repeat = -around;
    plan.last_repeat = options.repeats - 1 + around;

    const double from = -options.margin;
    const double to = options.repeats * beats + options.margin;
    const double step = options.tempo.beats_per_second() / options.frames_per_second;
    const double jitter = figure.style.jitter * options.noise;  // deviation, beats
    constexpr double kArmJitter = 0.6;  // of the arms' own noise, added to the body's
    const double period = std::max(2.0, beats / 2.0);  // beats between the noise's knots: slow
    const Spline body = wander(plan.random(Draw::clock), period, from, to);
    const Spline arms = wander(plan.random(Draw::arm_clock), period, from, to);
    const auto frames = static_cast<std::size_t>(std::floor((to - from) / step + 1e-9)) + 1;
    // Frames are equidistant in the music's time; the dancer's clocks run a little early or late.
    for (std::size_t i = 0; i < frames; ++i) {
        const double beat = from + static_cast<double>(i) * step;
        const double own = beat + jitter * body(beat);
        plan.music_beats.push_back(beat);
        plan.beats.push_back(own);
        plan.arm_beats.push_back(own + jitter * kArmJitter * arms(beat));
    }
    return plan;
}

}  // namespace raks::motion
