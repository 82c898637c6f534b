#pragma once

#include <cstddef>
#include <string_view>
#include <vector>

#include "render/avatar/avatar.hpp"

#include <glm/vec3.hpp>

namespace raks::render::test {

/// The mannequin, built once for all tests.
const Avatar& mannequin();

glm::vec3 bind_position(std::size_t vertex);
glm::vec3 bind_normal(std::size_t vertex);
std::size_t triangle_count();
/// Corner 0..2 of a triangle.
std::size_t corner(std::size_t triangle, std::size_t k);

/// Vertex positions of a pose by linear blend skinning, as the vertex shader does it.
std::vector<glm::vec3> posed(const motion::Pose& pose);

/// Cubic metres within a closed mesh of the mannequin's triangles.
double volume_of(const std::vector<glm::vec3>& positions);

/// Share of the weights of `vertex` that joints with `is_counted(joint)` hold, 0 to 1.
template <typename Predicate>
float share_of(const AvatarVertex& vertex, Predicate is_counted) {
    int sum = 0;
    for (std::size_t k = 0; k < vertex.joints.size(); ++k) {
        sum += is_counted(vertex.joints[k]) ? vertex.weights[k] : 0;
    }
    return static_cast<float>(sum) / 255.0F;
}

/// "leftElbowHalf": the bone's or the helper's name.
std::string_view joint_name(std::size_t joint);

}  // namespace raks::render::test
