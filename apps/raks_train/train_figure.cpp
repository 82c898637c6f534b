#include "apps/raks_train/train_commands.hpp"

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "apps/clips/clip_reading.hpp"
#include "apps/raks_train/destination.hpp"
#include "apps/raks_train/found_repeats.hpp"
#include "apps/raks_train/likelihoods.hpp"
#include "apps/raks_train/tracked_counts.hpp"
#include "apps/terminal/say.hpp"
#include "base/pending_file.hpp"
#include "base/plain_name.hpp"
#include "base/printable.hpp"
#include "engine/setup/dance_catalogue.hpp"
#include "engine/setup/dance_folder.hpp"
#include "motion/figures/figure_model.hpp"
#include "training/figures/training_plan.hpp"

#include <fmt/format.h>

namespace raks::apps {
namespace {

// The training plan of the arguments; what is not given stays at the plan's default.
// Errors: those of --joint and --joints.
Expected<motion::FigureTrainingPlan> figure_plan(const TrainFigureArguments& arguments,
                                                 const std::string& dance) {
    auto known = plan_of(arguments);
    if (!known) {
        return known;
    }
    motion::FigureTrainingPlan& plan = *known;
    if (!arguments.figure.empty()) {
        plan.figure = arguments.figure;
    }
    plan.dance = dance;
    plan.role = arguments.role;
    plan.features = arguments.features;
    // 0 and empty stand for "not given" in the arguments.
    const motion::BodyOptions body = arguments.body.options();
    plan.up = body.up;
    plan.metres_per_unit = body.metres_per_unit;
    plan.height = body.height;
    if (arguments.states > 0) {
        plan.states = arguments.states;
    }
    plan.baum_welch_iterations = arguments.iterations;
    plan.covariance = arguments.covariance;
    plan.start = arguments.start;
    // CMU's motion may be used if it is acknowledged: the model's file does that.
    if (arguments.source == "cmu") {
        plan.attribution = std::string(motion::cmu_attribution());
    }
    return known;
}

}  // namespace

Expected<motion::FigureTrainingPlan> plan_of(const LabelledClips& clips) {
    motion::FigureTrainingPlan plan;
    auto joints = clips.joints.labels();
    if (!joints) {
        return fail(std::move(joints.error()));
    }
    plan.joints = std::move(*joints);
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
    plan.reading = clip_reading(clips.fps, clips.skeleton);
    return plan;
}

std::vector<Path> inputs_of(const LabelledClips& clips) {
    std::vector<Path> inputs = clips.clips;
    inputs.insert(inputs.end(), {clips.labels, clips.counts, clips.faults});
    return inputs;
}

namespace {

// The dance of a figure from clips: as --extends or --dance say, as the output is called, as the
// clip is called if it has no labels, or the first of the list, in this order.
Expected<std::string> dance_of(const TrainFigureArguments& arguments) {
    // A figure that extends a dance is of that dance, whatever --dance says.
    for (const std::string& told : {arguments.extends, arguments.dance}) {
        if (!told.empty()) {
            return told;
        }
    }
    if (is_dance_name(arguments.output)) {
        return arguments.output;
    }
    // A clip that nobody labelled is a new dance, by its own name.
    if (arguments.labels.empty()) {
        const std::string name = arguments.clips.front().stem().string();
        if (!is_dance_name(name)) {
            return fail(fmt::format("give the dance a name: -o NAME ({} cannot be one)", name));
        }
        return name;
    }
    const auto catalogue = engine::DanceCatalogue::load();
    if (!catalogue) {
        return fail(catalogue.error());
    }
    return catalogue->list()->all().front().name;
}

// The dances.toml entry of a dance that has this one figure: its tempi lie around the learnt one.
DanceInfo info_of(const motion::FigureModel& model, const TrainFigureArguments& arguments) {
    // Share of the learnt tempo by which the dance's range reaches to either side.
    constexpr double kReach = 0.2;
    DanceInfo info;
    info.name = info.title = model.dance;
    info.extends = arguments.extends;
    info.beats_per_bar = arguments.beats_per_bar;
    // So that the range around it stays within what a dances.toml may say (20 to 400 BPM).
    const double tempo = std::clamp(model.learnt_tempo.bpm(), 25.0, 330.0);
    info.lowest = Bpm(std::round((1.0 - kReach) * tempo));
    info.highest = Bpm(std::round((1.0 + kReach) * tempo));
    info.likely = Bpm(std::round(tempo));
    return info;
}

// Tracks the beats of the music and uses them as the plan's counts.
Expected<void> take_counts(const TrainFigureArguments& arguments,
                           motion::FigureTrainingPlan& plan) {
    auto tracked = track_counts(arguments.music);
    if (!tracked) {
        return fail(std::move(tracked.error()));
    }
    // A damaged file that still plays: its beats are used, and the person is told.
    if (!tracked->warning.empty()) {
        say(tracked->warning);
    }
    plan.music = std::move(tracked->music);
    plan.music->offset = arguments.offset;
    return {};
}

}  // namespace

namespace {

// States for figures of the length found: as many a beat as a captured figure of 8 beats has; of a
// phrase danced once more, for there the states are the motion itself.
int states_of(const motion::DiscoveredClips& found, bool is_once) {
    constexpr int kCaptured = 2;
    constexpr int kOnce = 4;
    int beats = 8;
    for (const motion::DiscoveredClip& clip : found.clips) {
        beats = std::max(beats, clip.found.beats);
    }
    return (is_once ? kOnce : kCaptured) * beats;
}

// --propose: writes what is found, and learns nothing.
ExitCode propose_figure(const TrainFigureArguments& arguments) {
    std::vector<Path> inputs = inputs_of(arguments);
    inputs.push_back(arguments.music);
    const Path page = page_beside(arguments.propose);
    if (page == arguments.propose) {
        say("--propose writes a table, and a page beside it: call it X.tsv");
        return kExitUsage;
    }
    for (const Path& output : {arguments.propose, page}) {
        if (auto checked = check_output(output, inputs); !checked) {
            return fail(std::move(checked.error()));
        }
    }
    auto plan = figure_plan(arguments, arguments.dance);
    if (!plan) {
        return fail(std::move(plan.error()));
    }
    if (!arguments.music.empty()) {
        if (auto taken = take_counts(arguments, *plan); !taken) {
            return fail(std::move(taken.error()));
        }
    }
    if (auto done = propose(arguments, *plan); !done) {
        return fail(std::move(done.error()));
    }
    return kExitDone;
}

}  // namespace

ExitCode train_figure(const TrainFigureArguments& arguments) {
    if (auto checked = check_clip_options(arguments.joints,
                                          {arguments.labels,
                                           arguments.counts,
                                           arguments.faults,
                                           arguments.skeleton,
                                           arguments.music});
        !checked) {
        return fail(std::move(checked.error()));
    }
    // A .toml is a written dance, all else is captured.
    if (arguments.clips.size() == 1 && arguments.clips.front().extension() == ".toml") {
        if (!arguments.propose.empty() || arguments.once) {
            say("--propose and --once are for clips; a written dance says where its figures are");
            return kExitUsage;
        }
        return train_authored(arguments);
    }
    if (!arguments.propose.empty()) {
        return propose_figure(arguments);
    }
    const auto dance = dance_of(arguments);
    if (!dance) {
        return fail(dance.error());
    }
    const auto destination = destination_of(arguments.output, *dance);
    if (!destination) {
        return fail(destination.error());
    }
    // Checked before the training, which takes long; a folder is only added to.
    if (!destination->file.empty()) {
        std::vector<Path> inputs = inputs_of(arguments);
        inputs.push_back(arguments.music);
        if (auto checked = check_output(destination->file, inputs); !checked) {
            return fail(std::move(checked.error()));
        }
    }
    auto known = figure_plan(arguments, *dance);
    if (!known) {
        return fail(std::move(known.error()));
    }
    motion::FigureTrainingPlan& plan = *known;
    // They become parts of file names: said before the training, not after it.
    for (const std::string* const name : {&plan.dance, &plan.figure}) {
        if (!is_plain_name(*name)) {
            return fail(why_no_plain_name(*name));
        }
    }
    if (!arguments.music.empty()) {
        if (auto taken = take_counts(arguments, plan); !taken) {
            return fail(std::move(taken.error()));
        }
    }
    // What the search said of the clips already, which are read again to be learnt from.
    std::vector<std::string> said;
    if (arguments.labels.empty()) {
        const auto found = found_in_clips(arguments, plan);
        if (!found) {
            return fail(found.error());
        }
        said = found->warnings;
        plan.found = found->labels(plan);
        if (arguments.states == 0) {
            plan.states = states_of(*found, arguments.once);
        }
        print_text(found_lines(*found));
    }
    const auto report = motion::train_figure(plan);
    if (!report) {
        return fail(report.error());
    }
    // What the person should know about clips and model; none of it prevents the training.
    for (const std::string& warning : report->warnings) {
        if (std::find(said.begin(), said.end(), warning) == said.end()) {
            say(warning);
        }
    }
    // Repeats that were used weigh the figure in a new grammar.
    const auto used = std::count_if(report->repeats.begin(),
                                    report->repeats.end(),
                                    [](const auto& use) { return use.left_out.empty(); });
    const engine::LearntFigure figure{&report->model, static_cast<double>(used)};
    if (auto done = deliver(*destination, info_of(report->model, arguments), {&figure, 1}); !done) {
        return fail(std::move(done.error()));
    }
    // The path that the model was written to, for the line below.
    const Path path = !destination->file.empty() ? destination->file
                                                 : engine::figure_path(destination->folder,
                                                                       report->model.dance,
                                                                       report->model.name,
                                                                       report->model.role,
                                                                       report->model.features);
    print_text(fmt::format("{}: {} of {} repeats; log-likelihood a sample: {}\n",
                           printable(path.string()),
                           used,
                           report->repeats.size(),
                           listed_likelihoods(report->model.features, report->log_likelihood)));
    return kExitDone;
}

}  // namespace raks::apps
