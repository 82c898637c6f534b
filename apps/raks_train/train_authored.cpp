// `raks train figure dance.toml`: the figures of a written dance, learnt as captured ones are.
#include <cstdio>
#include <filesystem>
#include <string>
#include <string_view>
#include <system_error>
#include <vector>

#include "apps/raks_train/commands.hpp"
#include "apps/raks_train/likelihoods.hpp"
#include "apps/terminal/say.hpp"
#include "base/suggest.hpp"
#include "motion/choreography/authored_dance.hpp"
#include "motion/figures/figure_model.hpp"
#include "training/figures/authored_training.hpp"

#include <fmt/format.h>

namespace raks::apps {
namespace {

/// The figure that is asked for, or all.
Expected<std::vector<const motion::AuthoredFigure*>> wanted_figures(
    const motion::AuthoredDance& dance, const std::string& name) {
    std::vector<const motion::AuthoredFigure*> figures;
    std::vector<std::string_view> names;
    for (const motion::AuthoredFigure& figure : dance.figures) {
        names.push_back(figure.name);
        if (name.empty() || figure.name == name) {
            figures.push_back(&figure);
        }
    }
    if (figures.empty()) {
        return fail(dance.file + ": " + unknown_name("figure", name, names));
    }
    return figures;
}

/// A file as named; in a folder by the name under which the dancer finds its figure.
Path model_path(const Path& output, const motion::FigureModel& model) {
    if (output.extension() == ".json") {
        return output;
    }
    const bool is_of_positions = model.features == motion::FigureFeatures::positions;
    return output /
           fmt::format(
               "{}_{}_lead{}.json", model.dance, model.name, is_of_positions ? "_positions" : "");
}

/// Steps with both feet in the air, which the writer may not have meant.
void tell_hops(const motion::AuthoredDance& dance, const motion::AuthoredFigure& figure) {
    std::string hops;
    for (const motion::Hop& hop : motion::hops_of(figure)) {
        hops += fmt::format(" {:.2f}-{:.2f}", hop.from, hop.to);
    }
    if (!hops.empty()) {
        say(fmt::format("{}: both feet are in the air at beats{}", where_in(dance, figure), hops));
    }
}

}  // namespace

ExitCode train_authored(const TrainFigureArguments& arguments) {
    const auto dance = motion::load_authored_dance(arguments.clips.front());
    if (!dance) {
        return fail(dance.error());
    }
    const auto figures = wanted_figures(*dance, arguments.figure);
    if (!figures) {
        return fail(figures.error());
    }
    const bool is_folder = arguments.output.extension() != ".json";
    if (!is_folder && figures->size() > 1) {
        return fail(fmt::format("{}: has {} figures; name one with --figure, or give -o a folder",
                                dance->file,
                                figures->size()));
    }
    motion::AuthoredTrainingOptions options;
    options.states = arguments.states;
    options.features = arguments.features == "positions" ? motion::FigureFeatures::positions
                                                         : motion::FigureFeatures::angles;
    for (const motion::AuthoredFigure* const figure : *figures) {
        tell_hops(*dance, *figure);
        const auto trained =
            motion::train_authored_figure(*dance, *figure, motion::mannequin_skeleton(), options);
        if (!trained) {
            return fail(trained.error());
        }
        if (is_folder) {
            std::error_code problem;  // what is wrong shows when the file is written
            std::filesystem::create_directories(arguments.output, problem);
        }
        const Path path = model_path(arguments.output, trained->model);
        if (auto saved = motion::save_figure(trained->model, path); !saved) {
            return fail(saved.error());
        }
        std::fputs(fmt::format("{}: {} beats, {} repeats, {} states; log-likelihood a sample: {}\n",
                               path.string(),
                               trained->model.beats,
                               trained->repeats,
                               trained->model.part(motion::Part::upper).states.size(),
                               listed_likelihoods(options.features, trained->log_likelihood))
                       .c_str(),
                   stdout);
    }
    return kExitDone;
}

}  // namespace raks::apps
