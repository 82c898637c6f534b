#include "engine/trials/trained_figures.hpp"

#include <filesystem>
#include <utility>

#include "base/file.hpp"
#include "engine/setup/dance_folder.hpp"
#include "motion/cells/cell_file.hpp"

namespace raks::engine {

namespace fs = std::filesystem;

motion::JudgedLandings judged_landings(bool is_of_cells) {
    motion::JudgedLandings judged;
    if (is_of_cells) {
        judged.farthest = motion::kFarLanding;
    }
    return judged;
}

Expected<std::vector<motion::FigureModel>> trained_figures(const CatalogueEntry& dance,
                                                           motion::DanceRole role,
                                                           const DanceForm& form) {
    if (is_of_cells(dance, role, form)) {
        if (role == motion::DanceRole::follow) {
            return fail(dance.info.name + " is danced alone");
        }
        auto cells = motion::load_cells(cells_path(dance.folder, dance.info.name));
        if (!cells) {
            return fail(std::move(cells.error()));
        }
        return std::move(cells->takes);
    }
    const std::string role_name(motion::kRoleNames[static_cast<std::size_t>(role)]);
    // "_lead.json" does not match "..._lead_positions.json": the two kinds are told apart by the
    // end.
    const std::string end =
        "_" + role_name +
        (form.features == motion::FigureFeatures::positions ? "_positions.json" : ".json");
    auto files = list_folder(dance.folder);
    if (!files) {
        return fail(std::move(files.error()));
    }
    // All files of the dance, not only those that its grammar uses.
    std::erase_if(*files, [&](const fs::path& file) {
        const std::string name = file.filename().string();
        return !name.starts_with(dance.info.name + "_") || !name.ends_with(end);
    });
    if (files->empty()) {
        return fail(dance.folder.string() + ": holds no figure of " + dance.info.name +
                    " for the " + role_name);
    }
    std::vector<motion::FigureModel> figures;
    for (const fs::path& file : *files) {
        auto figure = motion::load_figure(file);
        if (!figure) {
            return fail(std::move(figure.error()));
        }
        figures.push_back(std::move(*figure));
    }
    return figures;
}

}  // namespace raks::engine
