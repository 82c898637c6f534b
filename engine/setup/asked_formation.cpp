#include "engine/setup/asked_formation.hpp"

#include <algorithm>

#include "base/assert.hpp"

namespace raks::engine {

using motion::Formation;
using motion::kFormationNames;

static_assert(kMostAvatars == motion::kMostDancers);

namespace {

/// Whether several are asked for without a formation for them.
bool is_group_of_solo(const Settings& settings) {
    return settings.formation == name_of(Formation::solo) &&
           (settings.dancers > 1 || (settings.dancers == 0 && settings.avatars.size() > 1));
}

}  // namespace

std::string_view name_of(Formation formation) noexcept {
    return kFormationNames[static_cast<std::size_t>(formation)];
}

Formation asked_formation(const Settings& settings) {
    if (is_group_of_solo(settings)) {
        return kUsualGroup;
    }
    // The name's index is the enumerator.
    const auto name = std::find(kFormationNames.begin(), kFormationNames.end(), settings.formation);
    RAKS_ASSERT(name != kFormationNames.end());
    return static_cast<Formation>(name - kFormationNames.begin());
}

std::size_t asked_dancers(const Settings& settings, Formation formation) noexcept {
    const std::size_t avatars = settings.avatars.size();
    if (settings.dancers > 0 || avatars < 2) {
        return motion::dancers_in(formation, static_cast<std::size_t>(settings.dancers));
    }
    const bool is_their_own = formation == kUsualGroup && is_group_of_solo(settings);
    const std::size_t usual = is_their_own ? 0 : motion::dancers_in(formation, 0);
    return motion::dancers_in(formation, std::max(usual, avatars));
}

}  // namespace raks::engine
