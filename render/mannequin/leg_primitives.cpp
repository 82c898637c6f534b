#include "render/mannequin/body_primitives.hpp"

#include <array>

namespace raks::render {
namespace {

using motion::Bone;

// t runs down the leg, so the first station lies in the hip and is covered by the trunk.
constexpr std::array kThighStations = {
    // t, half width, half front, half back, shift to the side, shift to the front
    Station{-0.03F, 0.07F, 0.066F, 0.074F, 0.004F, -0.006F},
    Station{0.03F, 0.08F, 0.078F, 0.084F, 0.006F, -0.006F},
    Station{0.08F, 0.081F, 0.083F, 0.084F, 0.004F, -0.004F},
    Station{0.14F, 0.0765F, 0.082F, 0.077F, 0.002F, 0.0F},
    Station{0.21F, 0.069F, 0.075F, 0.068F, 0.001F, 0.002F},
    Station{0.28F, 0.06F, 0.064F, 0.058F, 0.0F, 0.002F},
    Station{0.34F, 0.0525F, 0.055F, 0.051F, -0.001F, 0.001F},
    Station{0.375F, 0.0488F, 0.0490F, 0.048F, -0.001F, 0.0F},
    Station{0.40F, 0.0462F, 0.0450F, 0.0470F, -0.001F, -0.001F},
};

// The calf shows in the half back, which is largest a third of the way down.
constexpr std::array kShankStations = {
    // t, half width, half front, half back, shift to the side, shift to the front
    Station{-0.03F, 0.0465F, 0.046F, 0.046F, 0.0F, -0.002F},
    Station{0.01F, 0.046F, 0.046F, 0.046F, 0.0F, -0.003F},
    Station{0.05F, 0.045F, 0.0470F, 0.05F, 0.001F, -0.005F},
    Station{0.095F, 0.05F, 0.0450F, 0.06F, 0.002F, -0.007F},
    Station{0.135F, 0.0515F, 0.042F, 0.064F, 0.001F, -0.008F},
    Station{0.19F, 0.0465F, 0.038F, 0.058F, 0.0F, -0.008F},
    Station{0.25F, 0.0385F, 0.034F, 0.046F, -0.001F, -0.006F},
    Station{0.31F, 0.031F, 0.03F, 0.036F, -0.001F, -0.003F},
    Station{0.36F, 0.0275F, 0.028F, 0.032F, 0.0F, -0.001F},
    Station{0.4F, 0.0285F, 0.029F, 0.033F, 0.0F, 0.0F},
    Station{0.425F, 0.029F, 0.03F, 0.036F, 0.0F, -0.002F},
};

// t runs from heel to toes, `front` is up: half back is the part below the centre, which the flat
// sole cuts off.
constexpr std::array kFootStations = {
    // t, half width, half front, half back, shift to the side, shift to the front
    Station{-0.055F, 0.026F, 0.032F, 0.034F, 0.0F, 0.032F},
    Station{-0.03F, 0.0305F, 0.042F, 0.036F, 0.0F, 0.032F},
    Station{0.0F, 0.032F, 0.05F, 0.036F, 0.001F, 0.03F},
    Station{0.035F, 0.0335F, 0.044F, 0.034F, 0.002F, 0.028F},
    Station{0.07F, 0.037F, 0.034F, 0.03F, 0.003F, 0.024F},
    Station{0.105F, 0.0415F, 0.0245F, 0.026F, 0.003F, 0.02F},
    Station{0.135F, 0.041F, 0.018F, 0.022F, 0.001F, 0.017F},
    Station{0.155F, 0.0365F, 0.0155F, 0.0200F, -0.0020F, 0.0155F},
    Station{0.168F, 0.0290F, 0.0125F, 0.0175F, -0.0050F, 0.0145F},
};

constexpr std::array kLeg = {
    Primitive{"thigh",
              Group::leg,
              Bone::left_upper_leg,
              0.02F,
              Loft{kThighStations,
                   {0.088F, 0.892F, 0.0F},
                   {{0.99995F, -0.00985F, 0.00015F},
                    {-0.00985F, -0.99984F, 0.01478F},
                    {0.0F, 0.01478F, 0.99989F}},
                   2.0F,
                   0.06F,
                   0.055F}},
    Primitive{"shank",
              Group::leg,
              Bone::left_lower_leg,
              0.022F,
              Loft{kShankStations,
                   {0.084F, 0.486F, 0.006F},
                   {{0.99999F, -0.00488F, -0.00033F},
                    {-0.00489F, -0.99764F, -0.06847F},
                    {0.0F, -0.06847F, 0.99765F}},
                   2.0F,
                   0.03F,
                   0.02F}},
    Primitive{"patella",
              Group::leg,
              Bone::left_lower_leg,
              0.050F,
              Ellipsoid{{0.084F, 0.499F, 0.0345F}, {0.023F, 0.036F, 0.0135F}, kUpright}},
    Primitive{"malleoli",
              Group::leg,
              Bone::left_foot,
              0.014F,
              Ellipsoid{{0.082F, 0.08F, -0.02F}, {0.035F, 0.014F, 0.014F}, kUpright}},
    Primitive{"instep",
              Group::leg,
              Bone::left_foot,
              0.03F,
              RoundCone{{0.082F, 0.09F, -0.018F}, {0.084F, 0.036F, 0.062F}, 0.027F, 0.02F}},
    Primitive{"achilles",
              Group::leg,
              Bone::left_foot,
              0.025F,
              RoundCone{{0.082F, 0.138F, -0.032F}, {0.082F, 0.03F, -0.048F}, 0.02F, 0.025F}},
    Primitive{"foot",
              Group::leg,
              Bone::left_foot,
              0.022F,
              Loft{kFootStations, {0.082F, 0.0F, 0.0F}, kAlongFoot, 2.3F, 0.02F, 0.013F}},
};

}  // namespace

std::span<const Primitive> leg_primitives() noexcept { return kLeg; }

}  // namespace raks::render
