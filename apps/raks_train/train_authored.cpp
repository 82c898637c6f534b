// `raks train figure dance.toml`: the figures of a written dance, learnt as captured ones are.
#include <string>
#include <utility>
#include <vector>

#include "apps/dances/written_dance.hpp"
#include "apps/raks_train/destination.hpp"
#include "apps/raks_train/likelihoods.hpp"
#include "apps/raks_train/train_commands.hpp"
#include "apps/terminal/say.hpp"
#include "base/printable.hpp"
#include "engine/setup/dance_folder.hpp"
#include "motion/choreography/authored_dance.hpp"
#include "motion/figures/figure_model.hpp"

#include <fmt/format.h>

namespace raks::apps {
namespace {

// Warns of beats at which both feet are in the air, which the writer may not have meant.
void tell_hops(const motion::AuthoredDance& dance, const motion::AuthoredFigure& figure) {
    std::string hops;
    for (const motion::Hop& hop : motion::hops_of(figure)) {
        hops += fmt::format(" {:.2f}-{:.2f}", hop.from, hop.to);
    }
    if (!hops.empty()) {
        say(fmt::format("{}: both feet are in the air at beats{}", where_in(dance, figure), hops));
    }
}

// One line a figure: where it is, its size and how well the model fits it.
void print_figure(const Destination& destination, const motion::AuthoredTrainingResult& trained) {
    const motion::FigureModel& model = trained.model;
    const Path path =
        !destination.file.empty()
            ? destination.file
            : engine::figure_path(
                  destination.folder, model.dance, model.name, model.role, model.features);
    print_text(fmt::format("{}: {} beats, {} repeats, {} states; log-likelihood a sample: {}\n",
                           printable(path.string()),
                           model.beats,
                           trained.repeats,
                           model.part(motion::Part::upper).states.size(),
                           listed_likelihoods(model.features, trained.log_likelihood)));
}

}  // namespace

ExitCode train_authored(const TrainFigureArguments& arguments) {
    auto dance = motion::load_authored_dance(arguments.clips.front());
    if (!dance) {
        return fail(dance.error());
    }
    // Found before the training, so that a bad -o fails at once.
    const auto destination = destination_of(arguments.output, dance->dance);
    if (!destination) {
        return fail(destination.error());
    }
    // One model for one file: a dance of several figures needs --figure then.
    const std::size_t wanted = arguments.figure.empty() ? dance->figures.size() : 1;
    if (!destination->file.empty() && wanted > 1) {
        return fail(fmt::format("{}: has {} figures; name one with --figure, or give -o a folder",
                                dance->file,
                                wanted));
    }
    // The models carry the name that they are found by: the extended dance's, or the name given by
    // -o.
    if (!arguments.extends.empty()) {
        dance->dance = arguments.extends;
    } else if (!destination->name.empty()) {
        dance->dance = destination->name;
    }
    motion::AuthoredTrainingOptions options;
    options.states = arguments.states;
    options.features = arguments.features;
    auto learnt = learn_figures(
        *dance,
        arguments.figure,
        motion::mannequin_skeleton(),
        options,
        [&](const motion::AuthoredFigure& figure, const auto&) { tell_hops(*dance, figure); });
    if (!learnt) {
        return fail(std::move(learnt.error()));
    }
    // A written dance does not say how often a figure occurs: all have the same weight.
    std::vector<engine::LearntFigure> figures;
    if (!destination->file.empty()) {
        // One file, one model: that of the role that was asked for.
        std::erase_if(*learnt, [&](const motion::AuthoredTrainingResult& trained) {
            return trained.model.role != arguments.role;
        });
    }
    for (const motion::AuthoredTrainingResult& trained : *learnt) {
        figures.push_back({&trained.model, 1.0});
    }
    DanceInfo info = info_of(*dance);
    info.extends = arguments.extends;
    // Written first: the lines below name files that are there.
    if (auto delivered = deliver(*destination, info, figures, grammar_of(*dance)); !delivered) {
        return fail(std::move(delivered.error()));
    }
    for (const motion::AuthoredTrainingResult& trained : *learnt) {
        print_figure(*destination, trained);
    }
    return kExitDone;
}

}  // namespace raks::apps
