#include <cstddef>
#include <string>
#include <string_view>
#include <vector>

#include "apps/raks/commands.hpp"
#include "apps/reports/text_table.hpp"
#include "apps/terminal/say.hpp"
#include "base/json.hpp"
#include "base/printable.hpp"
#include "engine/setup/dance_catalogue.hpp"
#include "engine/setup/dance_folder.hpp"
#include "motion/cells/cell_file.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

namespace raks::apps {
namespace {

// One dance and what examining it found.
struct FoundDance {
    const engine::CatalogueEntry* entry = nullptr;
    std::vector<std::string> figures;
    std::vector<std::string> takes;  ///< whole takes of people
    std::size_t cells = 0;           ///< beats of the takes that are danced
    std::string licence;             ///< of the takes, and who made them
    std::string fault;               ///< why it cannot be danced; empty: it can
};

// Origins as people read them.
const char* name_of(engine::DanceOrigin origin) {
    switch (origin) {
        case engine::DanceOrigin::given:
            return "given";
        case engine::DanceOrigin::user:
            return "yours";
        case engine::DanceOrigin::shipped:
            return "shipped";
    }
    return "";
}

// Reads the dance's takes, as dancing it would.
void examine_takes(const engine::CatalogueEntry& entry, FoundDance& found) {
    const auto dance = motion::load_cells(engine::cells_path(entry.folder, entry.info.name));
    if (!dance) {
        found.fault = dance.error().message;
        return;
    }
    for (const motion::CellTake& take : dance->graph.takes) {
        found.takes.push_back(take.name);
    }
    found.cells = dance->graph.cells.size();
    found.licence = dance->licence;
}

// Reads the dance in all its roles and materials, as dancing it would: a fault is found here and
// not during a show.
FoundDance examine(const engine::DanceCatalogue& catalogue, const engine::CatalogueEntry& entry) {
    FoundDance found;
    found.entry = &entry;
    if (entry.has_cells) {
        examine_takes(entry, found);
    }
    if (!entry.has_figures || !found.fault.empty()) {
        return found;
    }
    // A dance for one has no follow.
    for (const auto role : {motion::DanceRole::lead, motion::DanceRole::follow}) {
        if (role == motion::DanceRole::follow && entry.info.roles < 2) {
            continue;
        }
        const auto parts = catalogue.read(entry.info.name, role, {});
        if (!parts) {
            found.fault = parts.error().message;
            return found;
        }
        // The follow's figures have the same names.
        if (role == motion::DanceRole::lead) {
            for (const motion::FigureModel& figure : parts->figures) {
                found.figures.push_back(figure.name);
            }
        }
    }
    return found;
}

// The fields of raks-dances-found, version 1; an empty fault means that the dance can be danced.
Json json_of(const FoundDance& found) {
    const DanceInfo& info = found.entry->info;
    Json json = {{"name", info.name},
                 {"title", info.title},
                 {"beats_per_bar", info.beats_per_bar},
                 {"tempo", {info.lowest.bpm(), info.highest.bpm()}},
                 {"likely_tempo", info.likely.bpm()},
                 {"roles", info.roles},
                 {"style", info.style},
                 {"origin", name_of(found.entry->origin)},
                 {"folder", found.entry->folder.string()}};
    json["extensions"] = Json::array();
    for (const Path& folder : found.entry->extensions) {
        json["extensions"].push_back(folder.string());
    }
    json["figures"] = found.figures;
    json["takes"] = found.takes;
    json["cells"] = found.cells;
    json["licence"] = found.licence;
    json["fault"] = found.fault;
    return json;
}

// A paragraph for people.
std::string text_of(const FoundDance& found) {
    const DanceInfo& info = found.entry->info;
    std::string text = fmt::format("{} ({}, {})\n  {:g} to {:g} BPM, bars of {}{}\n  {}\n",
                                   info.name,
                                   printable(info.title),
                                   name_of(found.entry->origin),
                                   info.lowest.bpm(),
                                   info.highest.bpm(),
                                   info.beats_per_bar,
                                   info.roles == 2 ? ", for couples too" : "",
                                   printable(found.entry->folder.string()));
    for (const Path& folder : found.entry->extensions) {
        text += fmt::format("  and {}\n", printable(folder.string()));
    }
    if (!found.fault.empty()) {
        return text + fmt::format("  cannot be danced: {}\n", printable(found.fault));
    }
    const auto add_names = [&](std::string_view what, const std::vector<std::string>& names) {
        text +=
            fmt::format("  {}: {}\n",
                        what,
                        printable(fmt::format("{}", fmt::join(names, ", ")), std::string::npos));
    };
    if (!found.takes.empty()) {
        add_names(fmt::format("{} beats of people's takes", found.cells), found.takes);
    }
    if (!found.licence.empty()) {
        text += fmt::format("  the takes are not under MIT or Apache-2.0, as Raks is: {}\n",
                            printable(found.licence, std::string::npos));
    }
    if (!found.figures.empty()) {
        add_names("figures", found.figures);
    }
    return text;
}

}  // namespace

ExitCode dances(const DancesArguments& arguments) {
    const auto catalogue = engine::DanceCatalogue::load();
    if (!catalogue) {
        return fail(catalogue.error());
    }
    Json json = {{"format", "raks-dances-found"}, {"version", 1}};
    json["dances"] = Json::array();
    std::string text;
    // A broken dance is listed with its fault.
    for (const engine::CatalogueEntry& entry : catalogue->entries()) {
        const FoundDance found = examine(*catalogue, entry);
        json["dances"].push_back(json_of(found));
        text += text_of(found);
    }
    json["notes"] = catalogue->notes();
    for (const std::string& note : catalogue->notes()) {
        say(note);
    }
    // A folder's name need not be UTF-8.
    if (arguments.as_json) {
        print_json(json.text(2) + "\n");
    } else {
        print_text(text);
    }
    return kExitDone;
}

}  // namespace raks::apps
