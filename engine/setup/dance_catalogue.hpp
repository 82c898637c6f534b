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
#include "motion/figures/dance_mood.hpp"
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
    DanceInfo info;                                 ///< name, metre, tempi and music of the dance
    DanceOrigin origin = DanceOrigin::shipped;      ///< which of the three sources has it
    std::filesystem::path folder;                   ///< that holds its grammar and figures
    std::vector<std::filesystem::path> extensions;  ///< folders whose figures are added to it
    bool has_cells = false;                         ///< of whole takes of people: a file of cells
    bool has_figures = false;                       ///< a grammar; a dance may have both
    motion::DanceMood mood{};                       ///< of its dancers' faces
};

/// Whether a dancer dances alone or as one of a couple, where each leaves the other room.
enum class Company : std::uint8_t { alone, couple };

/// What is danced of a dance that has both: whole takes of people, or its figures.
enum class Material : std::uint8_t { people, written };

/// The form in which a dance is solved.
struct DanceForm {
    /// What the figures were learnt as.
    motion::FigureFeatures features = motion::FigureFeatures::angles;
    /// How a figure's model becomes motion.
    motion::Generator generator = motion::Generator::trajectories;
    Company company = Company::alone;      ///< alone or one of a couple
    Material material = Material::people;  ///< where the dance has both
};

/// The sources of a dance: how its figures follow one another, and the file of each figure.
struct DancePlan {
    motion::DanceRole role = motion::DanceRole::lead;  ///< whose part
    motion::FigureGrammar grammar;                     ///< with the rules of the extensions
    std::vector<std::filesystem::path> files;  ///< one for each rule of the grammar, in its order
};

/// The same with the figures' files read.
struct DanceParts {
    motion::FigureGrammar grammar;             ///< as in the plan
    std::vector<motion::FigureModel> figures;  ///< one for each rule of the grammar, in its order
};

/// Where a user's dances lie, one folder for each: $XDG_DATA_HOME/raks/dances, or below
/// ~/.local/share. Empty: neither variable names an absolute path.
[[nodiscard]] std::filesystem::path user_dances_path();

/// All dances that can be found, searched in this order: the given folder, the user's folders by
/// name, the shipped ones. The first dance of a name hides later ones. A dance that cannot be read
/// is left out, and notes() says so. Immutable once loaded. Threads: any may read.
class DanceCatalogue {
 public:
    /// `given`: one more folder of dances; empty: none. Errors: `given` cannot be read or lists no
    /// dance of its own; there is no dance anywhere.
    [[nodiscard]] static Expected<DanceCatalogue> load(const std::filesystem::path& given = {});

    /// The shipped dances first, then the given and the user's; at most kMostDances.
    [[nodiscard]] const std::shared_ptr<const DanceList>& list() const noexcept { return list_; }
    /// The entries, indexed as list().
    [[nodiscard]] const std::vector<CatalogueEntry>& entries() const noexcept { return entries_; }
    /// The entry of a name; null: there is no such dance.
    [[nodiscard]] const CatalogueEntry* find(std::string_view name) const noexcept;
    /// Name of the given folder's first dance; empty: no folder was given.
    [[nodiscard]] const std::string& given_dance() const noexcept { return given_dance_; }
    /// The two dances that reports compare; empty: the shipped dances.toml names none.
    [[nodiscard]] const std::vector<std::string>& pair() const noexcept { return pair_; }
    /// What a person should be told once: each dance that is hidden or left out, and why; a line
    /// each.
    [[nodiscard]] const std::vector<std::string>& notes() const noexcept { return notes_; }

    /// Why a dance cannot be danced by a couple: "X is danced alone", and which others can be.
    [[nodiscard]] Error danced_alone(std::string_view name) const;

    /// The grammar of a dance with its extensions, and the file of each figure. Errors: an unknown
    /// dance (the nearest is named), a bad grammar, a figure without a file.
    [[nodiscard]] Expected<DancePlan> plan(std::string_view name,
                                           motion::DanceRole role,
                                           const DanceForm& form) const;

    /// The same with the figures read. Errors: as plan() and read_figures().
    [[nodiscard]] Expected<DanceParts> read(std::string_view name,
                                            motion::DanceRole role,
                                            const DanceForm& form) const;

 private:
    void add_folder(const std::filesystem::path& folder, DanceOrigin origin);
    void add(CatalogueEntry entry);
    void join_extensions();
    void number_dances();

    std::vector<CatalogueEntry> entries_;
    std::vector<CatalogueEntry> joining_;  // those that extend another dance
    std::shared_ptr<const DanceList> list_;
    std::string given_dance_;
    std::vector<std::string> pair_;
    std::vector<std::string> notes_;
};

/// Whether a dance is danced of cells in this form, else of figures. A dance that has both is
/// danced of figures where its cells cannot be what is asked for: for a couple or a follow, by the
/// paper's generator, of positions. Pure.
[[nodiscard]] bool is_of_cells(const CatalogueEntry& entry,
                               motion::DanceRole role,
                               const DanceForm& form) noexcept;

/// Reads the figures of a plan. Errors: a bad file, a file whose figure or role is not the one that
/// its name says.
[[nodiscard]] Expected<DanceParts> read_figures(DancePlan plan);

}  // namespace raks::engine
