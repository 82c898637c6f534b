#include "engine/setup/dance_files.hpp"

#include <algorithm>
#include <filesystem>
#include <memory>
#include <string>
#include <string_view>
#include <utility>

#include "base/file.hpp"
#include "base/suggest.hpp"
#include "engine/setup/dance_folder.hpp"
#include "engine/setup/settings.hpp"
#include "motion/cells/cell_file.hpp"
#include "motion/dance_library.hpp"
#include "motion/figures/dance_habits_reader.hpp"

#include <fmt/format.h>

namespace raks::engine {
namespace {

using motion::FigureFeatures;
using motion::Repertoire;

// Words that stand in place of a dance's name in the settings.
constexpr std::string_view kAuto = "auto";
constexpr std::string_view kFirst = "first";
constexpr std::string_view kKeep = "keep";
constexpr std::string_view kStand = "stand";

// Errors: `dance` is neither a dance of the list nor one of the other words.
Expected<void> check_name(const std::string& dance,
                          const DanceList& dances,
                          std::vector<std::string_view> others) {
    const std::vector<std::string_view> names = dances.names();
    others.insert(others.end(), names.begin(), names.end());
    if (std::find(others.begin(), others.end(), dance) == others.end()) {
        return fail(unknown_name("dance", dance, others));
    }
    return {};
}

}  // namespace

Expected<void> check_dances(const Settings& settings, const DanceList& dances) {
    if (auto checked = check_name(settings.dance, dances, {kAuto}); !checked) {
        return checked;
    }
    return check_name(settings.fallback_dance, dances, {kAuto, kFirst, kKeep, kStand});
}

Expected<void> check_dances(const Settings& settings, const DanceCatalogue& catalogue) {
    auto checked = check_dances(settings, *catalogue.list());
    if (checked) {
        return checked;
    }
    // A name that is unknown only because its files are not there.
    const bool is_fallback = settings.dance == kAuto;
    const std::string& name = is_fallback ? settings.fallback_dance : settings.dance;
    const auto& notes = catalogue.notes();
    const auto reason = std::find_if(notes.begin(), notes.end(), [&](const std::string& note) {
        return note.find("is not installed") != std::string::npos ||
               note.find("so that " + name + " cannot") != std::string::npos;
    });
    return reason == notes.end() ? checked : fail(*reason + " (" + checked.error().message + ")");
}

namespace {

// Whether a dance is one for a couple where one is asked for, and has figures for the paper's
// generator.
bool is_for(const CatalogueEntry& entry, const DanceForm& form) {
    return (form.company == Company::alone || entry.info.roles == 2) &&
           (form.generator == motion::Generator::trajectories || entry.has_figures);
}

}  // namespace

namespace {

// Whether a dance can be danced in the form that is asked for, and no preset forbids it.
bool is_wanted(const CatalogueEntry& entry, const Settings& settings) {
    const auto& forbidden = settings.forbidden_dances;
    return is_for(entry, form_of(settings)) &&
           std::find(forbidden.begin(), forbidden.end(), entry.info.name) == forbidden.end();
}

}  // namespace

std::string dance_to_load(const Settings& settings, const DanceCatalogue& catalogue) {
    if (settings.dance != kAuto) {
        return settings.dance;
    }
    const auto& all = catalogue.entries();
    const auto meant = std::find_if(all.begin(), all.end(), [&](const CatalogueEntry& entry) {
        return settings.fallback_dance == kAuto ? entry.info.is_fallback
                                                : entry.info.name == settings.fallback_dance;
    });
    const CatalogueEntry* const fallback = meant != all.end() ? &*meant : nullptr;
    if (fallback != nullptr && is_wanted(*fallback, settings)) {
        return fallback->info.name;
    }
    const auto first = std::find_if(all.begin(), all.end(), [&](const CatalogueEntry& entry) {
        return is_wanted(entry, settings);
    });
    return first != all.end()    ? first->info.name
           : fallback != nullptr ? fallback->info.name
                                 : all.front().info.name;
}

std::vector<std::string> other_dances_to_load(const Settings& settings,
                                              const DanceCatalogue& catalogue) {
    std::vector<std::string> others;
    if (settings.dance != kAuto) {
        return others;
    }
    const std::string first = dance_to_load(settings, catalogue);
    for (const CatalogueEntry& entry : catalogue.entries()) {
        if (entry.info.name != first && is_wanted(entry, settings)) {
            others.push_back(entry.info.name);
        }
    }
    return others;
}

Repertoire::Fallback fallback_of(const Settings& settings) {
    return settings.fallback_dance == kKeep    ? Repertoire::Fallback::keep
           : settings.fallback_dance == kStand ? Repertoire::Fallback::stand
                                               : Repertoire::Fallback::first;
}

DanceForm form_of(const Settings& settings) {
    DanceForm form;
    form.features =
        settings.figures == "positions" ? FigureFeatures::positions : FigureFeatures::angles;
    form.generator = settings.generator == "frames" ? motion::Generator::frames
                                                    : motion::Generator::trajectories;
    form.company = settings.formation == "couple" ? Company::couple : Company::alone;
    form.material = material_of(settings, 0);
    return form;
}

Material material_of(const Settings& settings, std::size_t dancer) noexcept {
    if (settings.material != "both") {
        return settings.material == "written" ? Material::written : Material::people;
    }
    return (static_cast<std::size_t>(settings.seed) + dancer) % 2 == 1 ? Material::people
                                                                       : Material::written;
}

namespace {

// "house", "house and disco", "hiphop, house and disco".
std::string listed(const std::vector<std::string>& names) {
    std::string text = names.front();
    for (std::size_t i = 1; i < names.size(); ++i) {
        text += (i + 1 == names.size() ? " and " : ", ") + names[i];
    }
    return text;
}

// What takes of people cannot be that the form asks for; empty: nothing.
std::string_view not_of_cells(const DanceForm& form) {
    return form.company == Company::couple                      ? "for one dancer"
           : form.generator == motion::Generator::frames        ? "not of --generator frames"
           : form.features == motion::FigureFeatures::positions ? "not of --figures positions"
                                                                : "";
}

}  // namespace

std::vector<std::string> material_notes(const Settings& settings, const DanceCatalogue& catalogue) {
    const DanceForm form = form_of(settings);
    const std::string_view reason = not_of_cells(form);
    std::vector<std::string> loaded = other_dances_to_load(settings, catalogue);
    loaded.insert(loaded.begin(), dance_to_load(settings, catalogue));
    std::vector<std::string> left_out;  // by the generator; couples have dances of their own
    std::vector<std::string> without_figures;
    std::vector<std::string> without_takes;  // in this form
    for (const CatalogueEntry& entry : catalogue.entries()) {
        const bool is_loaded =
            std::find(loaded.begin(), loaded.end(), entry.info.name) != loaded.end();
        if (!entry.has_cells) {
            continue;
        }
        if (is_loaded && entry.has_figures && !reason.empty()) {
            // Of dances that nobody named most are never seen: the line would be about others.
            if (settings.dance != kAuto) {
                without_takes.push_back(entry.info.name);
            }
        } else if (is_loaded && !entry.has_figures) {
            without_figures.push_back(entry.info.name);
        } else if (!is_loaded && settings.dance == kAuto &&
                   form.generator == motion::Generator::frames) {
            left_out.push_back(entry.info.name);
        }
    }
    std::vector<std::string> notes;
    const auto is_or_are = [](const std::vector<std::string>& names) {
        return names.size() == 1 ? "is" : "are";
    };
    if (settings.material == "written" && !without_figures.empty()) {
        notes.push_back(fmt::format("material: {} {} no figures: takes of people are danced",
                                    listed(without_figures),
                                    without_figures.size() == 1 ? "has" : "have"));
    }
    if (settings.material != "written" && !without_takes.empty()) {
        notes.push_back(fmt::format("material: {} {} danced of figures: takes of people are {}",
                                    listed(without_takes),
                                    is_or_are(without_takes),
                                    reason));
    }
    if (!left_out.empty()) {
        notes.push_back(fmt::format("material: {} {} left out: takes of people are {}",
                                    listed(left_out),
                                    is_or_are(left_out),
                                    reason));
    }
    return notes;
}

std::vector<std::string> hold_notes(const Settings& settings, const DanceCatalogue& catalogue) {
    std::vector<std::string> notes;
    const DanceForm form = form_of(settings);
    if (form.company != Company::couple) {
        return notes;
    }
    std::vector<std::string> loaded = other_dances_to_load(settings, catalogue);
    loaded.insert(loaded.begin(), dance_to_load(settings, catalogue));
    for (const std::string& name : loaded) {
        // One that cannot be loaded says so itself.
        if (const auto plan = catalogue.plan(name, motion::DanceRole::lead, form)) {
            const std::vector<std::string>& own = plan->grammar.notes;
            notes.insert(notes.end(), own.begin(), own.end());
        }
    }
    return notes;
}

GenreAids genre_aids_of(const Settings& settings) {
    return {settings.tagger == "off" ? TaggerUse::off : TaggerUse::on,
            settings.ignore_tags ? FileTags::ignored : FileTags::read};
}

motion::Dynamics dynamics_of(const Settings& settings) {
    return settings.dynamics == "off" ? motion::Dynamics::off : motion::Dynamics::on;
}

namespace {

// A dance of whole takes that has nothing else for this form. Errors: what it is asked for is not
// in the takes.
Expected<std::shared_ptr<const motion::DanceLibrary>> load_cell_dance(
    const DanceCatalogue& catalogue,
    const CatalogueEntry& entry,
    const motion::Skeleton& skeleton,
    motion::DanceRole role,
    const DanceForm& form,
    const DanceCache& cache) {
    const std::string& dance = entry.info.name;
    if (role == motion::DanceRole::follow || form.company == Company::couple) {
        return fail(catalogue.danced_alone(dance));
    }
    if (form.generator == motion::Generator::frames) {
        return fail(dance + " is a dance of whole takes; leave --generator frames out");
    }
    const std::filesystem::path file = cells_path(entry.folder, dance);
    const auto bytes = read_file(file, motion::kMostCellBytes);
    if (!bytes) {
        return fail(bytes.error());
    }
    // Of a file that cannot be read the catalogue has told.
    const std::filesystem::path beside = grammar_path(entry.folder, dance);
    const auto written =
        is_there(beside) ? motion::habits_of_file(beside) : Expected<motion::WrittenHabits>();
    const motion::DanceHabits habits = written ? written->habits : motion::DanceHabits();
    const std::filesystem::path kept = cache.path_of(dance, *bytes, skeleton);
    if (auto found = DanceCache::find(kept, skeleton, habits)) {
        return found;
    }
    const auto cells = motion::parse_cells(*bytes, file.filename().string());
    if (!cells) {
        return fail(cells.error());
    }
    auto library = motion::DanceLibrary::build(*cells, skeleton, habits);
    if (library) {
        DanceCache::keep(kept, **library);
    }
    return library;
}

}  // namespace

Expected<std::shared_ptr<const motion::DanceLibrary>> load_dance(const DanceCatalogue& catalogue,
                                                                 std::string_view dance,
                                                                 const motion::Skeleton& skeleton,
                                                                 motion::DanceRole role,
                                                                 const DanceForm& form,
                                                                 const DanceCache& cache) {
    if (const CatalogueEntry* const entry = catalogue.find(dance);
        entry != nullptr && is_of_cells(*entry, role, form)) {
        return load_cell_dance(catalogue, *entry, skeleton, role, form, cache);
    }
    auto plan = catalogue.plan(dance, role, form);
    if (!plan) {
        return fail(std::move(plan.error()));
    }
    // The cache is asked before the figures are parsed: a hit costs one read.
    const std::filesystem::path kept = cache.path_of(*plan, skeleton, form);
    if (auto found = DanceCache::find(kept, skeleton, plan->grammar)) {
        return found;
    }
    auto parts = read_figures(std::move(*plan));
    if (!parts) {
        return fail(std::move(parts.error()));
    }
    auto library =
        motion::DanceLibrary::build(parts->figures, skeleton, &parts->grammar, form.generator);
    // A build that fails is not kept: its error is to be seen again.
    if (library) {
        DanceCache::keep(kept, **library);
    }
    return library;
}

}  // namespace raks::engine
