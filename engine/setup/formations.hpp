#pragma once

#include <future>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "base/expected.hpp"
#include "engine/setup/dancers.hpp"
#include "engine/setup/settings.hpp"
#include "motion/ensemble.hpp"

namespace raks::engine {

/// The dancers, in a formation and for bodies that can be changed while a show runs. One of a
/// couple dances otherwise than one alone: the first change to or from a couple solves those dances
/// on a thread of its own, and so does a change of the bodies; any other change is ready at once.
/// Threads: one owner.
class Formations {
 public:
    /// What has become ready.
    enum class Change {
        none,
        formation,  ///< other dancers, who begin anew
        bodies,     ///< the same dance for other bodies, which can be gone on with
    };

    /// Starts with the settings' formation. `bodies`: those that dancers have in turn, at least
    /// one. Errors: those of Dancers::load.
    [[nodiscard]] static Expected<Formations> load(const Settings& settings,
                                                   const DanceCatalogue& catalogue,
                                                   const std::vector<motion::Skeleton>& bodies);

    /// Name of the formation that is danced, which may not yet be the one asked for.
    [[nodiscard]] std::string_view name() const noexcept;
    /// The dancers of that formation.
    [[nodiscard]] const Cast& cast() const noexcept { return cast_; }

    /// Asks for the formation that follows the one asked for last, cyclically; returns its name.
    std::string_view ask_for_next();
    /// Asks for the one of this name. Errors: there is none.
    [[nodiscard]] Expected<void> ask_for(std::string_view name);
    /// Asks for the same dances solved for other bodies, which dancers have in turn, and which
    /// stand as high as those before (render::dance_body). Until they are, the dance goes on as it
    /// is.
    void ask_for_bodies(const std::vector<motion::Skeleton>& bodies);
    /// Other than none once, when what was asked for is ready, in cast() and name(). `danced`: the
    /// dance that is danced, if any, which is not left before it is solved for the other bodies.
    /// Errors: the dance has no figures for them (reported once; what was goes on).
    [[nodiscard]] Expected<Change> poll(DanceId danced = DanceId::none);

    /// Whether a thread solves what was asked for.
    [[nodiscard]] bool is_loading() const noexcept { return loading_.valid(); }

    /// Waits until all dances are solved, which a reproducible film needs. Returns lines as
    /// Dancers::wait.
    [[nodiscard]] std::vector<std::string> wait();

    /// Waits for the dance that is being solved, if any, and for no more.
    ~Formations();
    Formations(Formations&&) = default;            ///< the other one may only be destroyed
    Formations& operator=(Formations&&) = delete;  ///< threads solve for one of them

 private:
    Formations(Settings settings,
               DanceCatalogue catalogue,
               Dancers dancers,
               std::vector<motion::Skeleton> bodies);
    [[nodiscard]] bool has_dancers_for(motion::Formation formation) const noexcept;
    [[nodiscard]] std::optional<Dancers>& dancers_for(motion::Formation formation) noexcept;
    [[nodiscard]] bool knows(DanceId dance) const noexcept;
    void load_dancers_for(motion::Formation formation);
    [[nodiscard]] Expected<void> take_loaded();
    void dismiss(std::optional<Dancers>& dancers);
    void free_dismissed();
    [[nodiscard]] Change form();

    Settings settings_;
    DanceCatalogue catalogue_;
    motion::Formation danced_;
    motion::Formation asked_;
    bool is_waiting_ = false;  // for the formation or the bodies asked for
    Cast cast_;
    std::vector<motion::Skeleton> bodies_;         // asked for
    std::vector<motion::Skeleton> danced_bodies_;  // of the cast
    std::optional<Dancers> alone_;
    std::optional<Dancers> couple_;
    std::future<Expected<Dancers>> loading_;
    StopSolving loading_stop_;
    motion::Formation loading_for_ = motion::Formation::solo;
    // Whose threads still solve the dance that they had begun.
    std::vector<Dancers> dismissed_;
};

}  // namespace raks::engine
