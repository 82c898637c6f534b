#include "engine/setup/dance_folder.hpp"

#include <algorithm>
#include <functional>
#include <string>
#include <system_error>
#include <utility>

#include "base/file.hpp"
#include "base/file_set.hpp"
#include "base/pending_file.hpp"
#include "motion/cells/cell_file.hpp"

#include <fmt/format.h>

namespace raks::engine {
namespace {

namespace fs = std::filesystem;

// More than any dances.toml or grammar; bounds the memory for a wrong file.
constexpr std::size_t kMaxTextBytes = std::size_t{4} << 20U;

// Lists the dance in dances.toml, unless it is listed. The text is appended to, never rewritten.
Expected<void> list_dance(const fs::path& folder, const DanceInfo& dance) {
    const fs::path path = dances_path(folder);
    if (!is_there(path)) {
        return write_file(path, dances_text({{dance}, {}}));
    }
    auto text = read_text_file(path, kMaxTextBytes);
    if (!text) {
        return fail(std::move(text.error()));
    }
    // Parsed only to see what it lists, and to refuse a faulty file before anything is appended.
    const auto known = parse_dances(*text, path.string());
    if (!known) {
        return fail(known.error());
    }
    const bool is_listed = std::any_of(known->dances.begin(),
                                       known->dances.end(),
                                       [&](const DanceInfo& d) { return d.name == dance.name; });
    return is_listed ? Expected<void>{} : write_file(path, *text + dance_text(dance));
}

// Adds a rule for each figure that the grammar lacks. The text that is there stays: a person may
// have edited weights and comments.
Expected<void> add_rules(const fs::path& folder,
                         const DanceInfo& dance,
                         std::span<const LearntFigure> figures,
                         const NewGrammar& grammar) {
    const fs::path path = grammar_path(folder, dance.name);
    // The head of a new grammar; a text that is there replaces it.
    motion::FigureGrammar head;
    head.dance = dance.name;
    head.beats_per_bar = dance.beats_per_bar;
    head.couple = grammar.couple;
    head.starts = grammar.starts;
    std::string text = motion::grammar_head_text(head);
    std::vector<std::string> known;
    if (is_there(path)) {
        auto there = read_text_file(path, kMaxTextBytes);
        if (!there) {
            return fail(std::move(there.error()));
        }
        text = std::move(*there);
        auto names = motion::figures_in_grammar(text, path.string());
        if (!names) {
            return fail(std::move(names.error()));
        }
        known = std::move(*names);
    }
    const std::string before = text;
    for (const LearntFigure& figure : figures) {
        // Learnt models of both roles share one rule.
        if (std::find(known.begin(), known.end(), figure.model->name) == known.end()) {
            text += motion::figure_rule_text(figure.model->name, figure.seen, figure.next);
            known.push_back(figure.model->name);
        }
    }
    // An unchanged file keeps its time.
    return text == before ? Expected<void>{} : write_file(path, text);
}

}  // namespace

fs::path dances_path(const fs::path& folder) { return folder / "dances.toml"; }

fs::path grammar_path(const fs::path& folder, std::string_view dance) {
    return folder / fmt::format("{}.toml", dance);
}

fs::path cells_path(const fs::path& folder, std::string_view dance) {
    return folder / fmt::format("{}.cells", dance);
}

fs::path figure_path(const fs::path& folder,
                     std::string_view dance,
                     std::string_view figure,
                     motion::DanceRole role,
                     motion::FigureFeatures features) {
    return folder / fmt::format("{}_{}_{}{}.json",
                                dance,
                                figure,
                                motion::kRoleNames[static_cast<std::size_t>(role)],
                                features == motion::FigureFeatures::positions ? "_positions" : "");
}

namespace {

Expected<void> add_files(const fs::path& folder,
                         const DanceInfo& dance,
                         std::span<const LearntFigure> figures,
                         const NewGrammar& grammar) {
    for (const LearntFigure& figure : figures) {
        const motion::FigureModel& model = *figure.model;
        const fs::path path =
            figure_path(folder, dance.name, model.name, model.role, model.features);
        if (auto saved = motion::save_figure(model, path); !saved) {
            return saved;
        }
    }
    // The grammar after the figures and the list last: whatever is listed is complete, even if the
    // program is stopped in between.
    if (auto added = add_rules(folder, dance, figures, grammar); !added) {
        return added;
    }
    return list_dance(folder, dance);
}

// Where a folder cannot be changed as a whole it is changed file by file. A folder that somebody
// stands in stays the one that it is.
Expected<void> change_folder(const fs::path& folder,
                             const std::function<Expected<void>(const fs::path&)>& change) {
    std::error_code ignored;
    const bool was_there = fs::exists(folder, ignored);
    auto whole = fs::equivalent(folder, fs::current_path(ignored), ignored)
                     ? Expected<PendingFile>(fail("it is the current folder"))
                     : PendingFile::create_changed_folder(folder);
    if (!whole) {
        auto made = make_folders(folder);
        return made ? change(folder) : made;
    }
    if (auto changed = change(whole->part()); !changed) {
        if (!was_there) {
            fs::remove(folder, ignored);  // it was made to be changed, and is empty
        }
        return fail(named_as(folder, whole->part(), std::move(changed.error())));
    }
    return whole->commit() ? Expected<void>() : change(folder);
}

}  // namespace

Expected<void> add_to_folder(const fs::path& folder,
                             const DanceInfo& dance,
                             std::span<const LearntFigure> figures,
                             const NewGrammar& grammar) {
    // All names are checked before the first file is written.
    if (!is_dance_name(dance.name)) {
        return fail("dance: " + why_no_dance_name(dance.name));
    }
    for (const LearntFigure& figure : figures) {
        if (!motion::is_figure_name(figure.model->name)) {
            return fail("figure " + motion::why_no_figure_name(figure.model->name));
        }
    }
    return change_folder(folder, [&](const fs::path& changed) {
        return add_files(changed, dance, figures, grammar);
    });
}

Expected<void> add_to_folder(const fs::path& folder,
                             const DanceInfo& dance,
                             const motion::CellDance& cells) {
    if (!is_dance_name(dance.name)) {
        return fail("dance: " + why_no_dance_name(dance.name));
    }
    const std::string text = motion::cell_text(cells);
    // Whatever lies in a folder can be danced.
    if (const auto readable = motion::parse_cells(text, dance.name); !readable) {
        return fail(readable.error());
    }
    return change_folder(folder, [&](const fs::path& changed) {
        auto written = write_file(cells_path(changed, dance.name), text);
        return written ? list_dance(changed, dance) : written;
    });
}

}  // namespace raks::engine
