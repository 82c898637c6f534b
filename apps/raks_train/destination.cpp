#include "apps/raks_train/destination.hpp"

#include <system_error>
#include <utility>

#include "apps/terminal/say.hpp"
#include "base/file.hpp"
#include "engine/setup/dance_catalogue.hpp"
#include "motion/figures/figure_model.hpp"

#include <fmt/format.h>

namespace raks::apps {
namespace {

namespace fs = std::filesystem;

// A name of a dance has neither a '/' nor dots; an existing folder of the same name wins.
bool is_folder(const std::string& output) {
    std::error_code ignored;
    return output.find('/') != std::string::npos || output == "." || output == ".." ||
           fs::is_directory(output, ignored);
}

// Figures are not danced where there are takes, unless somebody asks for them.
void say_of_takes(const fs::path& folder, const DanceInfo& dance) {
    if (is_there(engine::cells_path(folder, dance.name))) {
        say(fmt::format("{} has takes of people, too: --material written dances its figures",
                        dance.name));
    }
}

}  // namespace

Expected<Destination> destination_of(const std::string& output, const std::string& otherwise) {
    Destination destination;
    // The three meanings of -o, the most explicit one first.
    if (fs::path(output).extension() == ".json") {
        destination.file = output;
        return destination;
    }
    if (!output.empty() && is_folder(output)) {
        destination.folder = output;
        return destination;
    }
    destination.name = output;
    const std::string& name = output.empty() ? otherwise : output;
    if (!is_dance_name(name)) {
        return fail(why_no_dance_name(name) + "; -o NAME, FOLDER/ or X.json says where it goes");
    }
    // Installed as a folder of its own among the user's dances.
    const fs::path dances = engine::user_dances_path();
    if (dances.empty()) {
        return fail(
            "there is no folder to install dances in, as HOME is not set; give -o a folder");
    }
    destination.folder = dances / name;
    destination.is_installed = true;
    return destination;
}

Expected<void> deliver(const Destination& destination,
                       const DanceInfo& dance,
                       std::span<const engine::LearntFigure> figures,
                       const engine::NewGrammar& grammar) {
    // A file holds one model.
    if (!destination.file.empty()) {
        if (figures.size() != 1) {
            return fail(
                fmt::format("{}: there are {} figures; name one with --figure, or give -o "
                            "a folder or a name",
                            destination.file.string(),
                            figures.size()));
        }
        return motion::save_figure(*figures.front().model, destination.file);
    }
    if (auto added = engine::add_to_folder(destination.folder, dance, figures, grammar); !added) {
        return added;
    }
    // The command that dances it: a folder elsewhere is named by its path.
    say(fmt::format("{} lies in {}; raks play SONG --dance {} dances it",
                    dance.name,
                    destination.folder.string(),
                    destination.is_installed ? dance.name : destination.folder.string()));
    say_of_takes(destination.folder, dance);
    return {};
}

}  // namespace raks::apps
