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

/// Who dances, in a formation that may be changed while a show runs. One of a couple dances other
/// ways than one alone, so that a change to or from couples loads dances, once, on a thread of its
/// own; between the others it is there at once. Threads: one owner.
class Formations {
 public:
    /// Begins with the settings' formation. Errors: those of Dancers::load.
    [[nodiscard]] static Expected<Formations> load(const Settings& settings,
                                                   const DanceCatalogue& catalogue,
                                                   const motion::Skeleton& skeleton);

    /// Name of the formation that is danced.
    [[nodiscard]] std::string_view name() const noexcept;
    [[nodiscard]] const Cast& cast() const noexcept { return cast_; }

    /// Asks for the formation after the one that was asked for last, round and round; its name.
    std::string_view ask_for_next();
    /// True, once: what was asked for is there, in cast() and name(). Errors: the dance has no
    /// figures for it (told once; what was danced before goes on).
    [[nodiscard]] Expected<bool> poll();

    /// Waits until all dances are there: the same dance again needs that. Lines as Dancers::wait.
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
    bool is_waiting_ = false;  // for what was asked
    Cast cast_;
    std::optional<Dancers> alone_;
    std::optional<Dancers> couple_;
    std::future<Expected<Dancers>> loading_;
    motion::Formation loading_for_ = motion::Formation::solo;
};

}  // namespace raks::engine
