#include "render/dress.hpp"

#include <algorithm>
#include <cstddef>

#include "render/model/paint.hpp"

#include <glm/common.hpp>
#include <glm/geometric.hpp>

namespace raks::render {
namespace {

constexpr float kSoleAgainstShoe = 0.35F;

glm::vec4 dyed(glm::vec3 c) noexcept { return {c, 1.0F}; }

/// Lips are a redder skin.
glm::vec3 lips_of(glm::vec3 skin) noexcept { return skin * glm::vec3(0.88F, 0.50F, 0.50F); }

// What a costume asks for, whatever the outfit's colours are; linear.
constexpr glm::vec3 kOffWhite{0.78F, 0.77F, 0.74F};
constexpr glm::vec3 kJetBlack{0.014F, 0.014F, 0.018F};
constexpr glm::vec3 kDarkCotton{0.030F, 0.034F, 0.046F};
constexpr glm::vec3 kLightCotton{0.30F, 0.31F, 0.34F};
constexpr glm::vec3 kGoldThread{0.72F, 0.42F, 0.09F};

float lightness(glm::vec3 colour) noexcept {
    return glm::dot(colour, glm::vec3(0.2126F, 0.7152F, 0.0722F));
}

/// The outfit's colours as a costume has them.
DressColours in_costume(DressColours made, const Outfit& outfit, MannequinStyle style) noexcept {
    const auto paint = [&](Paint which, glm::vec3 colour) {
        made.colours[static_cast<std::size_t>(which)] = dyed(colour);
    };
    switch (style.costume) {
        case Costume::unitard:
            break;
        case Costume::street: {
            constexpr float kDark = 0.06F;
            // Trousers that go with any hoodie: dark, or light under a dark one.
            const glm::vec3 trousers = lightness(outfit.suit) > kDark ? kDarkCotton : kLightCotton;
            paint(Paint::stripe, trousers);
            paint(Paint::trim, trousers);
            paint(Paint::shoes, outfit.trim);
            paint(Paint::sole, kOffWhite);
            break;
        }
        case Costume::oriental:
            paint(Paint::stripe, outfit.trim);
            paint(Paint::trim, kGoldThread);
            break;
        case Costume::ballroom:
            if (style.build == MannequinBuild::lead) {
                paint(Paint::suit, kJetBlack);
                paint(Paint::stripe, kOffWhite);
                paint(Paint::trim, kJetBlack);
                paint(Paint::shoes, kJetBlack);
                paint(Paint::sole, kJetBlack);
            }
            break;
    }
    return made;
}

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

DressColours dress_colours(const Scene& scene, int number, MannequinStyle style) noexcept {
    const Theme& theme = *scene.theme;
    if (scene.view == View::stick) {
        return {{dyed(theme.stick_middle), dyed(theme.stick_left), dyed(theme.stick_right)}};
    }
    if (scene.dress == Dress::mannequin) {
        return of_mannequin(theme);
    }
    const auto place = static_cast<std::size_t>(std::max(number, 0)) % theme.outfits.size();
    const Outfit& outfit = theme.outfits[place];
    return in_costume(of_outfit(outfit), outfit, style);
}

}  // namespace raks::render
