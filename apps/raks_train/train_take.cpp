// `raks train take`: whole takes with labelled beats become a dance of cells.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "apps/raks_train/destination.hpp"
#include "apps/raks_train/take_proposal.hpp"
#include "apps/raks_train/train_commands.hpp"
#include "apps/terminal/say.hpp"
#include "base/dance_list.hpp"
#include "base/file.hpp"
#include "training/cells/cell_training.hpp"

namespace raks::apps {
namespace {

// What a person is told: what was used of each take, what was not, and how it hangs together.
void say_report(const motion::CellTrainingReport& report) {
    for (const std::string& warning : report.warnings) {
        say(warning);
    }
    for (const motion::TakeUse& use : report.takes) {
        say(fmt::format("{}: {} of {} beats are danced; {} idle, {} too short or too long",
                        use.take,
                        use.cells,
                        use.labelled,
                        use.idle,
                        use.odd));
    }
    const motion::CellGraph& graph = report.dance.graph;
    say(fmt::format(
        "{} cells, {:.1f} arcs each; {} more hang together with nothing",
        graph.cells.size(),
        static_cast<double>(graph.arcs.size()) / static_cast<double>(graph.cells.size()),
        report.apart));
}

// The dances.toml entry of a dance that is new: a beat may be a quarter shorter or a third longer.
DanceInfo info_of(const motion::CellDance& dance) {
    DanceInfo info;
    info.name = info.title = dance.dance;
    const double tempo = 60.0 / dance.graph.beat_seconds;
    info.lowest = Bpm(std::round(0.75 * tempo));
    info.highest = Bpm(std::round(1.33 * tempo));
    info.likely = Bpm(std::round(tempo));
    return info;
}

}  // namespace

ExitCode train_take(const TrainTakeArguments& arguments) {
    if (!arguments.propose.empty()) {
        return propose_take(arguments);
    }
    if (arguments.counts.empty() || arguments.output.empty()) {
        complain("give --counts T.tsv and -o NAME, or --propose X.tsv for beats to begin with");
        return kExitUsage;
    }
    const auto destination = destination_of(arguments.output, "");
    if (!destination) {
        return fail(destination.error());
    }
    const auto beats = motion::load_take_beats(arguments.counts);
    if (!beats) {
        return fail(beats.error());
    }
    motion::CellTrainingPlan plan;
    plan.clips = arguments.clips;
    plan.beats = *beats;
    plan.dance = destination->name.empty() ? arguments.dance : destination->name;
    if (!is_dance_name(plan.dance)) {
        return fail("give the dance a name: --dance NAME");
    }
    plan.licence = arguments.licence;
    const motion::BodyOptions body = arguments.body.options();
    plan.units.up = body.up;
    plan.units.metres_per_unit = body.metres_per_unit;
    plan.units.height = body.height;
    const auto report = motion::train_cells(plan);
    if (!report) {
        return fail(report.error());
    }
    say_report(*report);
    if (auto added =
            engine::add_to_folder(destination->folder, info_of(report->dance), report->dance);
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
