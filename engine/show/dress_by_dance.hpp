// What the mannequin wears where the dance chooses it (`--dress auto`).
#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "base/dance_list.hpp"
#include "engine/show/picture.hpp"
#include "engine/show/shown_moment.hpp"
#include "render/model/mannequin_style.hpp"

namespace raks::engine {

/// The costume that a dance asks for (DanceInfo::dress); the unitard where it asks for none or for
/// one that there is not. None: there is no such dance. Pure.
[[nodiscard]] std::optional<render::Costume> costume_for(const DanceList& dances, DanceId dance);

/// Puts the mannequins of a look into the costume of this dance, where the dance chooses it.
void dress_for(const DanceList& dances, std::string_view dance, Look& look);

/// A line for each dance that asks for a costume that there is not.
[[nodiscard]] std::vector<std::string> dress_notes(const DanceList& dances);

/// Follows a show and says when its mannequins should change their clothes: as they begin another
/// dance. Before the first dance begins they wear what is likely to be danced.
class DressByDance {
 public:
    /// `look`: says whether the dance chooses, which dance is asked for, and what is worn.
    explicit DressByDance(const Look& look);

    /// The costume that is to be put on now; none: they keep what they wear.
    [[nodiscard]] std::optional<render::Costume> next(const ShownMoment& shown,
                                                      const DanceList& dances);

 private:
    [[nodiscard]] DanceId dance_of(const ShownMoment& shown, const DanceList& dances) const;

    bool is_chosen_by_dance_;
    std::string asked_;  // dance; empty: none
    render::Costume worn_;
    bool is_decided_ = false;
};

}  // namespace raks::engine
