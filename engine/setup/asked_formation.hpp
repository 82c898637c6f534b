#pragma once

#include <cstddef>
#include <string_view>

#include "engine/setup/settings.hpp"
#include "motion/formation.hpp"

namespace raks::engine {

/// How dancers stand who are to be several, of whom nothing else is said.
inline constexpr motion::Formation kUsualGroup = motion::Formation::grid;

/// The formation that the settings ask for; with several dancers or avatars kUsualGroup in place of
/// solo. `settings`: valid. Pure.
[[nodiscard]] motion::Formation asked_formation(const Settings& settings);

/// How many dance in a formation: as the settings say; else as many as it usually has and at least
/// one for each avatar, of kUsualGroup in solo's place exactly one. Pure.
[[nodiscard]] std::size_t asked_dancers(const Settings& settings,
                                        motion::Formation formation) noexcept;

/// The formation's name in motion::kFormationNames. Pure.
[[nodiscard]] std::string_view name_of(motion::Formation formation) noexcept;

}  // namespace raks::engine
