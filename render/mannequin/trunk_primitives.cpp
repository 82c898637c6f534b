#include "render/mannequin/body_primitives.hpp"

#include <array>

namespace raks::render {
namespace {

using motion::Bone;

// t is the height over the floor. Waist at 1.11 m; shoulders come from trapezius and deltoid.
constexpr std::array kTorsoStations = {
    // t, half width, half front, half back, shift to the side, shift to the front
    Station{0.845F, 0.118F, 0.07F, 0.08F, 0.0F, -0.006F},
    Station{0.88F, 0.15F, 0.082F, 0.094F, 0.0F, -0.01F},
    Station{0.92F, 0.162F, 0.088F, 0.1F, 0.0F, -0.01F},
    Station{0.96F, 0.155F, 0.09F, 0.092F, 0.0F, -0.006F},
    Station{1.01F, 0.133F, 0.086F, 0.076F, 0.0F, -0.002F},
    Station{1.06F, 0.116F, 0.082F, 0.068F, 0.0F, -0.002F},
    Station{1.11F, 0.112F, 0.081F, 0.072F, 0.0F, -0.006F},
    Station{1.16F, 0.12F, 0.086F, 0.08F, 0.0F, -0.01F},
    Station{1.215F, 0.13F, 0.09F, 0.086F, 0.0F, -0.014F},
    Station{1.27F, 0.136F, 0.086F, 0.088F, 0.0F, -0.02F},
    Station{1.32F, 0.138F, 0.072F, 0.082F, 0.0F, -0.026F},
    Station{1.36F, 0.126F, 0.056F, 0.07F, 0.0F, -0.03F},
    Station{1.392F, 0.09F, 0.043F, 0.056F, 0.0F, -0.032F},
    Station{1.415F, 0.058F, 0.038F, 0.046F, 0.0F, -0.032F},
};

constexpr std::array kTrunk = {
    Primitive{"torso",
              Group::core,
              Bone::chest,
              0.02F,
              Loft{kTorsoStations, {0.0F, 0.0F, 0.0F}, kUpright, 2.25F, 0.05F, 0.03F}},
    Primitive{"bust",
              Group::core,
              Bone::upper_chest,
              0.05F,
              Ellipsoid{{0.063F, 1.255F, 0.054F},
                        {0.054F, 0.054F, 0.045F},
                        {{0.9703F, 0.0F, -0.24192F},
                         {0.04201F, 0.98481F, 0.16849F},
                         {0.23825F, -0.17365F, 0.95555F}}},
              Fold::both_sides},
    Primitive{"glute",
              Group::core,
              Bone::hips,
              0.05F,
              Ellipsoid{{0.072F, 0.888F, -0.066F}, {0.074F, 0.078F, 0.062F}, kUpright}},
    Primitive{"belly",
              Group::core,
              Bone::spine,
              0.05F,
              Ellipsoid{{0.0F, 0.985F, 0.04F}, {0.08F, 0.08F, 0.042F}, kUpright}},
    Primitive{"clavicle",
              Group::core,
              Bone::upper_chest,
              0.02F,
              RoundCone{{0.018F, 1.378F, 0.02F}, {0.135F, 1.388F, -0.02F}, 0.0125F, 0.014F}},
    Primitive{"trapezius",
              Group::core,
              Bone::upper_chest,
              0.045F,
              RoundCone{{0.022F, 1.438F, -0.040F}, {0.142F, 1.381F, -0.033F}, 0.024F, 0.027F}},
    Primitive{
        "scapula",
        Group::core,
        Bone::upper_chest,
        0.05F,
        Ellipsoid{{0.088F, 1.3F, -0.088F},
                  {0.052F, 0.08F, 0.026F},
                  {{0.96126F, 0.0F, 0.27564F}, {0.0F, 1.0F, 0.0F}, {-0.27564F, 0.0F, 0.96126F}}}},
    Primitive{"lat",
              Group::core,
              Bone::chest,
              0.05F,
              Ellipsoid{{0.108F, 1.255F, -0.045F}, {0.04F, 0.09F, 0.052F}, kUpright}},
    Primitive{"neck",
              Group::core,
              Bone::neck,
              0.028F,
              RoundCone{{0.0F, 1.385F, -0.036F}, {0.0F, 1.54F, -0.008F}, 0.0500F, 0.0450F}},
    Primitive{"sternomastoid",
              Group::core,
              Bone::neck,
              0.02F,
              RoundCone{{0.015F, 1.394F, 0.006F}, {0.04F, 1.525F, -0.018F}, 0.007F, 0.008F}},
};

}  // namespace

std::span<const Primitive> trunk_primitives() noexcept { return kTrunk; }

}  // namespace raks::render
