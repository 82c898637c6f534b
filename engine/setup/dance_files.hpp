#pragma once

#include <atomic>
#include <cstdint>
#include <filesystem>
#include <future>
#include <memory>
#include <string>
#include <string_view>
#include <vector>

#include "base/expected.hpp"
#include "engine/setup/dance_catalogue.hpp"
#include "engine/setup/settings.hpp"
#include "motion/dance_library.hpp"
#include "motion/ensemble.hpp"
#include "motion/skeleton/skeleton.hpp"

namespace raks::engine {

/// Keeps solved dances between runs, so that a command need not solve them again. One file a dance;
/// its name contains a hash of everything that determines the result: the bytes of its figures, its
/// grammar, the skeleton, the form and the program itself. A file that is damaged counts as
/// missing, and one that cannot be written is left out; neither is an error. Several processes may
/// use a folder at once. Threads: any. Real-time: no.
class DanceCache {
 public:
    /// A cache in this folder. Empty: finds nothing and keeps nothing.
    explicit DanceCache(std::filesystem::path folder) : folder_(std::move(folder)) {}
    /// The cache of the user: $XDG_CACHE_HOME/raks/dances, or below ~/.cache.
    [[nodiscard]] static DanceCache of_user();

    /// The file of a dance that is solved for this skeleton in this form. Empty: there is no cache,
    /// or a file of the plan cannot be read.
    [[nodiscard]] std::filesystem::path path_of(const DancePlan& plan,
                                                const motion::Skeleton& skeleton,
                                                const DanceForm& form) const;
    /// The dance of a file; null: there is no such file, or it is damaged.
    [[nodiscard]] static std::shared_ptr<const motion::DanceLibrary> find(
        const std::filesystem::path& path,
        const motion::Skeleton& skeleton,
        const motion::FigureGrammar& grammar);
    /// Writes a dance to its file, and removes older files of the same dance, role, form and body;
    /// of all avatars' bodies together the last 24 stay.
    static void keep(const std::filesystem::path& path, const motion::DanceLibrary& library);

 private:
    std::filesystem::path folder_;
};

/// Checks the names of the settings. Errors: `settings.dance` is neither a known dance nor "auto";
/// the fallback is neither a known dance nor "first", "keep" or "stand". The nearest name is
/// suggested.
[[nodiscard]] Expected<void> check_dances(const Settings& settings, const DanceList& dances);

/// The same against all dances that were found. Where the dance that is missing, or the dances that
/// come with Raks, could not be read, the error says that first.
[[nodiscard]] Expected<void> check_dances(const Settings& settings,
                                          const DanceCatalogue& catalogue);

/// The dance that a show begins with: `settings.dance`; where that is "auto", the fallback; where
/// that is no dance either, the first of the list.
[[nodiscard]] std::string dance_to_load(const Settings& settings, const DanceList& dances);

/// The form that the settings ask for by figures, generator ("frames" is the paper's; everything
/// else that passed validate() is ours) and formation.
[[nodiscard]] DanceForm form_of(const Settings& settings);

/// Whether the settings ask for dynamics.
[[nodiscard]] motion::Dynamics dynamics_of(const Settings& settings);

/// Reads the trained figures of a dance and solves them for a skeleton; figures of positions where
/// the dance has such, else of angles. A dance that an earlier run solved is taken from the cache.
/// Errors: as DanceCatalogue::read and DanceLibrary::build. Threads: workers. Real-time: no.
[[nodiscard]] Expected<std::shared_ptr<const motion::DanceLibrary>> load_dance(
    const DanceCatalogue& catalogue,
    std::string_view dance,
    const motion::Skeleton& skeleton,
    motion::DanceRole role = motion::DanceRole::lead,
    const DanceForm& form = {},
    const DanceCache& cache = DanceCache::of_user());

/// The dancers, and the skeleton that their dances were solved for.
struct Cast {
    std::vector<motion::EnsembleMember> members;  ///< one to Ensemble::kMost dancers
    motion::Skeleton skeleton;                    ///< the same for all of them
};
/// A cast of one dancer who knows one dance. `seed`: of all random choices.
[[nodiscard]] Cast cast_of(std::shared_ptr<const motion::DanceLibrary> library,
                           const motion::Skeleton& skeleton,
                           std::uint64_t seed,
                           motion::Dynamics dynamics = motion::Dynamics::on);

/// The dancers that the settings ask for: dance, figures, formation, generator and seed. The dance
/// that a show begins with is ready at once; with `dance = "auto"` a thread of its own solves all
/// others meanwhile and adds them to the repertoires. Threads: one owner.
class Dancers {
 public:
    /// Solves the first dance. Errors: as load_dance; an unknown formation.
    [[nodiscard]] static Expected<Dancers> load(const Settings& settings,
                                                const DanceCatalogue& catalogue,
                                                const motion::Skeleton& skeleton);

    /// The dancers; their repertoires grow until all dances are solved.
    [[nodiscard]] const Cast& cast() const noexcept { return cast_; }
    /// No more dances are begun to be solved: nobody waits for them any more.
    void stop_solving() noexcept;
    /// Whether stop_solving() was called: some dances may never be there.
    [[nodiscard]] bool is_stopped() const noexcept;
    /// Whether all dances are solved, or no more will be: to be destroyed without waiting.
    [[nodiscard]] bool is_done() const;

    /// Waits until all dances are solved, which a reproducible film needs. Returns a line for each
    /// dance that was left out because a file of it is bad.
    [[nodiscard]] std::vector<std::string> wait();

 private:
    Cast cast_;
    // Shared with the thread that solves.
    std::shared_ptr<std::atomic<bool>> is_stopped_ = std::make_shared<std::atomic<bool>>(false);
    std::future<std::vector<std::string>> others_;
};

}  // namespace raks::engine
