#pragma once

#include <cstdint>
#include <filesystem>
#include <memory>
#include <string>
#include <string_view>
#include <vector>

#include "base/dance_list.hpp"
#include "base/expected.hpp"
#include "motion/dance/generator.hpp"
#include "motion/figures/figure_grammar.hpp"
#include "motion/figures/figure_model.hpp"

namespace raks::engine {

/// Where the files of a dance come from.
enum class DanceOrigin : std::uint8_t {
    given,    ///< a folder that the command line names
    user,     ///< below user_dances_path()
    shipped,  ///< models/trained of the installation, or below $RAKS_DATA
};

/// One dance that can be asked for.
struct CatalogueEntry {
    DanceInfo info;
    DanceOrigin origin = DanceOrigin::shipped;
    std::filesystem::path folder;
    std::vector<std::filesystem::path> extensions;  ///< folders whose figures join it
};

/// Who one dances with: one of a couple leaves the other room.
enum class Company : std::uint8_t { alone, couple };

/// In which of its forms a dance is danced.
struct DanceForm {
    motion::FigureFeatures features = motion::FigureFeatures::angles;
    motion::Generator generator = motion::Generator::trajectories;
    Company company = Company::alone;
};

/// What a dance is made from: how its figures follow one another, and their files by rule of the
/// grammar.
struct DancePlan {
    motion::DanceRole role = motion::DanceRole::lead;
    motion::FigureGrammar grammar;
    std::vector<std::filesystem::path> files;
};

/// The same with the figures read.
struct DanceParts {
    motion::FigureGrammar grammar;
    std::vector<motion::FigureModel> figures;
};

/// Where a user's dances lie, a folder for each: $XDG_DATA_HOME/raks/dances, or below
/// ~/.local/share. Empty: there is no home.
[[nodiscard]] std::filesystem::path user_dances_path();

/// All dances that can be found, in this order: the given folder, the user's by name, those that
/// come with Raks. A dance that is found before shadows one of the same name. What cannot be read
/// is left out, and said.
/// Immutable once loaded. Threads: any may read.
class DanceCatalogue {
 public:
    /// `given`: a folder of dances besides; empty: none. Errors: `given` cannot be read; no dance
    /// anywhere.
    [[nodiscard]] static Expected<DanceCatalogue> load(const std::filesystem::path& given = {});

    /// Those that come with Raks first, then the others by name; at most kMostDances.
    [[nodiscard]] const std::shared_ptr<const DanceList>& list() const noexcept { return list_; }
    /// By the numbers of list().
    [[nodiscard]] const std::vector<CatalogueEntry>& entries() const noexcept { return entries_; }
    /// The one of the list; null: no such dance.
    [[nodiscard]] const CatalogueEntry* find(std::string_view name) const noexcept;
    /// The first dance of the given folder; empty: no folder was given.
    [[nodiscard]] const std::string& given_dance() const noexcept { return given_dance_; }
    /// The two that reports compare; empty: none.
    [[nodiscard]] const std::vector<std::string>& pair() const noexcept { return pair_; }
    /// What a user should know once: what was shadowed or left out and why, a line each.
    [[nodiscard]] const std::vector<std::string>& notes() const noexcept { return notes_; }

    /// Errors: no such dance (the nearest is named), a grammar that is bad, a figure that has no
    /// file.
    [[nodiscard]] Expected<DancePlan> plan(std::string_view name,
                                           motion::DanceRole role,
                                           const DanceForm& form) const;

    /// Errors: as plan(); a file of it that is bad, a figure
    /// that its file's name does not say.
    [[nodiscard]] Expected<DanceParts> read(std::string_view name,
                                            motion::DanceRole role,
                                            const DanceForm& form) const;

 private:
    void add_folder(const std::filesystem::path& folder, DanceOrigin origin);
    void add(CatalogueEntry entry);
    void join_extensions();
    void number_dances();

    std::vector<CatalogueEntry> entries_;
    std::vector<CatalogueEntry> joining_;  // extend others
    std::shared_ptr<const DanceList> list_;
    std::string given_dance_;
    std::vector<std::string> pair_;
    std::vector<std::string> notes_;
};

/// Errors: a file that is bad, a figure that its file's name does not say.
[[nodiscard]] Expected<DanceParts> read_figures(DancePlan plan);

}  // namespace raks::engine
