#include "render/mannequin/costume_shape.hpp"

#include <array>
#include <string_view>
#include <utility>

namespace raks::render {
namespace {

using motion::Bone;

// Legs must not touch in the middle, where they would grow together: what is wide is shifted
// outward.
//
// Each table: t, half width, half front, half back, shift to the side, shift to the front.

// A hoodie: from the shoulders straight down to a band that holds it on the hips.
constexpr std::array kHoodieTorso = {
    Station{0.835F, 0.150F, 0.096F, 0.104F, 0.0F, -0.008F},
    Station{0.850F, 0.163F, 0.104F, 0.114F, 0.0F, -0.010F},
    Station{0.880F, 0.183F, 0.122F, 0.130F, 0.0F, -0.010F},
    Station{0.920F, 0.188F, 0.128F, 0.134F, 0.0F, -0.010F},
    Station{0.980F, 0.180F, 0.126F, 0.124F, 0.0F, -0.008F},
    Station{1.060F, 0.166F, 0.122F, 0.110F, 0.0F, -0.006F},
    Station{1.140F, 0.160F, 0.122F, 0.106F, 0.0F, -0.008F},
    Station{1.215F, 0.160F, 0.124F, 0.108F, 0.0F, -0.014F},
    Station{1.270F, 0.160F, 0.116F, 0.108F, 0.0F, -0.020F},
    Station{1.320F, 0.156F, 0.096F, 0.100F, 0.0F, -0.026F},
    Station{1.360F, 0.140F, 0.072F, 0.086F, 0.0F, -0.030F},
    Station{1.392F, 0.102F, 0.052F, 0.070F, 0.0F, -0.032F},
    Station{1.415F, 0.068F, 0.044F, 0.056F, 0.0F, -0.032F},
};

// Sleeves that are gathered at the wrist.
constexpr std::array kWideUpperArm = {
    Station{-0.012F, 0.050F, 0.050F, 0.052F, -0.006F, 0.0F},
    Station{0.030F, 0.054F, 0.052F, 0.054F, -0.004F, 0.0F},
    Station{0.080F, 0.053F, 0.052F, 0.053F, -0.002F, 0.0F},
    Station{0.130F, 0.051F, 0.051F, 0.051F, -0.002F, 0.0F},
    Station{0.180F, 0.049F, 0.049F, 0.049F, -0.002F, 0.0F},
    Station{0.225F, 0.047F, 0.047F, 0.047F, -0.001F, 0.0F},
    Station{0.290F, 0.046F, 0.045F, 0.047F, 0.0F, 0.0F},
};
constexpr std::array kWideForearm = {
    Station{-0.025F, 0.046F, 0.045F, 0.047F, 0.0F, 0.0F},
    Station{0.045F, 0.046F, 0.047F, 0.046F, 0.0F, 0.0F},
    Station{0.110F, 0.043F, 0.045F, 0.043F, -0.001F, 0.0F},
    Station{0.160F, 0.041F, 0.043F, 0.041F, -0.002F, 0.0F},
    Station{0.186F, 0.036F, 0.040F, 0.038F, -0.001F, 0.0F},
    Station{0.200F, 0.027F, 0.033F, 0.032F, 0.0F, 0.0F},
    Station{0.232F, 0.024F, 0.031F, 0.030F, 0.0F, 0.0F},
};

// Trousers that fall wide onto the shoe.
constexpr std::array kWideThigh = {
    Station{-0.03F, 0.080F, 0.076F, 0.084F, 0.006F, -0.006F},
    Station{0.03F, 0.090F, 0.088F, 0.094F, 0.013F, -0.006F},
    Station{0.08F, 0.092F, 0.093F, 0.094F, 0.015F, -0.004F},
    Station{0.14F, 0.090F, 0.092F, 0.089F, 0.013F, 0.0F},
    Station{0.21F, 0.085F, 0.087F, 0.083F, 0.010F, 0.002F},
    Station{0.28F, 0.080F, 0.081F, 0.078F, 0.007F, 0.002F},
    Station{0.34F, 0.076F, 0.077F, 0.074F, 0.005F, 0.001F},
    Station{0.40F, 0.074F, 0.074F, 0.073F, 0.004F, -0.001F},
};
constexpr std::array kWideShank = {
    Station{-0.03F, 0.074F, 0.073F, 0.074F, 0.004F, -0.002F},
    Station{0.05F, 0.074F, 0.073F, 0.078F, 0.004F, -0.004F},
    Station{0.135F, 0.074F, 0.073F, 0.081F, 0.004F, -0.004F},
    Station{0.25F, 0.075F, 0.075F, 0.081F, 0.004F, 0.0F},
    Station{0.33F, 0.076F, 0.079F, 0.081F, 0.004F, 0.004F},
    Station{0.360F, 0.076F, 0.081F, 0.080F, 0.004F, 0.008F},
};

// Trousers that are tight under a scarf and bulge down to the ankle, where they are tied.
constexpr std::array kFullThigh = {
    Station{-0.03F, 0.070F, 0.066F, 0.074F, 0.004F, -0.006F},
    Station{0.03F, 0.078F, 0.076F, 0.083F, 0.006F, -0.006F},
    Station{0.08F, 0.080F, 0.079F, 0.084F, 0.006F, -0.004F},
    Station{0.14F, 0.080F, 0.081F, 0.082F, 0.007F, 0.0F},
    Station{0.21F, 0.083F, 0.084F, 0.082F, 0.008F, 0.002F},
    Station{0.28F, 0.080F, 0.081F, 0.078F, 0.007F, 0.002F},
    Station{0.34F, 0.076F, 0.077F, 0.074F, 0.005F, 0.001F},
    Station{0.40F, 0.074F, 0.074F, 0.073F, 0.004F, -0.001F},
};
constexpr std::array kFullShank = {
    Station{-0.03F, 0.074F, 0.074F, 0.074F, 0.004F, -0.002F},
    Station{0.05F, 0.077F, 0.078F, 0.080F, 0.005F, -0.004F},
    Station{0.135F, 0.080F, 0.081F, 0.085F, 0.007F, -0.004F},
    Station{0.22F, 0.079F, 0.080F, 0.083F, 0.007F, -0.002F},
    Station{0.280F, 0.071F, 0.073F, 0.074F, 0.004F, 0.0F},
    Station{0.322F, 0.050F, 0.053F, 0.054F, 0.001F, 0.0F},
    Station{0.340F, 0.033F, 0.035F, 0.038F, 0.0F, 0.0F},
    Station{0.362F, 0.031F, 0.032F, 0.036F, 0.0F, 0.0F},
};

// A sneaker is rounder at the toes and higher at the heel than a dance shoe.
constexpr std::array kSneaker = {
    Station{-0.058F, 0.030F, 0.040F, 0.034F, 0.0F, 0.034F},
    Station{-0.030F, 0.036F, 0.054F, 0.036F, 0.0F, 0.034F},
    Station{0.000F, 0.038F, 0.060F, 0.036F, 0.001F, 0.032F},
    Station{0.035F, 0.040F, 0.056F, 0.034F, 0.002F, 0.030F},
    Station{0.070F, 0.044F, 0.046F, 0.030F, 0.003F, 0.026F},
    Station{0.105F, 0.048F, 0.036F, 0.026F, 0.003F, 0.024F},
    Station{0.135F, 0.048F, 0.030F, 0.024F, 0.002F, 0.022F},
    Station{0.160F, 0.042F, 0.026F, 0.022F, 0.0F, 0.021F},
    Station{0.174F, 0.032F, 0.020F, 0.018F, -0.002F, 0.020F},
};

// The sleeve of a coat: straight to the wrist.
constexpr std::array kCoatForearm = {
    Station{-0.025F, 0.038F, 0.037F, 0.040F, 0.0F, 0.0F},
    Station{0.045F, 0.038F, 0.040F, 0.039F, 0.0F, 0.001F},
    Station{0.110F, 0.035F, 0.039F, 0.037F, 0.0F, 0.001F},
    Station{0.175F, 0.031F, 0.036F, 0.035F, 0.0F, 0.0F},
    Station{0.205F, 0.030F, 0.035F, 0.034F, 0.0F, 0.0F},
};

/// The profile of a solid in a costume.
struct ClothProfile {
    Costume costume;
    std::string_view solid;
    std::span<const Station> stations;
    float cap_end;  // metres
};
constexpr std::array kProfiles = {
    ClothProfile{Costume::street, "torso", kHoodieTorso, 0.03F},
    ClothProfile{Costume::street, "upper_arm", kWideUpperArm, 0.025F},
    ClothProfile{Costume::street, "forearm", kWideForearm, 0.006F},
    ClothProfile{Costume::street, "thigh", kWideThigh, 0.055F},
    ClothProfile{Costume::street, "shank", kWideShank, 0.016F},
    ClothProfile{Costume::street, "foot", kSneaker, 0.013F},
    ClothProfile{Costume::oriental, "thigh", kFullThigh, 0.055F},
    ClothProfile{Costume::oriental, "shank", kFullShank, 0.010F},
};
constexpr ClothProfile kCoatSleeve{Costume::ballroom, "forearm", kCoatForearm, 0.006F};

/// What lies under loose cloth and would show through it.
constexpr std::string_view kUnderHoodie = "bust";

// A hood that lies on the back and comes down to a point in front; one half of it.
constexpr std::array kHoodie = {
    Primitive{"hood_back",
              Group::core,
              Bone::upper_chest,
              0.018F,
              Ellipsoid{{0.0F, 1.362F, -0.128F}, {0.105F, 0.062F, 0.048F}, kUpright}},
    Primitive{"hood_nape",
              Group::core,
              Bone::upper_chest,
              0.020F,
              RoundCone{{0.0F, 1.412F, -0.098F}, {0.062F, 1.420F, -0.066F}, 0.034F, 0.030F},
              Fold::both_sides},
    Primitive{"hood_side",
              Group::core,
              Bone::upper_chest,
              0.016F,
              RoundCone{{0.062F, 1.420F, -0.066F}, {0.074F, 1.418F, -0.004F}, 0.030F, 0.021F}},
    Primitive{"hood_front",
              Group::core,
              Bone::upper_chest,
              0.012F,
              RoundCone{{0.074F, 1.418F, -0.004F}, {0.010F, 1.348F, 0.066F}, 0.021F, 0.014F}},
};

void set_profile(const ClothProfile& profile, ShapedPrimitive& made) {
    made.stations.assign(profile.stations.begin(), profile.stations.end());
    std::get<Loft>(made.primitive.shape).cap_end = profile.cap_end;
}

}  // namespace

std::optional<ShapedPrimitive> dressed(ShapedPrimitive made, MannequinStyle style) {
    const std::string_view name = made.primitive.name;
    if (style.costume == Costume::street && name == kUnderHoodie) {
        return std::nullopt;
    }
    for (const ClothProfile& profile : kProfiles) {
        if (profile.costume == style.costume && profile.solid == name) {
            set_profile(profile, made);
        }
    }
    if (has_coat(style) && name == kCoatSleeve.solid) {
        set_profile(kCoatSleeve, made);
    }
    return made;
}

std::span<const Primitive> costume_primitives(Costume costume) noexcept {
    return costume == Costume::street ? std::span<const Primitive>(kHoodie)
                                      : std::span<const Primitive>();
}

bool has_coat(MannequinStyle style) noexcept {
    return style.costume == Costume::ballroom && style.build == MannequinBuild::lead;
}

bool has_arch(Costume costume) noexcept {
    return costume == Costume::unitard || costume == Costume::ballroom;
}

}  // namespace raks::render
