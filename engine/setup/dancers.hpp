// Dancers: who dances what the settings ask for, and for which bodies it is solved.
#pragma once

#include <atomic>
#include <cstddef>
#include <cstdint>
#include <future>
#include <memory>
#include <string>
#include <vector>

#include "base/expected.hpp"
#include "engine/setup/dance_catalogue.hpp"
#include "engine/setup/settings.hpp"
#include "motion/dance_library.hpp"
#include "motion/ensemble.hpp"
#include "motion/formation.hpp"
#include "motion/skeleton/skeleton.hpp"

namespace raks::engine {

/// One to motion::Ensemble::kMost dancers.
using Cast = std::vector<motion::EnsembleMember>;

/// A cast of one dancer who knows one dance. `seed`: of all random choices.
[[nodiscard]] Cast cast_of(std::shared_ptr<const motion::DanceLibrary> library,
                           const motion::Skeleton& skeleton,
                           std::uint64_t seed,
                           motion::Dynamics dynamics = motion::Dynamics::on);

/// A body that dances, and what of a dance that has both.
struct BodyOfMaterial {
    motion::Skeleton skeleton;
    Material material = Material::people;

    [[nodiscard]] bool operator==(const BodyOfMaterial&) const = default;
};

/// Of the bodies that dancers have in turn, at least one, those that a formation dances with: two
/// of a couple, else all; where the settings ask for both materials, each body with the one and the
/// other, so that neighbours differ. Pure.
[[nodiscard]] std::vector<BodyOfMaterial> bodies_in(motion::Formation formation,
                                                    const std::vector<motion::Skeleton>& bodies,
                                                    const Settings& settings);

/// A wish that no more dances are begun to be solved: nobody waits for them any more. Shared by who
/// solves and who may wish; copies are the same wish, one that was moved from is nobody's. Threads:
/// any.
class StopSolving {
 public:
    void ask() const noexcept {
        if (is_asked_) {
            is_asked_->store(true, std::memory_order_relaxed);  // relaxed: a wish by itself
        }
    }
    [[nodiscard]] bool is_asked() const noexcept {
        return is_asked_ && is_asked_->load(std::memory_order_relaxed);  // relaxed: as above
    }

 private:
    std::shared_ptr<std::atomic<bool>> is_asked_ = std::make_shared<std::atomic<bool>>(false);
};

/// The dancers that the settings ask for: dance, figures, formation, generator and seed. The dance
/// that a show begins with is ready at once; with `dance = "auto"` a thread of its own solves all
/// others meanwhile and adds them to the repertoires. Each dance is solved once for each body that
/// differs. Threads: one owner.
class Dancers {
 public:
    /// Solves the first dance. `bodies`: those that dancers have in turn, at least one. `threads`:
    /// that solve dances, at least one. `stop`: ends it, with an error that nobody need read.
    /// Errors: as load_dance; an unknown formation.
    [[nodiscard]] static Expected<Dancers> load(const Settings& settings,
                                                const DanceCatalogue& catalogue,
                                                const std::vector<motion::Skeleton>& bodies,
                                                int threads = 1,
                                                const StopSolving& stop = StopSolving());

    /// The dancers; their repertoires grow until all dances are solved.
    [[nodiscard]] const Cast& cast() const noexcept { return cast_; }
    /// The bodies of the formation (bodies_in), and what they dance: for motion::members_of.
    [[nodiscard]] const std::vector<motion::DancingBody>& bodies() const noexcept {
        return bodies_;
    }
    /// The same by what they were loaded for.
    [[nodiscard]] const std::vector<BodyOfMaterial>& loaded_for() const noexcept {
        return loaded_for_;
    }
    /// No more dances are begun to be solved: nobody waits for them any more.
    void stop_solving() noexcept { stop_.ask(); }
    /// Whether that was asked for: some dances may never be there.
    [[nodiscard]] bool is_stopped() const noexcept { return stop_.is_asked(); }
    /// Whether all dances are solved, or no more will be: to be destroyed without waiting.
    [[nodiscard]] bool is_done() const;

    /// Waits until all dances are solved, which a reproducible film needs. Returns a line for each
    /// dance that was left out because a file of it is bad.
    [[nodiscard]] std::vector<std::string> wait();

 private:
    std::vector<motion::DancingBody> bodies_;
    std::vector<BodyOfMaterial> loaded_for_;
    Cast cast_;
    StopSolving stop_;  // shared with the thread that solves
    std::future<std::vector<std::string>> others_;
};

}  // namespace raks::engine
