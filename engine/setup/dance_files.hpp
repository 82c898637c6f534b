#pragma once

#include <cstdint>
#include <future>
#include <memory>
#include <string>
#include <string_view>
#include <vector>

#include "base/expected.hpp"
#include "engine/setup/dance_cache.hpp"
#include "engine/setup/dance_catalogue.hpp"
#include "engine/setup/settings.hpp"
#include "motion/ensemble.hpp"
#include "motion/skeleton/skeleton.hpp"

namespace raks::engine {

/// Errors: `settings.dance` is neither known nor "auto", or its fallback neither known nor "first",
/// "keep" or "stand"; the nearest is named.
[[nodiscard]] Expected<void> check_dances(const Settings& settings, const DanceList& dances);

/// The dance that a show begins with: `settings.dance`, where that is "auto" the fallback, and
/// where that is no dance the first of the list.
[[nodiscard]] std::string dance_to_load(const Settings& settings, const DanceList& dances);

/// By the settings' figures, generator ("frames" is the paper's; all else that passed validate() is
/// ours) and formation.
[[nodiscard]] DanceForm form_of(const Settings& settings);

/// Reads the trained figures of a dance and solves them for a skeleton; of positions where it has
/// such, else of angles. What a run before solved is taken from the cache.
/// Errors: as DanceCatalogue::read and DanceLibrary::build.
[[nodiscard]] Expected<std::shared_ptr<const motion::DanceLibrary>> load_dance(
    const DanceCatalogue& catalogue,
    std::string_view dance,
    const motion::Skeleton& skeleton,
    motion::DanceRole role = motion::DanceRole::lead,
    const DanceForm& form = {},
    const DanceCache& cache = DanceCache::of_user());

/// Who dances, and the body that their dances were solved for.
struct Cast {
    std::vector<motion::EnsembleMember> members;
    motion::Skeleton skeleton;
};
/// One dancer alone.
[[nodiscard]] Cast cast_of(std::shared_ptr<const motion::DanceLibrary> library,
                           const motion::Skeleton& skeleton,
                           std::uint64_t seed);

/// Who dances, by the settings: dance, figures, formation, generator and seed. The dance that a
/// show begins with is there at once; with `dance = "auto"` a thread of its own solves all others
/// meanwhile, so that a show begins at once. Threads: one owner.
class Dancers {
 public:
    /// Errors: as load_dance, an unknown formation.
    [[nodiscard]] static Expected<Dancers> load(const Settings& settings,
                                                const DanceCatalogue& catalogue,
                                                const motion::Skeleton& skeleton);

    [[nodiscard]] const Cast& cast() const noexcept { return cast_; }
    /// Waits until all dances are there: the same film again needs that. Returns a line for each
    /// that was left out: a file of it is bad.
    [[nodiscard]] std::vector<std::string> wait();

 private:
    Cast cast_;
    std::future<std::vector<std::string>> others_;
};

}  // namespace raks::engine
