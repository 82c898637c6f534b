#include "render/mannequin/body_primitives.hpp"

#include <array>

namespace raks::render {
namespace {

using motion::Bone;

// What the sheets of face_mesh.cpp lie on: soft brow, shallow sockets with balls in them, a small
// nose, a hint of lips. Round rather than true to life: lips and sockets as deep as real ones
// looked uncanny.
constexpr std::array kFaceStations = {
    // t, half width, half front, half back, shift to the side, shift to the front
    Station{1.5277F, 0.0495F, 0.0530F, 0.0535F, 0.0F, 0.0310F},
    Station{1.5550F, 0.0615F, 0.0675F, 0.0660F, 0.0F, 0.0175F},
    Station{1.5844F, 0.0705F, 0.0800F, 0.0800F, 0.0F, 0.0055F},
    Station{1.6159F, 0.0762F, 0.0870F, 0.0914F, 0.0F, -0.0010F},
    Station{1.6474F, 0.0762F, 0.0867F, 0.0956F, 0.0F, -0.0050F},
    Station{1.6737F, 0.0706F, 0.0780F, 0.0882F, 0.0F, -0.0084F},
};

constexpr SolidFrame kEyeFrame{
    {0.9135F, 0.0F, -0.4067F}, {0.0F, 1.0F, 0.0F}, {0.4067F, 0.0F, 0.9135F}};

constexpr std::array kHead = {
    Primitive{"face",
              Group::core,
              Bone::head,
              0.026F,
              Loft{kFaceStations, {0.0F, 0.0F, 0.0F}, kUpright, 2.05F, 0.030F, 0.036F}},
    Primitive{"chin",
              Group::core,
              Bone::head,
              0.026F,
              Ellipsoid{{0.0F, 1.5090F, 0.0520F}, {0.0230F, 0.0210F, 0.0260F}, kUpright}},
    Primitive{"jaw",
              Group::core,
              Bone::head,
              0.036F,
              RoundCone{{0.0120F, 1.5130F, 0.0470F}, {0.0440F, 1.5560F, 0.0F}, 0.0110F, 0.0110F}},
    Primitive{"cranium",
              Group::core,
              Bone::head,
              0.025F,
              Ellipsoid{{0.0F, 1.6264F, -0.0126F}, {0.0735F, 0.0798F, 0.0903F}, kUpright}},
    Primitive{"nose",
              Group::core,
              Bone::head,
              0.020F,
              RoundCone{{0.0F, 1.6070F, 0.0770F}, {0.0F, 1.5690F, 0.0875F}, 0.0060F, 0.0080F}},
    Primitive{"ear",
              Group::core,
              Bone::head,
              0.006F,
              Ellipsoid{{0.0765F, 1.5870F, -0.0130F},
                        {0.0075F, 0.0290F, 0.0165F},
                        {{0.9397F, 0.0F, 0.3420F}, {0.0F, 1.0F, 0.0F}, {-0.3420F, 0.0F, 0.9397F}}}},
    Primitive{"eye_socket",
              Group::carve,
              Bone::head,
              0.030F,
              Ellipsoid{{0.0360F, 1.5950F, 0.1030F}, {0.0270F, 0.0150F, 0.0160F}, kEyeFrame}},
    Primitive{"eyeball",
              Group::detail,
              Bone::head,
              0.012F,
              Ellipsoid{{0.0335F, 1.5910F, 0.0580F}, {0.0210F, 0.0170F, 0.0160F}, kEyeFrame}},
    Primitive{"lips",
              Group::detail,
              Bone::head,
              0.016F,
              RoundCone{{0.0F, 1.5390F, 0.0780F}, {0.0150F, 1.5395F, 0.0735F}, 0.0080F, 0.0060F}},
};

}  // namespace

std::span<const Primitive> head_primitives() noexcept { return kHead; }

}  // namespace raks::render
