#include "apps/raks_train/commands.hpp"

#include <algorithm>
#include <cstdio>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "apps/raks_train/likelihoods.hpp"
#include "apps/raks_train/tracked_counts.hpp"
#include "apps/terminal/say.hpp"
#include "base/file.hpp"
#include "motion/figures/figure_model.hpp"
#include "training/figures/training_plan.hpp"

#include <fmt/format.h>

namespace raks::apps {
namespace {

/// The value that `names` gives this name; the parser let no other through.
template <typename Value, typename Names>
Value named(const Names& names, const std::string& name) {
    return static_cast<Value>(std::find(names.begin(), names.end(), name) - names.begin());
}

motion::FigureTrainingPlan figure_plan(const TrainFigureArguments& arguments) {
    motion::FigureTrainingPlan plan = plan_of(arguments);
    if (!arguments.figure.empty()) {
        plan.figure = arguments.figure;
    }
    plan.dance = arguments.dance;
    plan.role = arguments.role == "lead" ? motion::DanceRole::lead : motion::DanceRole::follow;
    plan.features = arguments.features == "positions" ? motion::FigureFeatures::positions
                                                      : motion::FigureFeatures::angles;
    if (arguments.scale > 0.0) {
        plan.metres_per_unit = arguments.scale;
    }
    if (arguments.states > 0) {
        plan.states = arguments.states;
    }
    plan.baum_welch_iterations = arguments.iterations;
    plan.covariance =
        named<motion::CovarianceKind>(motion::kCovarianceKindNames, arguments.covariance);
    plan.start = named<motion::StatesStart>(motion::kStatesStartNames, arguments.start);
    if (arguments.source == "cmu") {
        plan.attribution = std::string(motion::cmu_attribution());
    }
    return plan;
}

}  // namespace

motion::FigureTrainingPlan plan_of(const LabelledClips& clips) {
    motion::FigureTrainingPlan plan;
    plan.clips = clips.clips;
    plan.labels = clips.labels;
    if (!clips.counts.empty()) {
        plan.counts = clips.counts;
    }
    if (!clips.faults.empty()) {
        plan.faults = clips.faults;
    }
    plan.split = clips.split;
    plan.min_confidence = clips.min_confidence;
    if (clips.fps > 0.0) {
        plan.frames_per_second = clips.fps;
    }
    return plan;
}

std::vector<Path> inputs_of(const LabelledClips& clips) {
    std::vector<Path> inputs = clips.clips;
    inputs.insert(inputs.end(), {clips.labels, clips.counts, clips.faults});
    return inputs;
}

ExitCode train_figure(const TrainFigureArguments& arguments) {
    if (arguments.clips.size() == 1 && arguments.clips.front().extension() == ".toml") {
        return train_authored(arguments);
    }
    if (arguments.labels.empty()) {
        say("clips need --labels X.tsv: where each figure begins and ends");
        return kExitUsage;
    }
    std::vector<Path> inputs = inputs_of(arguments);
    inputs.push_back(arguments.music);
    if (auto checked = check_output(arguments.output, inputs); !checked) {
        return fail(std::move(checked.error()));
    }
    motion::FigureTrainingPlan plan = figure_plan(arguments);
    if (!arguments.music.empty()) {
        auto heard = track_counts(arguments.music);
        if (!heard) {
            return fail(std::move(heard.error()));
        }
        if (!heard->warning.empty()) {
            say(heard->warning);
        }
        plan.music = std::move(heard->music);
        plan.music->offset = arguments.offset;
    }
    const auto report = motion::train_figure(plan);
    if (!report) {
        return fail(report.error());
    }
    for (const std::string& warning : report->warnings) {
        say(warning);
    }
    if (auto saved = motion::save_figure(report->model, arguments.output); !saved) {
        return fail(saved.error());
    }
    int used = 0;
    for (const motion::RepeatUse& use : report->repeats) {
        used += use.left_out.empty() ? 1 : 0;
    }
    std::string line = fmt::format("{}: {} of {} repeats; log-likelihood a sample: ",
                                   arguments.output.string(),
                                   used,
                                   report->repeats.size());
    line += listed_likelihoods(report->model.features, report->log_likelihood);
    std::puts(line.c_str());
    return kExitDone;
}

}  // namespace raks::apps
