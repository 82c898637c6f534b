#pragma once

#include <filesystem>
#include <memory>
#include <string>
#include <vector>

#include "base/dance_list.hpp"

/// The dances that come with Raks, for tests.
namespace raks::test {

/// models/trained/dances.toml of the source tree.
[[nodiscard]] std::shared_ptr<const DanceList> shipped_dances();

/// The choreographies of those that are written: config/choreographies/NAME.toml, by name.
[[nodiscard]] std::vector<std::filesystem::path> written_dances();

}  // namespace raks::test

/// The numbers of some, for tests that are about one.
namespace raks::shipped {

inline constexpr DanceId salsa{0};
inline constexpr DanceId belly{1};
inline constexpr DanceId house{2};
inline constexpr DanceId hiphop{3};
inline constexpr DanceId rock{4};
inline constexpr DanceId waltz{5};

}  // namespace raks::shipped
