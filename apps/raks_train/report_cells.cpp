// `raks train report` of a dance of cells: how its takes hang together.
#include <string>
#include <utility>

#include "apps/raks_train/train_commands.hpp"
#include "apps/reports/cell_report_page.hpp"
#include "apps/terminal/say.hpp"
#include "base/file.hpp"
#include "base/pending_file.hpp"
#include "engine/setup/dance_catalogue.hpp"
#include "engine/setup/dance_folder.hpp"
#include "motion/cells/cell_file.hpp"
#include "motion/cells/cell_survey.hpp"

#include <fmt/format.h>

namespace raks::apps {
namespace {

// The lines that are printed.
std::string summary_of(const motion::CellDance& dance, const motion::CellSurvey& survey) {
    const motion::CellGraph& graph = dance.graph;
    const auto cells = static_cast<double>(graph.cells.size());
    std::string text = fmt::format(
        "{}: {} cells of {} {}, {:.1f} arcs each; {} reach each other\n"
        "rests {}, endings {}, of the greatest {}\n",
        dance.dance,
        graph.cells.size(),
        graph.takes.size(),
        graph.takes.size() == 1 ? "take" : "takes",
        static_cast<double>(graph.arcs.size()) / cells,
        survey.connected,
        survey.rest.cells,
        survey.ending.cells,
        survey.greatest.cells);
    for (const auto& [kind, name] : {std::pair(&survey.rest, "a rest"),
                                     {&survey.ending, "an ending"},
                                     {&survey.greatest, "one of the greatest"}}) {
        if (kind->cells > 0 && kind->far + kind->cut_off > 0) {
            text += fmt::format("{} cells are more than {} beats from {}\n",
                                kind->far + kind->cut_off,
                                motion::kBeatsToKind,
                                name);
        }
    }
    return text;
}

// The file of a folder's dance: of the one that is named, else of the first that has one. Empty:
// it has none.
Path cells_in(const Path& folder, const std::string& dance) {
    const auto catalogue = engine::DanceCatalogue::load(folder);
    if (!catalogue) {
        return {};
    }
    for (const engine::CatalogueEntry& entry : catalogue->entries()) {
        if (entry.origin == engine::DanceOrigin::given && entry.has_cells &&
            (dance.empty() || entry.info.name == dance)) {
            return engine::cells_path(entry.folder, entry.info.name);
        }
    }
    return {};
}

}  // namespace

Path cell_dance_of(const TrainReportArguments& arguments) {
    if (arguments.clips.size() != 1 || !arguments.labels.empty()) {
        return {};
    }
    const Path& place = arguments.clips.front();
    if (place.extension() == ".cells") {
        return place;
    }
    return is_there(engine::dances_path(place)) ? cells_in(place, arguments.dance) : Path();
}

ExitCode report_cells(const Path& file, const Path& output) {
    const auto dance = motion::load_cells(file);
    if (!dance) {
        return fail(dance.error());
    }
    const motion::CellSurvey survey = motion::survey(dance->graph);
    if (auto written = write_file(output, draw_cell_report(*dance, survey)); !written) {
        return fail(std::move(written.error()));
    }
    print_text(summary_of(*dance, survey));
    return kExitDone;
}

}  // namespace raks::apps
