#pragma once

#include <filesystem>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "base/dance_list.hpp"
#include "base/expected.hpp"
#include "motion/cells/cell_dance.hpp"
#include "motion/figures/couple_form.hpp"
#include "motion/figures/figure_grammar.hpp"
#include "motion/figures/figure_model.hpp"

/// A folder of dances: which file lies where, and how a learnt figure is added. The shipped folder,
/// a user's, and one that is given to `--dance` have the same form:
///
///     dances.toml                     what each dance is (base/dance_list.hpp)
///     DANCE.toml                      which figure comes after which (figure_grammar.hpp)
///     DANCE_FIGURE_ROLE.json          a figure of angles
///     DANCE_FIGURE_ROLE_positions.json  the same of positions
namespace raks::engine {

/// folder/dances.toml.
[[nodiscard]] std::filesystem::path dances_path(const std::filesystem::path& folder);
/// folder/DANCE.toml.
[[nodiscard]] std::filesystem::path grammar_path(const std::filesystem::path& folder,
                                                 std::string_view dance);
/// folder/DANCE_FIGURE_ROLE.json, or ..._positions.json.
[[nodiscard]] std::filesystem::path figure_path(const std::filesystem::path& folder,
                                                std::string_view dance,
                                                std::string_view figure,
                                                motion::DanceRole role,
                                                motion::FigureFeatures features);

/// folder/DANCE.cells: a dance of cells, in place of figures and grammar.
[[nodiscard]] std::filesystem::path cells_path(const std::filesystem::path& folder,
                                               std::string_view dance);

/// A figure to be added, with how often it occurred in the material that it was learnt from.
struct LearntFigure {
    const motion::FigureModel* model = nullptr;  ///< never null; must outlive the call
    double seen = 1.0;   ///< occurrences; the figure's weight in a new rule of the grammar
    std::string next{};  ///< the figure that always comes after it; empty: any may
};

/// What a new grammar says beside its figures.
struct NewGrammar {
    motion::FigureGrammar::Starts starts = motion::FigureGrammar::Starts::common;
    std::optional<motion::CoupleForm> couple;  ///< none: nothing
};

/// Makes the folder or adds to it: writes the figures' files, lists the dance where it is not
/// listed, and adds a rule for each figure that the grammar lacks. Text that is there stays as a
/// person has edited it; `grammar` counts where there is none yet. `dance` with `extends`:
/// the figures join that dance; their models are of that dance. The folder changes as a whole, so
/// that a process that is killed leaves the old one or the new one; where the system cannot do that
/// (no hard links; the current folder), file by file. Errors: a file that cannot be read
/// or written; a figure's name that cannot be part of a file's name. Threads: workers. Real-time:
/// no.
[[nodiscard]] Expected<void> add_to_folder(const std::filesystem::path& folder,
                                           const DanceInfo& dance,
                                           std::span<const LearntFigure> figures,
                                           const NewGrammar& grammar = {});

/// The same for a dance of cells: writes its file and lists it.
[[nodiscard]] Expected<void> add_to_folder(const std::filesystem::path& folder,
                                           const DanceInfo& dance,
                                           const motion::CellDance& cells);

}  // namespace raks::engine
