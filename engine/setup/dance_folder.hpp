#pragma once

#include <filesystem>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "base/dance_list.hpp"
#include "base/expected.hpp"
#include "motion/figures/figure_model.hpp"

/// A folder of dances: what lies where, and how a learnt figure gets there. The folder that comes
/// with Raks, a user's and one that is given to `--dance` are all alike:
///
///     dances.toml                     what each dance is (base/dance_list.hpp)
///     DANCE.toml                      which figure comes after which (figure_grammar.hpp)
///     DANCE_FIGURE_ROLE.json          a figure of angles
///     DANCE_FIGURE_ROLE_positions.json  the same of positions
namespace raks::engine {

[[nodiscard]] std::filesystem::path dances_path(const std::filesystem::path& folder);
[[nodiscard]] std::filesystem::path grammar_path(const std::filesystem::path& folder,
                                                 std::string_view dance);
[[nodiscard]] std::filesystem::path figure_path(const std::filesystem::path& folder,
                                                std::string_view dance,
                                                std::string_view figure,
                                                motion::DanceRole role,
                                                motion::FigureFeatures features);

/// A figure to be added, and how often it was seen in what it was learnt from.
struct LearntFigure {
    const motion::FigureModel* model = nullptr;
    double seen = 1.0;
};

/// Makes the folder, or adds to it: writes the figures, lists the dance where it is not listed, and
/// adds a rule for each figure that the grammar lacks. What a person has edited stays.
/// `dance`: with `extends`, its figures join that dance; their models are of that dance.
/// Errors: a file that cannot be read or written, a figure's name that is no part of a file's name.
/// Threads: workers. Real-time: no.
[[nodiscard]] Expected<void> add_to_folder(const std::filesystem::path& folder,
                                           const DanceInfo& dance,
                                           std::span<const LearntFigure> figures);

}  // namespace raks::engine
