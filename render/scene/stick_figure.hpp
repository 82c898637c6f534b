#pragma once

#include <array>
#include <cstddef>
#include <cstdint>

#include "motion/skeleton/skeleton.hpp"
#include "render/scene/stage_shapes.hpp"

#include <glm/vec3.hpp>

namespace raks::render {

/// A point of the stick figure, fixed to one bone.
struct StickVertex {
    glm::vec3 position{};        ///< in the bone's frame, metres
    glm::vec3 normal{};          ///< unit, same frame
    std::uint8_t bone = 0;       ///< motion::Bone
    std::uint8_t left = 0;       ///< share of the left side's colour, 0..255
    std::uint8_t right = 0;      ///< and of the right's; the rest is the middle's
    std::uint8_t occlusion = 0;  ///< 255: open to the light
};

/// The stick figure of a skeleton: spheres at the joints, round cones for bones, an egg for a head
/// with a nose that shows where it faces. Left, right and middle differ in colour. Pure.
[[nodiscard]] Shape<StickVertex> stick_figure(const motion::Skeleton& skeleton);

// The pieces that stick figures are made of, for this folder alone.

/// Radii in metres for a body of 1.714 m: of a joint's sphere.
inline constexpr float kStickJointRadius = 0.026F;
/// Of a finger joint's sphere.
inline constexpr float kStickFingerRadius = 0.0075F;
/// Of a bone at its near end.
inline constexpr float kStickBoneRadius = 0.0135F;
/// Of a finger's bone at its near end.
inline constexpr float kStickFingerBoneRadius = 0.0052F;
inline constexpr float kStickTaper = 0.8F;  ///< a bone's far end against its near one
/// Share of the side's colour on a bone; joints have all of it.
inline constexpr float kStickBoneTint = 0.16F;

/// Side of the body, which gives the colour.
enum class StickPart : std::uint8_t { middle, left, right };

/// Adds pieces of one bone, in its frame and colour.
class StickBuilder {
 public:
    /// Appends to `shape`, which must outlive the builder.
    StickBuilder(Shape<StickVertex>& shape, std::uint8_t bone, StickPart part)
        : shape_(shape), bone_(bone), part_(part) {}

    /// `tint`: share of the side's colour.
    void set_tint(float tint) noexcept;
    /// An ellipsoid with axes along the bone's frame, of `rows` x `columns` cells from pole to
    /// pole.
    void add_ellipsoid(glm::vec3 middle, glm::vec3 radii, std::size_t rows, std::size_t columns);
    /// A cone without caps from one joint to another; the spheres of the joints cover its ends.
    void add_cone(
        glm::vec3 from, glm::vec3 to, float from_radius, float to_radius, std::size_t sides = 12);
    /// An egg with a nose, over a head's joint at the origin, facing +z.
    void add_head();

 private:
    void add_vertex(glm::vec3 position, glm::vec3 normal);
    void connect(std::size_t first, std::size_t rows, std::size_t columns);

    Shape<StickVertex>& shape_;
    std::uint8_t bone_;
    StickPart part_;
    std::uint8_t left_ = 0;
    std::uint8_t right_ = 0;
};

}  // namespace raks::render
