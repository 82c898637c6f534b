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

/// The dancers, in a formation and for a body that can be changed while a show runs. One of a
/// couple dances otherwise than one alone: the first change to or from a couple solves those dances
/// on a thread of its own, and so does a change of the body; any other change is ready at once.
/// Threads: one owner.
class Formations {
 public:
    /// What has become ready.
    enum class Change {
        none,
        formation,  ///< other dancers, who begin anew
        body,       ///< the same dance for another body, which can be gone on with
    };

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
    /// Asks for the same dances solved for another body, that stands as high as the one before
    /// (render::dance_body). Until they are, the dance goes on as it is.
    void ask_for_body(const motion::Skeleton& body);
    /// Other than none once, when what was asked for is ready, in cast() and name(). `danced`: the
    /// dance that is danced, if any, which a body does not leave before it is solved for the other
    /// one. Errors: the dance has no figures for it (reported once; what was goes on).
    [[nodiscard]] Expected<Change> poll(DanceId danced = DanceId::none);

    /// Whether a thread solves what was asked for.
    [[nodiscard]] bool is_loading() const noexcept { return loading_.valid(); }

    /// Waits until all dances are solved, which a reproducible film needs. Returns lines as
    /// Dancers::wait.
    [[nodiscard]] std::vector<std::string> wait();

 private:
    Formations(Settings settings, DanceCatalogue catalogue, Dancers dancers);
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
    bool is_waiting_ = false;  // for the formation or the body asked for
    Cast cast_;
    motion::Skeleton body_;  // asked for
    std::optional<Dancers> alone_;
    std::optional<Dancers> couple_;
    std::future<Expected<Dancers>> loading_;
    motion::Formation loading_for_ = motion::Formation::solo;
    // Whose threads still solve the dance that they had begun.
    std::vector<Dancers> dismissed_;
};

}  // namespace raks::engine
