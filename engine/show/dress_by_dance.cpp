#include "engine/show/dress_by_dance.hpp"

#include <utility>

#include "base/printable.hpp"

#include <fmt/format.h>

namespace raks::engine {

std::optional<render::Costume> costume_for(const DanceList& dances, DanceId dance) {
    const DanceInfo* const info = dances.find(dance);
    if (info == nullptr) {
        return std::nullopt;
    }
    return render::find_costume(info->dress).value_or(render::Costume::unitard);
}

void dress_for(const DanceList& dances, std::string_view dance, Look& look) {
    const auto costume = costume_for(dances, dances.id_of(dance));
    if (look.dresses_by_dance && costume && *costume != look.costume) {
        look.costume = *costume;
        look.avatars = dressed(std::move(look.avatars), *costume);
    }
}

std::vector<std::string> dress_notes(const DanceList& dances) {
    std::vector<std::string> notes;
    for (const DanceInfo& dance : dances.all()) {
        if (!dance.dress.empty() && !render::find_costume(dance.dress)) {
            notes.push_back(fmt::format("{}: there is no dress \"{}\"; the mannequin wears \"{}\"",
                                        dance.name,
                                        printable(dance.dress),
                                        render::name_of(render::Costume::unitard)));
        }
    }
    return notes;
}

DressByDance::DressByDance(const Look& look)
    : is_chosen_by_dance_(look.dresses_by_dance), asked_(look.dance), worn_(look.costume) {}

DanceId DressByDance::dance_of(const ShownMoment& shown, const DanceList& dances) const {
    if (shown.dancer.is_dancing) {
        return shown.dancer.dance;
    }
    if (is_decided_) {
        return DanceId::none;
    }
    const DanceId asked = dances.id_of(asked_);
    return asked == DanceId::none ? shown.music.genre : asked;
}

std::optional<render::Costume> DressByDance::next(const ShownMoment& shown,
                                                  const DanceList& dances) {
    if (!is_chosen_by_dance_) {
        return std::nullopt;
    }
    const auto costume = costume_for(dances, dance_of(shown, dances));
    is_decided_ = is_decided_ || costume;
    if (!costume || *costume == worn_) {
        return std::nullopt;
    }
    worn_ = *costume;
    return costume;
}

}  // namespace raks::engine
