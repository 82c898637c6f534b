#include "apps/raks_train/train_commands.hpp"

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "apps/clips/clip_reading.hpp"
#include "apps/dances/tracked_counts.hpp"
#include "apps/raks_train/destination.hpp"
#include "apps/raks_train/found_repeats.hpp"
#include "apps/raks_train/likelihoods.hpp"
#include "apps/terminal/say.hpp"
#include "base/dance_list.hpp"
#include "base/pending_file.hpp"
#include "base/plain_name.hpp"
#include "base/printable.hpp"
#include "base/statistics.hpp"
#include "engine/setup/dance_folder.hpp"
#include "motion/figures/figure_model.hpp"
#include "training/discovery/phrase_discovery.hpp"
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
    plan.travel = arguments.travel;
    plan.reading.arm_angle = arguments.body.arm_angle;
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
    std::vector<Path> inputs = {clips.labels, clips.counts, clips.faults};
    for (const Path& clip : clips.clips) {
        inputs.push_back(motion::clip_address(clip).file);
    }
    return inputs;
}

namespace {

// The name that `-o` gives: NAME, or that of X.json or of a folder; empty: none.
std::string name_of_output(const std::string& output) {
    const Path path(output);
    const Path last = path.has_filename() ? path : path.parent_path();
    const std::string stem =
        last.extension() == ".json" ? last.stem().string() : last.filename().string();
    return stem == "." || stem == ".." ? std::string() : stem;
}

// The dance of a figure from clips: as --extends or --dance say, as the output is called, or as the
// clip is called, in this order.
std::string dance_of(const TrainFigureArguments& arguments) {
    // A figure that extends a dance is of that dance, whatever --dance says.
    for (const std::string& told : {arguments.extends, arguments.dance}) {
        if (!told.empty()) {
            return told;
        }
    }
    const std::string output = name_of_output(arguments.output);
    return made_dance_name(output.empty() ? motion::take_name(arguments.clips.front()) : output);
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

// States for figures of so many beats: as many a beat as a captured figure of 8 beats has; of a
// phrase danced once more, for there the states are the motion itself.
int states_of(int beats, bool is_once) {
    constexpr int kCaptured = 2;
    constexpr int kOnce = 4;
    return (is_once ? kOnce : kCaptured) * std::max(beats, 8);
}

int states_of(const motion::DiscoveredClips& found) {
    int beats = 0;
    for (const motion::DiscoveredClip& clip : found.clips) {
        beats = std::max(beats, clip.found.beats);
    }
    return states_of(beats, false);
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

// Learns one figure by a plan whose labels are there. `said`: what the search said of the clips
// already, which are read again to be learnt from.
Expected<motion::FigureTrainingReport> learn(const motion::FigureTrainingPlan& plan,
                                             const std::vector<std::string>& said) {
    auto report = motion::train_figure(plan);
    if (!report) {
        return report;
    }
    // What the person should know about clips and model; none of it prevents the training.
    for (const std::string& warning : report->warnings) {
        if (std::find(said.begin(), said.end(), warning) == said.end()) {
            say(warning);
        }
    }
    return report;
}

// What was learnt of one figure, and how it stands among the others.
struct Learnt {
    motion::FigureTrainingReport report;
    double seen = 1.0;  // as engine::LearntFigure has it
    std::string next{};
};

// Repeats that were used weigh the figure in a new grammar.
double repeats_used(const motion::FigureTrainingReport& report) {
    return static_cast<double>(std::count_if(report.repeats.begin(),
                                             report.repeats.end(),
                                             [](const auto& use) { return use.left_out.empty(); }));
}

// The dances.toml entry of a dance that has these figures: its tempi lie around those learnt.
DanceInfo info_of(const std::vector<Learnt>& learnt, const TrainFigureArguments& arguments) {
    // Share of the learnt tempo by which the dance's range reaches to either side.
    constexpr double kReach = 0.2;
    std::vector<double> tempi;
    tempi.reserve(learnt.size());
    for (const Learnt& one : learnt) {
        // So that the range around it stays within what a dances.toml may say (20 to 400 BPM).
        tempi.push_back(std::clamp(one.report.model.learnt_tempo.bpm(), 25.0, 330.0));
    }
    DanceInfo info;
    info.name = info.title = learnt.front().report.model.dance;
    info.extends = arguments.extends;
    info.beats_per_bar = arguments.beats_per_bar;
    info.lowest = Bpm(std::round((1.0 - kReach) * *std::min_element(tempi.begin(), tempi.end())));
    info.highest = Bpm(std::round((1.0 + kReach) * *std::max_element(tempi.begin(), tempi.end())));
    info.likely = Bpm(std::round(upper_median(std::move(tempi))));
    return info;
}

// A name for the figures of a clip that those of no other one have.
std::string figure_of(const std::string& take, std::vector<std::string>& taken) {
    const std::string plain = made_dance_name(take);
    std::string name = plain;
    for (int number = 2; std::find(taken.begin(), taken.end(), name) != taken.end(); ++number) {
        name = fmt::format("{}_{}", plain, number);
    }
    taken.push_back(name);
    return name;
}

// The clip as one figure, or, where it is too long, as several that follow one another.
Expected<void> learn_phrase(const TrainFigureArguments& arguments,
                            const motion::FigureTrainingPlan& plan,
                            const motion::DiscoveredClip& clip,
                            const std::vector<std::string>& said,
                            std::vector<Learnt>& learnt) {
    const auto parts = motion::phrase_parts(clip.found, arguments.beats_per_bar);
    const auto name_of = [&](std::size_t part) {
        return parts.size() == 1 ? plan.figure : fmt::format("{}_{}", plan.figure, part + 1);
    };
    if (parts.size() > 1) {
        say(fmt::format("{}: its {} beats become {} figures, {} to {}, danced in this order",
                        printable(clip.take),
                        clip.found.beats,
                        parts.size(),
                        name_of(0),
                        name_of(parts.size() - 1)));
    }
    for (std::size_t i = 0; i < parts.size(); ++i) {
        motion::FigureTrainingPlan own = plan;
        own.clips = {clip.file};
        own.figure = name_of(i);
        own.found = motion::labels_of(parts[i], clip.take, own.figure, plan.role);
        if (arguments.states == 0) {
            own.states = states_of(parts[i].beats, true);
        }
        auto report = learn(own, said);
        if (!report) {
            return fail(std::move(report.error()));
        }
        // The later parts come after the one before alone.
        learnt.push_back({std::move(*report),
                          i == 0 ? 1.0 : 0.0,
                          i + 1 < parts.size() ? name_of(i + 1) : std::string()});
    }
    return {};
}

// The figures of each clip; `is_file`: they go into one file.
Expected<std::vector<Learnt>> learn_phrases(const TrainFigureArguments& arguments,
                                            const motion::FigureTrainingPlan& plan,
                                            const motion::DiscoveredClips& found,
                                            bool is_file) {
    std::size_t figures = 0;
    for (const motion::DiscoveredClip& clip : found.clips) {
        figures += motion::phrase_parts(clip.found, arguments.beats_per_bar).size();
    }
    if (figures > 1 && is_file) {
        return fail(
            fmt::format("{}: a file holds one figure, of {} beats at most, and these are "
                        "{}: give -o a folder or a name",
                        arguments.output,
                        motion::kMostFigureBeats,
                        figures));
    }
    std::vector<Learnt> learnt;
    std::vector<std::string> taken;
    for (const motion::DiscoveredClip& clip : found.clips) {
        motion::FigureTrainingPlan own = plan;
        own.figure = figure_of(arguments.figure.empty() ? clip.take : arguments.figure, taken);
        if (auto done = learn_phrase(arguments, own, clip, found.warnings, learnt); !done) {
            return fail(std::move(done.error()));
        }
    }
    return learnt;
}

// The figure of clips with labels, or in which repeats were found; of --once those of each clip.
Expected<std::vector<Learnt>> learn_figures(const TrainFigureArguments& arguments,
                                            motion::FigureTrainingPlan& plan,
                                            bool is_file,
                                            bool& has_skipped) {
    std::vector<std::string> said;
    if (arguments.labels.empty()) {
        const auto found = found_in_clips(arguments, plan);
        if (!found) {
            return fail(found.error());
        }
        has_skipped = !found->skipped.empty();
        if (arguments.once) {
            print_text(found_lines(*found));
            return learn_phrases(arguments, plan, *found, is_file);
        }
        if (found->good() < motion::kFewestRepeats) {
            return fail(
                fmt::format("{}, and a figure needs {}: nothing is learnt; --once learns "
                            "the whole clip as one dance, raks train take beat by beat",
                            few_alike(*found),
                            motion::kFewestRepeats));
        }
        print_text(found_lines(*found));
        said = found->warnings;
        plan.found = found->labels(plan);
        if (arguments.states == 0) {
            plan.states = states_of(*found);
        }
    }
    auto report = learn(plan, said);
    if (!report) {
        return fail(std::move(report.error()));
    }
    const double seen = repeats_used(*report);
    std::vector<Learnt> learnt;
    learnt.push_back({std::move(*report), seen});
    return learnt;
}

// A line for each figure: where its model is, and how well it was learnt.
void print_learnt(const Destination& destination, const std::vector<Learnt>& learnt) {
    for (const Learnt& one : learnt) {
        const motion::FigureTrainingReport& report = one.report;
        const Path path = !destination.file.empty() ? destination.file
                                                    : engine::figure_path(destination.folder,
                                                                          report.model.dance,
                                                                          report.model.name,
                                                                          report.model.role,
                                                                          report.model.features);
        print_text(fmt::format("{}: {} of {} repeats; log-likelihood a sample: {}\n",
                               printable(path.string()),
                               repeats_used(report),
                               report.repeats.size(),
                               listed_likelihoods(report.model.features, report.log_likelihood)));
    }
}

// Everything that can be wrong before the training, which takes long.
Expected<motion::FigureTrainingPlan> checked_plan(const TrainFigureArguments& arguments,
                                                  const std::string& dance,
                                                  const Destination& destination) {
    // A folder is only added to.
    if (!destination.file.empty()) {
        std::vector<Path> inputs = inputs_of(arguments);
        inputs.push_back(arguments.music);
        if (auto checked = check_output(destination.file, inputs); !checked) {
            return fail(std::move(checked.error()));
        }
    }
    auto plan = figure_plan(arguments, dance);
    if (!plan) {
        return plan;
    }
    // They become parts of file names.
    for (const std::string* const name : {&plan->dance, &plan->figure}) {
        if (!is_plain_name(*name)) {
            return fail(why_no_plain_name(*name));
        }
    }
    if (!arguments.music.empty()) {
        if (auto taken = take_counts(arguments, *plan); !taken) {
            return fail(std::move(taken.error()));
        }
    }
    return plan;
}

ExitCode train_captured(const TrainFigureArguments& arguments) {
    const std::string dance = dance_of(arguments);
    const auto destination = destination_of(arguments.output, dance);
    if (!destination) {
        return fail(destination.error());
    }
    auto plan = checked_plan(arguments, dance, *destination);
    if (!plan) {
        return fail(std::move(plan.error()));
    }
    bool has_skipped = false;
    const auto learnt = learn_figures(arguments, *plan, !destination->file.empty(), has_skipped);
    if (!learnt) {
        return fail(learnt.error());
    }
    std::vector<engine::LearntFigure> figures;
    for (const Learnt& one : *learnt) {
        figures.push_back({&one.report.model, one.seen, one.next});
    }
    engine::NewGrammar grammar;
    if (arguments.once) {
        // A clip begins as it does, and each part of a long one where the one before ended.
        grammar.starts = motion::FigureGrammar::Starts::own;
    }
    if (auto done = deliver(*destination, info_of(*learnt, arguments), figures, grammar); !done) {
        return fail(std::move(done.error()));
    }
    print_learnt(*destination, *learnt);
    return has_skipped ? kExitPartly : kExitDone;
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
    if (!arguments.once && arguments.beats > motion::kMostFigureBeats) {
        say(fmt::format("--beats: a repeat has {} beats at most; of all of a clip (--once) {}",
                        motion::kMostFigureBeats,
                        kLongestPhrase));
        return kExitUsage;
    }
    // A .toml is a written dance, all else is captured.
    if (arguments.clips.size() == 1 && arguments.clips.front().extension() == ".toml") {
        if (!arguments.propose.empty() || arguments.once) {
            say("--propose and --once are for clips; a written dance says where its figures are");
            return kExitUsage;
        }
        return train_authored(arguments);
    }
    return arguments.propose.empty() ? train_captured(arguments) : propose_figure(arguments);
}

}  // namespace raks::apps
