#pragma once

#include <cstddef>
#include <cstdint>

#include "render/scene/stick_figure.hpp"

#include <glm/vec3.hpp>

/// The pieces that stick figures are made of. Internal to this folder.
namespace raks::render {

// Of a body of 1.714 m; metres. From the prototype (rendering notes 3).
inline constexpr float kStickJointRadius = 0.026F;
inline constexpr float kStickFingerRadius = 0.0075F;
inline constexpr float kStickBoneRadius = 0.0135F;
inline constexpr float kStickFingerBoneRadius = 0.0052F;
inline constexpr float kStickTaper = 0.8F;  ///< a bone's far end against its near one
/// Of the side's colour on a bone; joints have all of it.
inline constexpr float kStickBoneTint = 0.16F;

enum class StickPart : std::uint8_t { middle, left, right };

/// Adds pieces of one bone, in its frame and colour.
class StickBuilder {
 public:
    StickBuilder(Shape<StickVertex>& shape, std::uint8_t bone, StickPart part)
        : shape_(shape), bone_(bone), part_(part) {}

    /// `tint`: share of the side's colour.
    void set_tint(float tint) noexcept;
    void add_ellipsoid(glm::vec3 middle, glm::vec3 radii, std::size_t rows, std::size_t columns);
    /// A cone without caps from one joint to another; spheres close it.
    void add_cone(glm::vec3 from, glm::vec3 to, float from_radius, float to_radius);
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
