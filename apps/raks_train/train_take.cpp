// `raks train take`: whole takes with labelled beats become a dance of cells.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <string>
#include <thread>
#include <vector>

#include "apps/raks_train/destination.hpp"
#include "apps/raks_train/take_proposal.hpp"
#include "apps/raks_train/train_commands.hpp"
#include "apps/terminal/say.hpp"
#include "base/dance_list.hpp"
#include "base/file.hpp"
#include "training/cells/cell_training.hpp"

namespace raks::apps {
namespace {

// What became of a take's beats: "5 of 9 beats are danced; 3 idle, 1 not used".
std::string said_of(const motion::TakeUse& use) {
    std::string text = fmt::format("{}: {} of {} beats are danced",
                                   use.take,
                                   use.count(motion::BeatFate::danced),
                                   use.labelled());
    const char* before = "; ";
    for (std::size_t fate = 1; fate < use.beats.size(); ++fate) {
        if (use.beats[fate] > 0) {
            text += fmt::format("{}{} {}", before, use.beats[fate], motion::kBeatFateNames[fate]);
            before = ", ";
        }
    }
    if (use.laid > 0) {
        text += fmt::format("; {} were given arms of other beats", use.laid);
    }
    return text;
}

// What the dance lacks.
void say_missing(const motion::CellTrainingReport& report) {
    if (!report.has_rests) {
        say("too few cells come to rest on both feet: no cell needs to lead to a hold");
    } else if (!report.has_endings) {
        say("too few cells come to rest on the first beat of a half bar: no cell needs to lead to "
            "an ending");
    }
    if (!(report.people_jerk_rms > 0.0)) {
        say("people's jerk is not known: no take has 50 frames a second");
    }
}

// What a person is told: what was used of each take, what was not, and how it hangs together.
void say_report(const motion::CellTrainingReport& report) {
    for (const std::string& warning : report.warnings) {
        say(warning);
    }
    for (const motion::TakeUse& use : report.takes) {
        say(said_of(use));
    }
    const motion::CellGraph& graph = report.dance.graph;
    std::size_t rests = 0;
    std::size_t endings = 0;
    for (std::size_t cell = 0; cell < graph.cells.size(); ++cell) {
        rests += motion::is_rest(graph, cell) ? 1U : 0U;
        endings += motion::is_ending(graph, cell) ? 1U : 0U;
    }
    say(fmt::format(
        "{} cells, {:.1f} arcs each, {} of all wider than others to keep cells together; "
        "{} come to rest, {} as endings",
        graph.cells.size(),
        static_cast<double>(graph.arcs.size()) / static_cast<double>(graph.cells.size()),
        report.wide_joins,
        rests,
        endings));
    say(fmt::format("{} cells are repeats of {}; {} of {} states are shared",
                    report.tied_cells,
                    report.figures,
                    report.tied_states,
                    graph.cells.size() * std::size_t{motion::kStatesPerBeat}));
    if (report.landings > 0) {
        say(fmt::format(
            "{} of {} landings ({:.0f} %) lie further than {:g} beat from a beat",
            report.far_landings,
            report.landings,
            100.0 * static_cast<double>(report.far_landings) / static_cast<double>(report.landings),
            motion::kFarLanding));
    }
    say_missing(report);
}

// The dances.toml entry of a dance that is new: a beat may be a quarter shorter or a third longer.
DanceInfo info_of(const motion::CellTrainingReport& report) {
    DanceInfo info;
    info.name = info.title = report.dance.dance;
    const double tempo = 60.0 / report.dance.graph.beat_seconds;
    info.lowest = Bpm(std::round(0.75 * tempo));
    info.highest = Bpm(std::round(1.33 * tempo));
    info.likely = Bpm(std::round(tempo));
    // A tenth is more than is known.
    const auto rounded = [](double jerk) { return std::round(10.0 * jerk) / 10.0; };
    info.people_jerk_rms.fill(rounded(report.people_jerk_rms));
    info.people_jerk_p999.fill(rounded(report.people_jerk_p999));
    return info;
}

// The beats of a person's table, else those of the song.
Expected<std::vector<motion::TakeBeat>> beats_of(const TrainTakeArguments& arguments) {
    if (!arguments.counts.empty()) {
        return motion::load_take_beats(arguments.counts);
    }
    const auto table = beats_by_song(arguments);
    return table ? motion::parse_take_beats(*table, arguments.music.string()) : fail(table.error());
}

}  // namespace

ExitCode train_take(const TrainTakeArguments& arguments) {
    if (!arguments.propose.empty()) {
        return propose_take(arguments);
    }
    if ((arguments.counts.empty() && arguments.music.empty()) || arguments.output.empty()) {
        complain(
            "give --counts T.tsv, or --music SONG, and -o NAME; or --propose X.tsv for beats to "
            "begin with");
        return kExitUsage;
    }
    const auto destination = destination_of(arguments.output, "");
    if (!destination) {
        return fail(destination.error());
    }
    const auto beats = beats_of(arguments);
    if (!beats) {
        return fail(beats.error());
    }
    motion::CellTrainingPlan plan;
    plan.clips = arguments.clips;
    plan.beats = *beats;
    plan.without = arguments.without;
    plan.lays_arms = arguments.lays_arms;
    plan.threads = std::max(1, static_cast<int>(std::thread::hardware_concurrency()));
    plan.dance = destination->name.empty() ? arguments.dance : destination->name;
    if (!is_dance_name(plan.dance)) {
        return fail("give the dance a name: --dance NAME");
    }
    plan.licence = arguments.licence;
    const motion::BodyOptions body = arguments.body.options();
    plan.units.up = body.up;
    plan.units.metres_per_unit = body.metres_per_unit;
    plan.units.height = body.height;
    plan.units.reading.arm_angle = arguments.body.arm_angle;
    const auto report = motion::train_cells(plan);
    if (!report) {
        return fail(report.error());
    }
    say_report(*report);
    if (auto added = engine::add_to_folder(destination->folder, info_of(*report), report->dance);
        !added) {
        return fail(added.error());
    }
    say(fmt::format("{} lies in {}", plan.dance, destination->folder.string()));
    if (is_there(engine::grammar_path(destination->folder, plan.dance))) {
        say(fmt::format("{} has figures, too: --material written dances them", plan.dance));
    }
    return kExitDone;
}

}  // namespace raks::apps
