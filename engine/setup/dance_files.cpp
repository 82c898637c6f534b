#include "engine/setup/dance_files.hpp"

#include <algorithm>
#include <array>
#include <string_view>

#include "base/suggest.hpp"
#include "engine/setup/settings.hpp"
#include "motion/figures/figure_grammar.hpp"
#include "motion/figures/figure_model.hpp"

#include <fmt/format.h>

namespace raks::engine {
namespace {

using motion::DanceRole;
using motion::FigureFeatures;
using motion::Repertoire;

constexpr std::string_view kAuto = "auto";
constexpr std::string_view kKeep = "keep";
constexpr std::string_view kStand = "stand";

// models/trained/DANCE.toml is the grammar, models/trained/DANCE_FIGURE_ROLE.json the figures,
// DANCE_FIGURE_ROLE_positions.json those of positions.
std::filesystem::path grammar_file(std::string_view dance) {
    return std::filesystem::path("models") / "trained" / fmt::format("{}.toml", dance);
}

Genre genre_of(const std::string& dance) {
    const auto at = std::find(kGenreNames.begin(), kGenreNames.end(), dance);
    return static_cast<Genre>(at - kGenreNames.begin());
}

Expected<void> check_name(const std::string& dance, std::vector<std::string_view> others) {
    const std::vector<std::string> known = known_dances();
    others.insert(others.end(), known.begin(), known.end());
    if (std::find(others.begin(), others.end(), dance) == others.end()) {
        return fail(unknown_name("dance", dance, others));
    }
    return {};
}

Repertoire::Otherwise otherwise_of(const Settings& settings) {
    return settings.fallback_dance == kKeep    ? Repertoire::Otherwise::keep
           : settings.fallback_dance == kStand ? Repertoire::Otherwise::stand
                                               : Repertoire::Otherwise::first;
}

/// The repertoires of a formation: the lead's and, for couples, the follow's.
struct Parts {
    DanceForm form;
    std::shared_ptr<Repertoire> lead;
    std::shared_ptr<Repertoire> follow;

    /// Nothing is added where a part is missing.
    Expected<void> add(const std::string& dance) const {
        auto lead_dance = load_dance(dance, DanceRole::lead, form);
        if (!lead_dance) {
            return fail(std::move(lead_dance.error()));
        }
        if (follow) {
            auto follow_dance = load_dance(dance, DanceRole::follow, form);
            if (!follow_dance) {
                return fail(std::move(follow_dance.error()));
            }
            follow->add(genre_of(dance), std::move(*follow_dance));
        }
        lead->add(genre_of(dance), std::move(*lead_dance));
        return {};
    }
};

Expected<std::shared_ptr<Repertoire>> first_of(const Settings& settings, DanceRole role) {
    const std::string dance = dance_to_load(settings);
    auto library = load_dance(dance, role, form_of(settings));
    if (!library) {
        return fail(std::move(library.error()));
    }
    return std::make_shared<Repertoire>(
        genre_of(dance), std::move(*library), otherwise_of(settings));
}

/// Whether a dance has figures for couples.
bool is_for_couples(const std::string& dance) {
    const auto grammar_path = data_path(grammar_file(dance));
    const auto grammar = grammar_path ? motion::load_grammar(*grammar_path) : fail("");
    return grammar && grammar->place_of(DanceRole::follow) != nullptr;
}

}  // namespace

std::vector<std::string> known_dances() {
    std::vector<std::string> known;
    for (const std::string_view name : kGenreNames) {
        if (data_path(grammar_file(name))) {
            known.emplace_back(name);
        }
    }
    return known;
}

Expected<void> check_dance(const std::string& dance) { return check_name(dance, {kAuto}); }

Expected<void> check_fallback_dance(const std::string& dance) {
    return check_name(dance, {kKeep, kStand});
}

std::string dance_to_load(const Settings& settings) {
    if (settings.dance != kAuto) {
        return settings.dance;
    }
    const bool is_dance = otherwise_of(settings) == Repertoire::Otherwise::first;
    return is_dance ? settings.fallback_dance : known_dances().front();
}

DanceForm form_of(const Settings& settings) {
    DanceForm form;
    form.features =
        settings.figures == "positions" ? FigureFeatures::positions : FigureFeatures::angles;
    form.generator = settings.generator == "frames" ? motion::Generator::frames
                                                    : motion::Generator::trajectories;
    form.company = settings.formation == "couple" ? Company::couple : Company::alone;
    return form;
}

Expected<std::shared_ptr<const motion::DanceLibrary>> load_dance(const std::string& dance,
                                                                 motion::DanceRole role,
                                                                 const DanceForm& form) {
    if (auto checked = check_dance(dance); !checked) {
        return fail(checked.error());
    }
    const auto grammar_path = data_path(grammar_file(dance));
    if (!grammar_path) {
        return fail(grammar_path.error());
    }
    auto grammar = motion::load_grammar(*grammar_path);
    if (!grammar) {
        return fail(grammar.error());
    }
    for (motion::FigureGrammar::Rule& rule : grammar->rules) {
        rule.aside = form.company == Company::couple ? rule.aside : decltype(rule.aside){};
    }
    const std::string_view role_name = motion::kRoleNames[static_cast<std::size_t>(role)];
    std::vector<motion::FigureModel> figures;
    for (const motion::FigureGrammar::Rule& rule : grammar->rules) {
        const std::string file = fmt::format("{}_{}_{}", dance, rule.figure, role_name);
        const std::filesystem::path folder = grammar_file(dance).parent_path();
        const auto positions = data_path(folder / (file + "_positions.json"));
        const auto path = form.features == FigureFeatures::positions && positions
                              ? positions
                              : data_path(folder / (file + ".json"));
        if (!path) {
            return fail(path.error());
        }
        auto figure = motion::load_figure(*path);
        if (!figure) {
            return fail(figure.error());
        }
        figures.push_back(std::move(*figure));
    }
    return motion::DanceLibrary::build(
        figures, motion::mannequin_skeleton(), &*grammar, form.generator);
}

Expected<Dancers> Dancers::load(const Settings& settings) {
    const auto name = std::find(
        motion::kFormationNames.begin(), motion::kFormationNames.end(), settings.formation);
    if (name == motion::kFormationNames.end()) {
        return fail(unknown_name("formation", settings.formation, motion::kFormationNames));
    }
    const auto formation = static_cast<motion::Formation>(name - motion::kFormationNames.begin());
    const bool is_couple = formation == motion::Formation::couple;
    Parts parts;
    parts.form = form_of(settings);
    for (const DanceRole role : {DanceRole::lead, DanceRole::follow}) {
        if (role == DanceRole::follow && !is_couple) {
            continue;
        }
        auto repertoire = first_of(settings, role);
        if (!repertoire) {
            return fail(std::move(repertoire.error()));
        }
        (role == DanceRole::lead ? parts.lead : parts.follow) = std::move(*repertoire);
    }
    Dancers dancers;
    dancers.members_ = motion::members_of(
        formation, parts.lead, parts.follow, static_cast<std::uint64_t>(settings.seed));
    std::vector<std::string> others;
    for (const std::string& dance : known_dances()) {
        const bool is_first = dance == dance_to_load(settings);
        if (settings.dance == kAuto && !is_first && (!is_couple || is_for_couples(dance))) {
            others.push_back(dance);
        }
    }
    dancers.others_ = std::async(std::launch::async, [parts, others]() -> Expected<void> {
        for (const std::string& dance : others) {
            if (auto added = parts.add(dance); !added) {
                return added;
            }
        }
        return {};
    });
    return dancers;
}

Expected<void> Dancers::wait() { return others_.valid() ? others_.get() : Expected<void>{}; }

}  // namespace raks::engine
