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

/// Each dance with the part of it that is danced; its grammar and figures lie below models/trained.
struct DanceFiles {
    std::string_view dance;
    std::string_view role;  ///< models are DANCE_FIGURE_ROLE.json
};
constexpr std::array<DanceFiles, 1> kDances = {{{"salsa", "lead"}}};

constexpr std::string_view kAuto = "auto";

}  // namespace

std::vector<std::string> known_dances() {
    std::vector<std::string> names;
    names.reserve(std::size(kDances));
    for (const DanceFiles& files : kDances) {
        names.emplace_back(files.dance);
    }
    return names;
}

Expected<void> check_dance(const std::string& dance) {
    std::vector<std::string_view> known = {kAuto};
    for (const DanceFiles& files : kDances) {
        known.push_back(files.dance);
    }
    if (std::find(known.begin(), known.end(), dance) == known.end()) {
        return fail(unknown_name("dance", dance, known));
    }
    return {};
}

std::string dance_to_load(const Settings& settings) {
    return settings.dance == kAuto ? settings.fallback_dance : settings.dance;
}

Expected<std::shared_ptr<const motion::DanceLibrary>> load_dance(const std::string& dance) {
    if (auto checked = check_dance(dance); !checked) {
        return fail(checked.error());
    }
    const auto files =
        std::find_if(kDances.begin(), kDances.end(), [&](const DanceFiles& candidate) {
            return candidate.dance == dance;
        });
    const std::filesystem::path folder = std::filesystem::path("models") / "trained";
    const auto grammar_path = data_path(folder / fmt::format("{}.toml", dance));
    if (!grammar_path) {
        return fail(grammar_path.error());
    }
    const auto grammar = motion::load_grammar(*grammar_path);
    if (!grammar) {
        return fail(grammar.error());
    }
    std::vector<motion::FigureModel> figures;
    for (const motion::FigureGrammar::Rule& rule : grammar->rules) {
        const auto path =
            data_path(folder / fmt::format("{}_{}_{}.json", dance, rule.figure, files->role));
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

}  // namespace raks::engine
