#include "engine/setup/dance_catalogue.hpp"

#include <algorithm>
#include <cstdlib>
#include <system_error>
#include <utility>

#include "audio/music/generator/music_generator.hpp"
#include "base/file.hpp"
#include "base/printable.hpp"
#include "base/suggest.hpp"
#include "engine/setup/dance_folder.hpp"
#include "engine/setup/settings.hpp"
#include "motion/figures/dance_habits_reader.hpp"

#include <fmt/format.h>

namespace raks::engine {
namespace {

namespace fs = std::filesystem;

// The file of a figure: searched in the dance's folder and then in its extensions, first as learnt
// from the wanted features and then, where there is none, from angles. Empty: there is none.
fs::path find_figure(const CatalogueEntry& entry,
                     std::string_view figure,
                     motion::DanceRole role,
                     motion::FigureFeatures features) {
    std::vector<fs::path> folders = {entry.folder};
    folders.insert(folders.end(), entry.extensions.begin(), entry.extensions.end());
    for (const auto wanted : {features, motion::FigureFeatures::angles}) {
        for (const fs::path& folder : folders) {
            fs::path path = figure_path(folder, entry.info.name, figure, role, wanted);
            if (is_there(path)) {
                return path;
            }
        }
    }
    return {};
}

// The end of an error about a follow's part: which dances couples can dance.
std::string couple_dances(const DanceList& dances) {
    std::string names;
    for (const DanceInfo& dance : dances.all()) {
        if (dance.roles == 2) {
            names += (names.empty() ? "; a couple dances " : ", ") + dance.name;
        }
    }
    return names;
}

}  // namespace

fs::path user_dances_path() {
    // A relative path is invalid by the XDG base directory specification and is ignored.
    // NOLINTNEXTLINE(concurrency-mt-unsafe): nothing here changes the environment
    if (const char* const data = std::getenv("XDG_DATA_HOME"); data != nullptr && *data == '/') {
        return fs::path(data) / "raks" / "dances";
    }
    // NOLINTNEXTLINE(concurrency-mt-unsafe)
    if (const char* const home = std::getenv("HOME"); home != nullptr && *home == '/') {
        return fs::path(home) / ".local" / "share" / "raks" / "dances";
    }
    return {};
}

Expected<DanceCatalogue> DanceCatalogue::load(const fs::path& given) {
    DanceCatalogue catalogue;
    if (!given.empty()) {
        // Added first, so that its dances hide others of the same name.
        catalogue.add_folder(given, DanceOrigin::given);
        if (catalogue.entries_.empty()) {
            return fail(catalogue.notes_.empty()
                            ? given.string() + ": its dances.toml lists no dance of its own"
                            : catalogue.notes_.front());
        }
        // Before the others are added, the first entry is the given folder's.
        catalogue.given_dance_ = catalogue.entries_.front().info.name;
    }
    if (const fs::path user = user_dances_path(); !user.empty() && is_there(user)) {
        const auto folders = list_folder(user);
        // Folders that cannot be read are left out, as a user may have none.
        std::error_code ignored;
        for (const fs::path& folder : folders ? *folders : std::vector<fs::path>{}) {
            // Hidden folders are not dances.
            if (fs::is_directory(folder, ignored) && folder.filename().string().front() != '.') {
                catalogue.add_folder(folder, DanceOrigin::user);
            }
        }
    }
    const auto shipped = data_path(fs::path("models") / "trained" / "dances.toml");
    if (shipped) {
        catalogue.add_folder(shipped->parent_path(), DanceOrigin::shipped);
    } else {
        catalogue.notes_.push_back(shipped.error().message);
    }
    // Extensions wait until all folders are known: the dance that they extend may be found later.
    catalogue.join_extensions();
    catalogue.number_dances();
    if (catalogue.entries_.empty()) {
        return fail(catalogue.notes_.front());
    }
    return catalogue;
}

void DanceCatalogue::add_folder(const fs::path& folder, DanceOrigin origin) {
    // A dances.toml may only name music styles that the generator has.
    const auto styles = audio::style_names();
    auto file = load_dances(dances_path(folder), {styles.begin(), styles.end()});
    if (!file) {
        // A folder without a dances.toml is told apart from one whose dances.toml is bad.
        notes_.push_back(is_there(dances_path(folder))
                             ? file.error().message
                             : folder.string() +
                                   ": holds no dances.toml; `raks train figure` writes one");
        return;
    }
    // Only the shipped file decides which two dances reports compare.
    if (origin == DanceOrigin::shipped) {
        pair_ = file->pair;
    }
    for (DanceInfo& dance : file->dances) {
        add({std::move(dance), origin, folder, {}});
    }
}

void DanceCatalogue::add(CatalogueEntry entry) {
    // An extension's grammar is named after the dance that it extends: the check below is not for
    // it.
    if (!entry.info.extends.empty()) {
        joining_.push_back(std::move(entry));
        return;
    }
    // A dance is listed only when its figures can be put in order, or it has cells.
    entry.has_cells = is_there(cells_path(entry.folder, entry.info.name));
    if (const fs::path written = grammar_path(entry.folder, entry.info.name); is_there(written)) {
        const auto habits = motion::habits_of_file(written);
        entry.has_figures = !habits || habits->has_figures || !entry.has_cells;
        if (habits) {
            const auto& notes = habits->habits.notes;
            notes_.insert(notes_.end(), notes.begin(), notes.end());
            entry.mood = habits->mood;
        } else if (entry.has_cells) {  // which are danced all the same
            notes_.push_back(habits.error().message);
        }
    }
    if (!entry.has_figures && !entry.has_cells) {
        notes_.push_back(fmt::format("{}: {} is not there, so that {} cannot be danced",
                                     entry.folder.string(),
                                     grammar_path({}, entry.info.name).string(),
                                     entry.info.name));
        return;
    }
    // The dance found first wins, and the person is told where it comes from.
    if (const CatalogueEntry* const known = find(entry.info.name)) {
        notes_.push_back(fmt::format("{} is danced from {} and not from {}",
                                     entry.info.name,
                                     known->folder.string(),
                                     entry.folder.string()));
        return;
    }
    entries_.push_back(std::move(entry));
}

void DanceCatalogue::join_extensions() {
    for (const CatalogueEntry& joining : joining_) {
        const auto extended =
            std::find_if(entries_.begin(), entries_.end(), [&](const CatalogueEntry& entry) {
                return entry.info.name == joining.info.extends;
            });
        if (extended == entries_.end()) {
            // The names to suggest from; a DanceList holds kMostDances at most.
            const auto names = DanceList([this] {
                std::vector<DanceInfo> infos;
                for (std::size_t i = 0; i < std::min(entries_.size(), kMostDances); ++i) {
                    infos.push_back(entries_[i].info);
                }
                return infos;
            }());
            notes_.push_back(joining.folder.string() + ": extends: " +
                             unknown_name("dance", joining.info.extends, names.names()));
        } else if (!extended->has_figures) {
            notes_.push_back(
                fmt::format("{}: extends {}, which has takes of people and no figures; its figures "
                            "are left out",
                            joining.folder.string(),
                            joining.info.extends));
        } else {
            extended->extensions.push_back(joining.folder);
        }
    }
    joining_.clear();
}

// Sorts the entries and numbers them. Shipped dances come first, so that their numbers (in
// MusicState::genre and in commands) do not depend on what a user has installed.
void DanceCatalogue::number_dances() {
    std::stable_sort(entries_.begin(), entries_.end(), [](const auto& a, const auto& b) {
        const bool is_a_shipped = a.origin == DanceOrigin::shipped;
        const bool is_b_shipped = b.origin == DanceOrigin::shipped;
        return is_a_shipped > is_b_shipped;
    });
    if (entries_.size() > kMostDances) {
        // The user's dances come last and are cut: those of a folder that was given stay.
        notes_.push_back(fmt::format("there are {} dances; {} and those after it are left out",
                                     entries_.size(),
                                     entries_[kMostDances].info.name));
        entries_.resize(kMostDances);
    }
    std::vector<DanceInfo> infos;
    for (const CatalogueEntry& entry : entries_) {
        infos.push_back(entry.info);
    }
    list_ = std::make_shared<const DanceList>(std::move(infos));
}

const CatalogueEntry* DanceCatalogue::find(std::string_view name) const noexcept {
    const auto found = std::find_if(entries_.begin(), entries_.end(), [name](const auto& entry) {
        return entry.info.name == name;
    });
    return found != entries_.end() ? &*found : nullptr;
}

Error DanceCatalogue::danced_alone(std::string_view name) const {
    return {fmt::format("{} is danced alone{}", name, couple_dances(*list_))};
}

Expected<DancePlan> DanceCatalogue::plan(std::string_view name,
                                         motion::DanceRole role,
                                         const DanceForm& form) const {
    const CatalogueEntry* const entry = find(name);
    if (entry == nullptr) {
        return fail(unknown_name("dance", name, list_->names()));
    }
    // One grammar from all folders: each extension adds its rules.
    auto grammar = motion::load_grammar(grammar_path(entry->folder, entry->info.name));
    if (!grammar) {
        return fail(std::move(grammar.error()));
    }
    for (const fs::path& folder : entry->extensions) {
        const fs::path path = grammar_path(folder, entry->info.name);
        if (auto extended = motion::extend_grammar(path, *grammar); !extended) {
            return fail(std::move(extended.error()));
        }
    }
    DancePlan plan{role, std::move(*grammar), {}};
    for (motion::FigureGrammar::Rule& rule : plan.grammar.rules) {
        // Alone, nobody has to be given room: the steps aside are dropped.
        rule.aside = form.company == Company::couple ? rule.aside : decltype(rule.aside){};
        fs::path path = find_figure(*entry, rule.figure, role, form.features);
        // No file for a follow in a dance for one is no missing file: such a dance has no follow.
        if (path.empty() && role == motion::DanceRole::follow && entry->info.roles < 2) {
            return fail(danced_alone(name));
        }
        if (path.empty()) {
            return fail(fmt::format(
                "{}: is not there; train figure {} for the {}, or take it out of the grammar",
                figure_path(entry->folder, entry->info.name, rule.figure, role, form.features)
                    .string(),
                rule.figure,
                motion::kRoleNames[static_cast<std::size_t>(role)]));
        }
        plan.files.push_back(std::move(path));
    }
    return plan;
}

Expected<DanceParts> DanceCatalogue::read(std::string_view name,
                                          motion::DanceRole role,
                                          const DanceForm& form) const {
    auto planned = plan(name, role, form);
    return planned ? read_figures(std::move(*planned)) : fail(std::move(planned.error()));
}

bool is_of_cells(const CatalogueEntry& entry,
                 motion::DanceRole role,
                 const DanceForm& form) noexcept {
    const bool can_be = role == motion::DanceRole::lead && form.company == Company::alone &&
                        form.generator == motion::Generator::trajectories &&
                        form.features == motion::FigureFeatures::angles;
    return entry.has_cells && (!entry.has_figures || (can_be && form.material == Material::people));
}

Expected<DanceParts> read_figures(DancePlan plan) {
    DanceParts parts{std::move(plan.grammar), {}};
    for (std::size_t i = 0; i < plan.files.size(); ++i) {
        auto figure = motion::load_figure(plan.files[i]);
        if (!figure) {
            return fail(std::move(figure.error()));
        }
        // Models are found by file name, so that a file copied to a wrong name would dance another
        // figure.
        if (figure->name != parts.grammar.rules[i].figure || figure->role != plan.role) {
            return fail(fmt::format("{}: is of the figure {} for the {}, not what its name says",
                                    plan.files[i].string(),
                                    printable(figure->name, 60),
                                    motion::kRoleNames[static_cast<std::size_t>(figure->role)]));
        }
        parts.figures.push_back(std::move(*figure));
    }
    return parts;
}

}  // namespace raks::engine
