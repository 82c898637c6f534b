#include "engine/dance_files.hpp"

#include <algorithm>
#include <array>
#include <string_view>

#include "base/suggest.hpp"
#include "engine/settings.hpp"
#include "motion/figures/figure_grammar.hpp"
#include "motion/figures/figure_model.hpp"

#include <fmt/format.h>

namespace raks::engine {
namespace {

// models/trained/DANCE.toml is the grammar, models/trained/DANCE_FIGURE_ROLE.json the figures.
constexpr std::array<std::string_view, 1> kDances = {"salsa"};

constexpr std::string_view kAuto = "auto";

}  // namespace

std::vector<std::string> known_dances() { return {kDances.begin(), kDances.end()}; }

Expected<void> check_dance(const std::string& dance) {
    std::vector<std::string_view> known = {kAuto};
    known.insert(known.end(), kDances.begin(), kDances.end());
    if (std::find(known.begin(), known.end(), dance) == known.end()) {
        return fail(unknown_name("dance", dance, known));
    }
    return {};
}

std::string dance_to_load(const Settings& settings) {
    return settings.dance == kAuto ? settings.fallback_dance : settings.dance;
}

Expected<std::shared_ptr<const motion::DanceLibrary>> load_dance(const std::string& dance,
                                                                 motion::DanceRole role) {
    if (auto checked = check_dance(dance); !checked) {
        return fail(checked.error());
    }
    const std::filesystem::path folder = std::filesystem::path("models") / "trained";
    const auto grammar_path = data_path(folder / fmt::format("{}.toml", dance));
    if (!grammar_path) {
        return fail(grammar_path.error());
    }
    const auto grammar = motion::load_grammar(*grammar_path);
    if (!grammar) {
        return fail(grammar.error());
    }
    const std::string_view role_name = motion::kRoleNames[static_cast<std::size_t>(role)];
    std::vector<motion::FigureModel> figures;
    for (const motion::FigureGrammar::Rule& rule : grammar->rules) {
        const auto path =
            data_path(folder / fmt::format("{}_{}_{}.json", dance, rule.figure, role_name));
        if (!path) {
            return fail(path.error());
        }
        auto figure = motion::load_figure(*path);
        if (!figure) {
            return fail(figure.error());
        }
        figures.push_back(std::move(*figure));
    }
    return motion::DanceLibrary::build(figures, motion::mannequin_skeleton(), &*grammar);
}

Expected<std::vector<motion::EnsembleMember>> load_dancers(const Settings& settings) {
    const auto name = std::find(
        motion::kFormationNames.begin(), motion::kFormationNames.end(), settings.formation);
    if (name == motion::kFormationNames.end()) {
        return fail(unknown_name("formation", settings.formation, motion::kFormationNames));
    }
    const auto formation = static_cast<motion::Formation>(name - motion::kFormationNames.begin());
    const std::string dance = dance_to_load(settings);
    auto lead = load_dance(dance);
    if (!lead) {
        return fail(std::move(lead.error()));
    }
    std::shared_ptr<const motion::DanceLibrary> follow;
    if (formation == motion::Formation::couple) {
        auto loaded = load_dance(dance, motion::DanceRole::follow);
        if (!loaded) {
            return fail(std::move(loaded.error()));
        }
        follow = std::move(*loaded);
    }
    return motion::members_of(formation, *lead, follow, static_cast<std::uint64_t>(settings.seed));
}

}  // namespace raks::engine
