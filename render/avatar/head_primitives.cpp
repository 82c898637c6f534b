#include "render/avatar/body_primitives.hpp"

#include <array>

namespace raks::render {
namespace {

using motion::Bone;

constexpr std::array kFaceStations = {
    // t, half width, half front, half back, shift to the side, shift to the front
    Station{1.49515F, 0.02572F, 0.02625F, 0.0273F, 0.0F, 0.0546F},
    Station{1.5067F, 0.03622F, 0.0357F, 0.0378F, 0.0F, 0.0462F},
    Station{1.5277F, 0.05145F, 0.0525F, 0.0525F, 0.0F, 0.0315F},
    Station{1.555F, 0.06195F, 0.0672F, 0.0651F, 0.0F, 0.01785F},
    Station{1.5844F, 0.06983F, 0.0798F, 0.0798F, 0.0F, 0.00525F},
    Station{1.6159F, 0.07508F, 0.08767F, 0.09135F, 0.0F, -0.00105F},
    Station{1.6474F, 0.0756F, 0.08715F, 0.09555F, 0.0F, -0.00525F},
    Station{1.67365F, 0.07035F, 0.07823F, 0.0882F, 0.0F, -0.0084F},
};

constexpr std::array kHead = {
    Primitive{"face",
              Group::core,
              Bone::head,
              0.026F,
              Loft{kFaceStations, {0.0F, 0.0F, 0.0F}, kUpright, 2.05F, 0.017F, 0.036F}},
    Primitive{"cranium",
              Group::core,
              Bone::head,
              0.025F,
              Ellipsoid{{0.0F, 1.6264F, -0.0126F}, {0.0735F, 0.0798F, 0.0903F}, kUpright}},
    Primitive{"nose",
              Group::core,
              Bone::head,
              0.022F,
              RoundCone{{0.0F, 1.6117F, 0.0798F}, {0.0F, 1.5634F, 0.09082F}, 0.0065F, 0.0085F}},
    Primitive{
        "eye_socket",
        Group::carve,
        Bone::head,
        0.03F,
        Ellipsoid{{0.0357F, 1.5928F, 0.10185F},
                  {0.0315F, 0.01575F, 0.01575F},
                  {{0.89879F, 0.0F, -0.43837F}, {0.0F, 1.0F, 0.0F}, {0.43837F, 0.0F, 0.89879F}}}},
    Primitive{"bun",
              Group::core,
              Bone::head,
              0.012F,
              Ellipsoid{{0.0F, 1.66F, -0.1176F}, {0.037F, 0.037F, 0.034F}, kUpright}},
};

}  // namespace

std::span<const Primitive> head_primitives() noexcept { return kHead; }

}  // namespace raks::render
