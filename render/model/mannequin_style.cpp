#include "render/model/mannequin_style.hpp"

#include <algorithm>
#include <cstddef>

namespace raks::render {
namespace {

constexpr std::array<std::string_view, kCostumes.size()> kCostumeNames = {
    "dancer", "street", "oriental", "ballroom"};

}  // namespace

std::string_view name_of(Costume costume) noexcept {
    return kCostumeNames[static_cast<std::size_t>(costume)];
}

std::optional<Costume> find_costume(std::string_view name) noexcept {
    const auto* const found = std::find(kCostumeNames.begin(), kCostumeNames.end(), name);
    return found == kCostumeNames.end()
               ? std::nullopt
               : std::optional(kCostumes[static_cast<std::size_t>(found - kCostumeNames.begin())]);
}

}  // namespace raks::render
