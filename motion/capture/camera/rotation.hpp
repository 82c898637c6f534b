// Rotations as vectors: what files of cameras and least squares write instead of matrices.
#pragma once

#include <glm/mat3x3.hpp>
#include <glm/vec3.hpp>

namespace raks::capture {

/// The rotation about an axis by as many radians as the vector is long (Rodrigues).
[[nodiscard]] glm::dmat3 rotation_of(const glm::dvec3& vector) noexcept;

/// The vector of a rotation, at most pi long: the inverse of rotation_of.
[[nodiscard]] glm::dvec3 rotation_vector(const glm::dmat3& rotation) noexcept;

}  // namespace raks::capture
