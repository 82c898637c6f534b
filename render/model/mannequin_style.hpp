// Which mannequin: its build and what it wears.
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <string_view>

namespace raks::render {

/// Builds of the mannequin; their skeletons are the same, so that all dance the same dances.
enum class MannequinBuild : std::uint8_t {
    follow,  ///< with a ponytail
    lead,    ///< broader, with short hair
};

/// What the mannequin wears. The dancer's outfit (render/dress.hpp) gives the colours.
enum class Costume : std::uint8_t {
    unitard,   ///< tight, with short sleeves; the follow in a swinging skirt, the lead in trousers
    street,    ///< hoodie, wide trousers, sneakers
    oriental,  ///< bare midriff, full trousers, a scarf about the hips
    ballroom,  ///< a gown for the follow, a tailcoat for the lead
};
inline constexpr std::array kCostumes = {
    Costume::unitard, Costume::street, Costume::oriental, Costume::ballroom};

/// As in settings and in the tables of dances: "dancer" (the unitard), "street" and so on.
[[nodiscard]] std::string_view name_of(Costume costume) noexcept;
/// None: no costume has that name.
[[nodiscard]] std::optional<Costume> find_costume(std::string_view name) noexcept;

/// A mannequin among those that there are. Their skeletons are the same.
struct MannequinStyle {
    MannequinBuild build = MannequinBuild::follow;
    Costume costume = Costume::unitard;
};

}  // namespace raks::render
