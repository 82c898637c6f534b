#include "engine/cli/commands.hpp"

#include <unistd.h>

#include <cstdio>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "motion/figures/figure_model.hpp"
#include "motion/figures/training_plan.hpp"

#include <fmt/format.h>

namespace raks::cli {
namespace {

motion::FigureTrainingPlan plan_of(const TrainFigureArguments& arguments) {
    motion::FigureTrainingPlan plan;
    plan.clips = arguments.clips;
    plan.labels = arguments.labels;
    if (!arguments.counts.empty()) {
        plan.counts = arguments.counts;
    }
    if (!arguments.faults.empty()) {
        plan.faults = arguments.faults;
    }
    plan.figure = arguments.figure;
    plan.dance = arguments.dance;
    plan.role = arguments.role == "lead" ? motion::DanceRole::lead : motion::DanceRole::follow;
    plan.split = arguments.split;
    plan.min_confidence = arguments.min_confidence;
    if (arguments.fps > 0.0) {
        plan.frames_per_second = arguments.fps;
    }
    if (arguments.scale > 0.0) {
        plan.metres_per_unit = arguments.scale;
    }
    plan.states = arguments.states;
    plan.baum_welch_iterations = arguments.iterations;
    if (arguments.source == "cmu") {
        plan.attribution = std::string(motion::cmu_attribution());
    }
    return plan;
}

}  // namespace

ExitCode train_figure(const TrainFigureArguments& arguments) {
    const auto report = motion::train_figure(plan_of(arguments));
    if (!report) {
        return fail(report.error());
    }
    for (const std::string& warning : report->warnings) {
        std::fprintf(stderr, "raks: %s\n", warning.c_str());
    }
    if (auto saved = motion::save_figure(report->model, arguments.output); !saved) {
        return fail(saved.error());
    }
    int used = 0;
    for (const motion::RepeatUse& use : report->repeats) {
        used += use.left_out.empty() ? 1 : 0;
    }
    std::fputs(
        fmt::format("{}: {} of {} repeats; log-likelihood a sample: torso {:.1f}, upper {:.1f}, "
                    "lower {:.1f}\n",
                    arguments.output.string(),
                    used,
                    report->repeats.size(),
                    report->log_likelihood[0],
                    report->log_likelihood[1],
                    report->log_likelihood[2])
            .c_str(),
        stdout);
    return kExitDone;
}

ExitCode train_beats(const std::vector<std::string>& arguments) {
    std::error_code problem;
    const Path self = std::filesystem::read_symlink("/proc/self/exe", problem);
    std::string program = (self.parent_path() / "raks-train-beats").string();
    std::vector<std::string> words = arguments;
    std::vector<char*> argv = {program.data()};
    for (std::string& word : words) {
        argv.push_back(word.data());
    }
    argv.push_back(nullptr);
    execv(program.c_str(), argv.data());
    return fail({program + ": not there; build the target raks-train-beats"});
}

}  // namespace raks::cli
