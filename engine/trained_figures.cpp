#include "engine/trained_figures.hpp"

#include <algorithm>
#include <filesystem>
#include <system_error>
#include <utility>

#include "engine/settings.hpp"

namespace raks::engine {

namespace fs = std::filesystem;

Expected<std::vector<motion::FigureModel>> trained_figures(const std::string& dance,
                                                           motion::DanceRole role,
                                                           motion::FigureFeatures features) {
    const auto folder = data_path(fs::path("models") / "trained");
    if (!folder) {
        return fail(folder.error());
    }
    const std::string role_name(motion::kRoleNames[static_cast<std::size_t>(role)]);
    const std::string end =
        "_" + role_name +
        (features == motion::FigureFeatures::positions ? "_positions.json" : ".json");
    std::vector<fs::path> files;
    std::error_code error;
    for (fs::directory_iterator entry(*folder, error); !error && entry != fs::directory_iterator();
         entry.increment(error)) {
        const std::string name = entry->path().filename().string();
        if (name.starts_with(dance + "_") && name.ends_with(end)) {
            files.push_back(entry->path());
        }
    }
    if (error) {
        return fail(folder->string() + ": cannot be listed: " + error.message());
    }
    if (files.empty()) {
        return fail(folder->string() + ": holds no figure of " + dance + " for the " + role_name);
    }
    std::sort(files.begin(), files.end());
    std::vector<motion::FigureModel> figures;
    for (const fs::path& file : files) {
        auto figure = motion::load_figure(file);
        if (!figure) {
            return fail(std::move(figure.error()));
        }
        figures.push_back(std::move(*figure));
    }
    return figures;
}

}  // namespace raks::engine
