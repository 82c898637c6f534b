#pragma once

#include <cstddef>
#include <functional>
#include <memory>
#include <string>
#include <string_view>
#include <vector>

#include "base/dance_list.hpp"
#include "base/expected.hpp"
#include "engine/control/action_dispatcher.hpp"
#include "engine/control/live_actions.hpp"
#include "engine/live/motion_stage.hpp"
#include "engine/setup/settings.hpp"
#include "engine/show/list_panel.hpp"
#include "motion/repertoire.hpp"

namespace raks::apps {

/// Which dance is danced by a person's choice, and which are forbidden; kept from file to file, and
/// told to dancers who replace others. Threads: main.
class DanceChoice {
 public:
    /// What the dancers are and do now.
    struct Dancers {
        const motion::Repertoire* repertoire = nullptr;  ///< of the first of them
        motion::DancerStatus status;                     ///< likewise
    };
    /// `settings` and `actions` must outlive this. `look` is asked while a graph runs.
    DanceChoice(const engine::Settings& settings,
                std::shared_ptr<const DanceList> dances,
                engine::LiveActions& actions,
                std::function<Dancers()> look,
                engine::SayLine say);

    /// Other dances are known from here on; what was chosen of those before is forgotten.
    void set_dances(std::shared_ptr<const DanceList> dances);
    /// Tells dancers who have just replaced others.
    void brief_dancers();

    /// The dance that is chosen; none: as it is recognised.
    [[nodiscard]] DanceId selected() const noexcept { return selected_; }
    /// Its name, or that of the settings; empty: none is chosen.
    [[nodiscard]] std::string_view name() const;
    /// The names of the forbidden ones.
    [[nodiscard]] std::vector<std::string> forbidden() const;

    /// The next of the list; after the last the recognised one.
    void select_next();
    /// The one of this name, allowed or not; empty or "auto": the recognised one. Errors: there is
    /// none; only one is danced.
    [[nodiscard]] Expected<void> select(std::string_view name);
    /// Goes on to the figure of this name at the end of the one that is danced. Errors: the dance
    /// has none; nobody dances.
    [[nodiscard]] Expected<void> select_figure(std::string_view name);
    /// Forbids or allows the one of this name. Errors: there is none; it is the last allowed one.
    [[nodiscard]] Expected<void> allow(std::string_view name, bool is_allowed);
    /// These are forbidden and no others; unknown names are passed over.
    void forbid_only(const std::vector<std::string>& names);

    /// The list of dances, below each that is danced its figures. This must outlive it.
    [[nodiscard]] std::unique_ptr<engine::ListOffer> offer();

 private:
    class Offer;
    [[nodiscard]] Expected<DanceId> find(std::string_view name) const;
    [[nodiscard]] bool is_fixed() const { return settings_.dance != "auto"; }
    [[nodiscard]] std::string fixed_line() const;
    void select(DanceId dance);
    [[nodiscard]] Expected<void> allow(DanceId dance, bool is_allowed);

    const engine::Settings& settings_;
    std::shared_ptr<const DanceList> dances_;
    engine::LiveActions& actions_;
    std::function<Dancers()> look_;
    engine::SayLine say_;
    DanceId selected_ = DanceId::none;  // none: the recognised one
    motion::DanceSet forbidden_;
};

}  // namespace raks::apps
