#include "render/mannequin/body_primitives.hpp"

#include <array>

namespace raks::render {
namespace {

using motion::Bone;

// Profiles along the bones: biceps and triceps bulge in the middle, the elbow is narrow and round.
constexpr std::array kUpperArmStations = {
    // t, half width, half front, half back, shift to the side, shift to the front
    Station{-0.012F, 0.041F, 0.042F, 0.044F, -0.006F, 0.0F},
    Station{0.03F, 0.0435F, 0.042F, 0.044F, -0.003F, 0.0F},
    Station{0.08F, 0.0405F, 0.041F, 0.042F, 0.0F, 0.0F},
    Station{0.13F, 0.0375F, 0.041F, 0.04F, 0.0F, 0.001F},
    Station{0.18F, 0.035F, 0.038F, 0.037F, 0.0F, 0.001F},
    Station{0.225F, 0.0325F, 0.034F, 0.034F, 0.0F, 0.0F},
    Station{0.27F, 0.032F, 0.031F, 0.033F, 0.0F, 0.0F},
    Station{0.29F, 0.0315F, 0.03F, 0.032F, 0.0F, 0.0F},
};

// Thick below the elbow, flat toward the wrist: front and back stay wider than the half width.
constexpr std::array kForearmStations = {
    // t, half width, half front, half back, shift to the side, shift to the front
    Station{-0.025F, 0.0315F, 0.03F, 0.033F, 0.0F, 0.0F},
    Station{0.01F, 0.0325F, 0.032F, 0.034F, 0.0F, 0.0F},
    Station{0.045F, 0.034F, 0.036F, 0.034F, 0.0F, 0.001F},
    Station{0.085F, 0.0325F, 0.036F, 0.033F, 0.0F, 0.001F},
    Station{0.13F, 0.028F, 0.0325F, 0.0305F, 0.0F, 0.001F},
    Station{0.175F, 0.023F, 0.0285F, 0.0275F, 0.0F, 0.0F},
    Station{0.21F, 0.0195F, 0.0265F, 0.0255F, 0.0F, 0.0F},
    Station{0.235F, 0.018F, 0.026F, 0.025F, 0.0F, 0.0F},
};

// A flat box that widens toward the knuckles; `half width` is its thickness.
constexpr std::array kPalmStations = {
    // t, half width, half front, half back, shift to the side, shift to the front
    Station{-0.005F, 0.0165F, 0.0245F, 0.024F, 0.0F, 0.0F},
    Station{0.02F, 0.0155F, 0.027F, 0.0275F, 0.0F, 0.0F},
    Station{0.045F, 0.014F, 0.032F, 0.035F, 0.0F, 0.0F},
    Station{0.065F, 0.0128F, 0.0345F, 0.0395F, 0.001F, 0.0F},
    Station{0.08F, 0.0115F, 0.0345F, 0.04F, 0.001F, 0.0F},
};

constexpr std::array kArm = {
    Primitive{"upper_arm",
              Group::arm,
              Bone::left_upper_arm,
              0.02F,
              Loft{kUpperArmStations,
                   {0.158F, 1.362F, -0.024F},
                   {{0.0F, 1.0F, 0.0F}, {0.99997F, 0.0F, -0.00727F}, {0.00727F, 0.0F, 0.99997F}},
                   2.0F,
                   0.03F,
                   0.025F}},
    Primitive{"deltoid",
              Group::arm,
              Bone::left_upper_arm,
              0.034F,
              Ellipsoid{{0.188F, 1.367F, -0.024F}, {0.060F, 0.0390F, 0.0455F}, kUpright}},
    Primitive{"forearm",
              Group::arm,
              Bone::left_lower_arm,
              0.022F,
              Loft{kForearmStations,
                   {0.433F, 1.362F, -0.026F},
                   {{0.0F, 1.0F, 0.0F}, {0.99996F, 0.0F, 0.00837F}, {-0.00837F, 0.0F, 0.99997F}},
                   2.0F,
                   0.025F,
                   0.02F}},
    Primitive{"palm",
              Group::palm,
              Bone::left_hand,
              0.02F,
              Loft{kPalmStations, {0.672F, 1.362F, -0.024F}, kAlongArm, 2.5F, 0.015F, 0.009F}},
    Primitive{"thenar",
              Group::palm,
              Bone::left_hand,
              0.014F,
              RoundCone{{0.69F, 1.353F, -0.008F}, {0.73F, 1.35F, -0.006F}, 0.015F, 0.011F}},
    Primitive{"hypothenar",
              Group::palm,
              Bone::left_hand,
              0.014F,
              RoundCone{{0.688F, 1.354F, -0.038F}, {0.734F, 1.353F, -0.05F}, 0.012F, 0.01F}},
    Primitive{
        "thumb_1",
        Group::thumb,
        Bone::left_thumb_metacarpal,
        0.004F,
        RoundCone{{0.694F, 1.354F, -0.004F}, {0.72739F, 1.34412F, 0.02606F}, 0.015F, 0.0112F}},
    Primitive{
        "thumb_2",
        Group::thumb,
        Bone::left_thumb_proximal,
        0.003F,
        RoundCone{{0.72739F, 1.34412F, 0.02606F}, {0.7544F, 1.3389F, 0.04428F}, 0.0112F, 0.01F}},
    Primitive{
        "thumb_3",
        Group::thumb,
        Bone::left_thumb_distal,
        0.003F,
        RoundCone{{0.7544F, 1.3389F, 0.04428F}, {0.76995F, 1.3359F, 0.05477F}, 0.01F, 0.008F}},
    Primitive{
        "index_0",
        Group::index,
        Bone::left_hand,
        0.004F,
        RoundCone{{0.73705F, 1.363F, -0.00003F}, {0.759F, 1.362F, 0.0015F}, 0.00874F, 0.0092F}},
    Primitive{"index_1",
              Group::index,
              Bone::left_index_proximal,
              0.004F,
              RoundCone{{0.759F, 1.362F, 0.0015F}, {0.7999F, 1.362F, 0.00436F}, 0.0092F, 0.0084F}},
    Primitive{
        "index_2",
        Group::index,
        Bone::left_index_intermediate,
        0.003F,
        RoundCone{{0.7999F, 1.362F, 0.00436F}, {0.82484F, 1.362F, 0.0061F}, 0.0084F, 0.0076F}},
    Primitive{
        "index_3",
        Group::index,
        Bone::left_index_distal,
        0.003F,
        RoundCone{{0.82484F, 1.362F, 0.0061F}, {0.8396F, 1.362F, 0.00714F}, 0.0076F, 0.0062F}},
    Primitive{
        "middle_0",
        Group::middle,
        Bone::left_hand,
        0.004F,
        RoundCone{{0.74F, 1.3645F, -0.01988F}, {0.762F, 1.3635F, -0.0195F}, 0.00893F, 0.0094F}},
    Primitive{
        "middle_1",
        Group::middle,
        Bone::left_middle_proximal,
        0.004F,
        RoundCone{{0.762F, 1.3635F, -0.0195F}, {0.80699F, 1.3635F, -0.01871F}, 0.0094F, 0.0086F}},
    Primitive{
        "middle_2",
        Group::middle,
        Bone::left_middle_intermediate,
        0.003F,
        RoundCone{
            {0.80699F, 1.3635F, -0.01871F}, {0.83599F, 1.3635F, -0.01821F}, 0.0086F, 0.0078F}},
    Primitive{
        "middle_3",
        Group::middle,
        Bone::left_middle_distal,
        0.003F,
        RoundCone{
            {0.83599F, 1.3635F, -0.01821F}, {0.85169F, 1.3635F, -0.01793F}, 0.0078F, 0.0063F}},
    Primitive{"ring_0",
              Group::ring,
              Bone::left_hand,
              0.004F,
              RoundCone{{0.73601F, 1.363F, -0.03923F}, {0.758F, 1.362F, -0.04F}, 0.00855F, 0.009F}},
    Primitive{"ring_1",
              Group::ring,
              Bone::left_ring_proximal,
              0.004F,
              RoundCone{{0.758F, 1.362F, -0.04F}, {0.79898F, 1.362F, -0.04143F}, 0.009F, 0.0081F}},
    Primitive{
        "ring_2",
        Group::ring,
        Bone::left_ring_intermediate,
        0.003F,
        RoundCone{{0.79898F, 1.362F, -0.04143F}, {0.82596F, 1.362F, -0.04237F}, 0.0081F, 0.0074F}},
    Primitive{
        "ring_3",
        Group::ring,
        Bone::left_ring_distal,
        0.003F,
        RoundCone{{0.82596F, 1.362F, -0.04237F}, {0.84195F, 1.362F, -0.04293F}, 0.0074F, 0.006F}},
    Primitive{"little_0",
              Group::little,
              Bone::left_hand,
              0.004F,
              RoundCone{{0.72812F, 1.36F, -0.0562F}, {0.75F, 1.359F, -0.0585F}, 0.0076F, 0.008F}},
    Primitive{"little_1",
              Group::little,
              Bone::left_little_proximal,
              0.004F,
              RoundCone{{0.75F, 1.359F, -0.0585F}, {0.78182F, 1.359F, -0.06184F}, 0.008F, 0.0071F}},
    Primitive{
        "little_2",
        Group::little,
        Bone::left_little_intermediate,
        0.003F,
        RoundCone{{0.78182F, 1.359F, -0.06184F}, {0.80172F, 1.359F, -0.06394F}, 0.0071F, 0.0065F}},
    Primitive{
        "little_3",
        Group::little,
        Bone::left_little_distal,
        0.003F,
        RoundCone{{0.80172F, 1.359F, -0.06394F}, {0.81524F, 1.359F, -0.06536F}, 0.0065F, 0.0054F}},
};

}  // namespace

std::span<const Primitive> arm_primitives() noexcept { return kArm; }

}  // namespace raks::render
