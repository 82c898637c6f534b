#pragma once

#include <cstddef>
#include <memory>
#include <string>
#include <string_view>
#include <vector>

#include "base/expected.hpp"
#include "engine/setup/analyzer_setup.hpp"
#include "engine/setup/dance_cache.hpp"
#include "engine/setup/dance_catalogue.hpp"
#include "engine/setup/settings.hpp"
#include "motion/dance/dancer_part.hpp"
#include "motion/dance_library.hpp"
#include "motion/repertoire.hpp"
#include "motion/skeleton/skeleton.hpp"

namespace raks::engine {

/// Checks the names of the settings. Errors: `settings.dance` is neither a known dance nor "auto";
/// the fallback is neither a known dance nor "first", "keep" or "stand". The nearest name is
/// suggested.
[[nodiscard]] Expected<void> check_dances(const Settings& settings, const DanceList& dances);

/// The same against all dances that were found. Where the dance that is missing, or the dances that
/// come with Raks, could not be read, the error says that first.
[[nodiscard]] Expected<void> check_dances(const Settings& settings,
                                          const DanceCatalogue& catalogue);

/// The dance that a show begins with: `settings.dance`; where that is "auto", the fallback; where
/// that is no dance, or none in the form that is asked for, or is forbidden, the first that is one;
/// where there is none, the fallback or the first, and loading it says why not.
[[nodiscard]] std::string dance_to_load(const Settings& settings, const DanceCatalogue& catalogue);

/// The dances that are solved while the show runs: with "auto" all but the first that can be danced
/// in the form that is asked for, by couples and by the generator, and is not forbidden; else none.
[[nodiscard]] std::vector<std::string> other_dances_to_load(const Settings& settings,
                                                            const DanceCatalogue& catalogue);

/// What is danced while no dance is recognised; where the settings name a dance, it is the first
/// (dance_to_load).
[[nodiscard]] motion::Repertoire::Fallback fallback_of(const Settings& settings);

/// The form that the settings ask for by figures, generator ("frames" is the paper's; everything
/// else that passed validate() is ours), formation and material, which is the first dancer's.
[[nodiscard]] DanceForm form_of(const Settings& settings);

/// What a dancer dances of a dance that has both. With "both" it changes from dancer to dancer, and
/// the seed says what the first one dances: an odd one people's takes. Pure.
[[nodiscard]] Material material_of(const Settings& settings, std::size_t dancer) noexcept;

/// What a person is told once: that the dance which is named is danced of figures, as takes cannot
/// be what is asked for; that dances have no figures; and which are left out, as their takes cannot
/// be what is asked for; a line each.
[[nodiscard]] std::vector<std::string> material_notes(const Settings& settings,
                                                      const DanceCatalogue& catalogue);

/// What a person is told once of the holds of the couples' dances that will be loaded: those that
/// cannot be read, and what is danced instead; a line each. None for other formations.
[[nodiscard]] std::vector<std::string> hold_notes(const Settings& settings,
                                                  const DanceCatalogue& catalogue);

/// What the settings allow to help to tell a dance.
[[nodiscard]] GenreAids genre_aids_of(const Settings& settings);
/// Whether the settings ask for dynamics.
[[nodiscard]] motion::Dynamics dynamics_of(const Settings& settings);

/// Reads the trained figures of a dance, or its cells (is_of_cells), and solves them for a
/// skeleton; figures of positions where the dance has such, else of angles. A dance that an earlier
/// run solved is taken from the cache. Errors: as DanceCatalogue::read and DanceLibrary::build.
/// Threads: workers. Real-time: no.
[[nodiscard]] Expected<std::shared_ptr<const motion::DanceLibrary>> load_dance(
    const DanceCatalogue& catalogue,
    std::string_view dance,
    const motion::Skeleton& skeleton,
    motion::DanceRole role = motion::DanceRole::lead,
    const DanceForm& form = {},
    const DanceCache& cache = DanceCache::of_user());

}  // namespace raks::engine
