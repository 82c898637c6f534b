#pragma once

#include <future>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "base/expected.hpp"
#include "engine/setup/dance_files.hpp"
#include "engine/setup/settings.hpp"
#include "motion/ensemble.hpp"

namespace raks::engine {

/// The dancers, in a formation that can be changed while a show runs. One of a couple dances
/// otherwise than one alone: the first change to or from a couple solves those dances on a thread
/// of its own; any other change is ready at once. Threads: one owner.
class Formations {
 public:
    /// Starts with the settings' formation. Errors: those of Dancers::load.
    [[nodiscard]] static Expected<Formations> load(const Settings& settings,
                                                   const DanceCatalogue& catalogue,
                                                   const motion::Skeleton& skeleton);

    /// Name of the formation that is danced, which may not yet be the one asked for.
    [[nodiscard]] std::string_view name() const noexcept;
    /// The dancers of that formation.
    [[nodiscard]] const Cast& cast() const noexcept { return cast_; }

    /// Asks for the formation that follows the one asked for last, cyclically; returns its name.
    std::string_view ask_for_next();
    /// True once, when the formation asked for is ready, in cast() and name(). Errors: the dance
    /// has no figures for it (reported once; the formation before goes on).
    [[nodiscard]] Expected<bool> poll();

    /// Waits until all dances are solved, which a reproducible film needs. Returns lines as
    /// Dancers::wait.
    [[nodiscard]] std::vector<std::string> wait();

 private:
    Formations(Settings settings, DanceCatalogue catalogue, Dancers dancers);
    [[nodiscard]] bool has_dancers_for(motion::Formation formation) const noexcept;
    void load_dancers_for(motion::Formation formation);
    [[nodiscard]] Expected<void> take_loaded();
    void form();

    Settings settings_;
    DanceCatalogue catalogue_;
    motion::Formation danced_;
    motion::Formation asked_;
    bool is_waiting_ = false;  // for the formation asked for
    Cast cast_;
    std::optional<Dancers> alone_;
    std::optional<Dancers> couple_;
    std::future<Expected<Dancers>> loading_;
    motion::Formation loading_for_ = motion::Formation::solo;
};

}  // namespace raks::engine
