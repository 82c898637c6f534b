#include "render/dress.hpp"

#include <algorithm>
#include <cstddef>

#include <glm/common.hpp>

namespace raks::render {
namespace {

constexpr float kSoleAgainstShoe = 0.35F;

glm::vec4 dyed(glm::vec3 c) noexcept { return {c, 1.0F}; }

/// Lips are a redder skin.
glm::vec3 lips_of(glm::vec3 skin) noexcept { return skin * glm::vec3(0.88F, 0.50F, 0.50F); }

DressColours of_outfit(const Outfit& outfit) noexcept {
    return {{dyed(outfit.skin),
             dyed(outfit.suit),
             dyed(outfit.stripe),
             dyed(outfit.hair),
             dyed(outfit.shoes),
             dyed(outfit.trim),
             dyed(kSoleAgainstShoe * outfit.shoes),
             glm::vec4(1.0F),
             dyed(outfit.iris),
             dyed(lips_of(outfit.skin))}};
}

/// A plain mannequin: body, bands, dark edge; hair and eyes in the bands' colours.
DressColours of_mannequin(const Theme& theme) noexcept {
    return {{dyed(theme.body),
             dyed(theme.joint_bands),
             dyed(theme.band_edge),
             dyed(0.6F * theme.joint_bands),
             dyed(theme.body),
             dyed(theme.joint_bands),
             dyed(theme.body),
             glm::vec4(1.0F),
             dyed(theme.joint_bands),
             dyed(glm::mix(theme.body, theme.joint_bands, 0.55F))}};
}

}  // namespace

DressColours dress_colours(const Scene& scene, int number) noexcept {
    const Theme& theme = *scene.theme;
    if (scene.view == View::stick) {
        return {{dyed(theme.stick_middle), dyed(theme.stick_left), dyed(theme.stick_right)}};
    }
    if (scene.dress == Dress::mannequin) {
        return of_mannequin(theme);
    }
    const auto place = static_cast<std::size_t>(std::max(number, 0)) % theme.outfits.size();
    return of_outfit(theme.outfits[place]);
}

}  // namespace raks::render
