#include "tests/render/avatar/posed_mesh.hpp"
#include "render/avatar/avatar.hpp"
#include "render/mannequin/mannequin.hpp"

#include <array>

#include <glm/geometric.hpp>
#include <glm/vec4.hpp>

namespace raks::render::test {

const Avatar& mannequin() {
    static const Avatar avatar = build_mannequin();
    return avatar;
}

glm::vec3 bind_position(std::size_t vertex) {
    const auto& p = mannequin().vertices[vertex].position;
    return {p[0], p[1], p[2]};
}

glm::vec3 bind_normal(std::size_t vertex) {
    const auto& n = mannequin().vertices[vertex].normal;
    return glm::vec3{static_cast<float>(n[0]), static_cast<float>(n[1]), static_cast<float>(n[2])} /
           32767.0F;
}

std::size_t triangle_count() { return mannequin().indices.size() / 3; }

std::size_t corner(std::size_t triangle, std::size_t k) {
    return mannequin().indices[3 * triangle + k];
}

std::vector<glm::vec3> posed(const motion::Pose& pose) {
    std::array<glm::mat4, kPaletteSize> palette{};
    skinning_palette(mannequin(), pose, palette);
    std::vector<glm::vec3> positions;
    positions.reserve(mannequin().vertices.size());
    for (std::size_t i = 0; i < mannequin().vertices.size(); ++i) {
        const AvatarVertex& vertex = mannequin().vertices[i];
        const glm::vec4 bind(bind_position(i), 1.0F);
        glm::vec4 sum{0.0F};
        for (std::size_t k = 0; k < vertex.joints.size(); ++k) {
            const float weight = static_cast<float>(vertex.weights[k]) / 255.0F;
            sum += weight * (palette[vertex.joints[k]] * bind);
        }
        positions.emplace_back(sum);
    }
    return positions;
}

double volume_of(const std::vector<glm::vec3>& positions) {
    double sum = 0.0;
    for (std::size_t t = 0; t < triangle_count(); ++t) {
        const glm::vec3 a = positions[corner(t, 0)];
        const glm::vec3 b = positions[corner(t, 1)];
        const glm::vec3 c = positions[corner(t, 2)];
        sum += static_cast<double>(glm::dot(a, glm::cross(b, c)));
    }
    return sum / 6.0;
}

std::string_view joint_name(std::size_t joint) {
    return joint < motion::kBoneNames.size()
               ? motion::kBoneNames[joint]
               : mannequin().helpers[joint - motion::kBoneNames.size()].name;
}

}  // namespace raks::render::test
