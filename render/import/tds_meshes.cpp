#include "render/import/tds_meshes.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <numeric>
#include <tuple>
#include <unordered_map>
#include <utility>
#include <vector>

#include "base/printable.hpp"
#include "render/model/finite.hpp"

#include <glm/geometric.hpp>
#include <glm/mat3x3.hpp>
#include <glm/matrix.hpp>

namespace raks::render {
namespace {

/// For each vertex a number that those at the same place share.
std::vector<std::uint32_t> place_numbers(const std::vector<glm::vec3>& positions) {
    std::vector<std::uint32_t> order(positions.size());
    std::iota(order.begin(), order.end(), 0U);
    const auto key = [&positions](std::uint32_t i) {
        return std::tie(positions[i].x, positions[i].y, positions[i].z);
    };
    std::sort(order.begin(), order.end(), [&key](std::uint32_t a, std::uint32_t b) {
        return key(a) < key(b);
    });
    std::vector<std::uint32_t> numbers(positions.size());
    std::uint32_t number = 0;
    for (std::size_t i = 0; i < order.size(); ++i) {
        number += i > 0 && key(order[i - 1]) != key(order[i]) ? 1U : 0U;
        numbers[order[i]] = number;
    }
    return numbers;
}

/// Groups that meet at a place, and the sum of their triangles' normals. No two share a bit, so
/// there are at most 32.
struct SmoothFan {
    std::uint32_t groups = 0;
    glm::vec3 normal{0.0F};
};

/// The normals of an object's corners, in the file's world.
class SmoothNormals {
 public:
    explicit SmoothNormals(const TdsObject& object)
        : object_(object),
          numbers_(place_numbers(object.positions)),
          fans_(object.positions.size()) {
        for (std::size_t t = 0; t < object.triangles.size() && !object.smoothing.empty(); ++t) {
            for (const std::uint16_t corner : object.triangles[t]) {
                join(fans_[numbers_[corner]], object.smoothing[t]);
            }
        }
        for (std::size_t t = 0; t < object.triangles.size() && !object.smoothing.empty(); ++t) {
            for (std::size_t corner = 0; corner < 3; ++corner) {
                if (SmoothFan* const fan = fan_of(t, corner); fan != nullptr) {
                    fan->normal += angle_at(t, corner) * flat(t);
                }
            }
        }
    }

    /// Which fan of the corner's place it is; -1: the triangle is flat.
    [[nodiscard]] int fan_index(std::size_t triangle, std::size_t corner) const {
        const std::vector<SmoothFan>& fans = fans_[numbers_[object_.triangles[triangle][corner]]];
        const std::uint32_t groups = object_.smoothing.empty() ? 0 : object_.smoothing[triangle];
        for (std::size_t i = 0; i < fans.size() && groups != 0; ++i) {
            if ((fans[i].groups & groups) != 0) {
                return static_cast<int>(i);
            }
        }
        return -1;
    }

    /// Of length 1.
    [[nodiscard]] glm::vec3 at(std::size_t triangle, std::size_t corner) {
        const SmoothFan* const fan = fan_of(triangle, corner);
        const glm::vec3 sum = fan != nullptr ? fan->normal : glm::vec3(0.0F);
        return glm::length(sum) > kShortNormal ? glm::normalize(sum) : flat(triangle);
    }

 private:
    static constexpr float kShortNormal = 1e-6F;

    /// Takes groups in, joined with all that they share a bit with; no two of these share one.
    static void join(std::vector<SmoothFan>& fans, std::uint32_t groups) {
        if (groups == 0) {
            return;
        }
        std::erase_if(fans, [&groups](const SmoothFan& fan) {
            const bool is_shared = (fan.groups & groups) != 0;
            groups |= is_shared ? fan.groups : 0U;
            return is_shared;
        });
        fans.push_back({.groups = groups, .normal = glm::vec3(0.0F)});
    }

    [[nodiscard]] SmoothFan* fan_of(std::size_t triangle, std::size_t corner) {
        const int index = fan_index(triangle, corner);
        return index < 0 ? nullptr
                         : &fans_[numbers_[object_.triangles[triangle][corner]]]
                                 [static_cast<std::size_t>(index)];
    }

    [[nodiscard]] const glm::vec3& place(std::size_t triangle, std::size_t corner) const {
        return object_.positions[object_.triangles[triangle][corner % 3]];
    }

    /// The triangle's own normal; up where it has no area.
    [[nodiscard]] glm::vec3 flat(std::size_t triangle) const {
        const glm::dvec3 a = place(triangle, 0);
        const glm::dvec3 normal =
            glm::cross(glm::dvec3(place(triangle, 1)) - a, glm::dvec3(place(triangle, 2)) - a);
        const double length = glm::length(normal);
        return length > 0.0 ? glm::vec3(normal / length) : glm::vec3(0.0F, 0.0F, 1.0F);
    }

    [[nodiscard]] float angle_at(std::size_t triangle, std::size_t corner) const {
        const glm::vec3 one = place(triangle, corner + 1) - place(triangle, corner);
        const glm::vec3 other = place(triangle, corner + 2) - place(triangle, corner);
        const float lengths = glm::length(one) * glm::length(other);
        return lengths > 0.0F ? std::acos(std::clamp(glm::dot(one, other) / lengths, -1.0F, 1.0F))
                              : 0.0F;
    }

    const TdsObject& object_;
    std::vector<std::uint32_t> numbers_;
    std::vector<std::vector<SmoothFan>> fans_;  // by place
};

/// Makes the primitives of an object.
class MeshMaker {
 public:
    MeshMaker(const TdsObject& object, const glm::mat4& from_world)
        : object_(object),
          normals_(object),
          from_world_(from_world),
          normal_from_world_(glm::transpose(glm::inverse(glm::mat3(from_world)))) {}

    [[nodiscard]] ModelPrimitive primitive(int material,
                                           const std::vector<std::size_t>& triangles) {
        constexpr std::uint64_t kFansAtMost = 64;
        ModelPrimitive made;
        made.material = material;
        std::unordered_map<std::uint64_t, std::uint32_t> known;
        for (const std::size_t triangle : triangles) {
            for (std::size_t corner = 0; corner < 3; ++corner) {
                const std::uint64_t vertex = object_.triangles[triangle][corner];
                const int fan = normals_.fan_index(triangle, corner);
                auto index = static_cast<std::uint32_t>(made.positions.size());
                if (fan >= 0) {
                    index = known
                                .try_emplace(vertex * kFansAtMost + static_cast<std::uint64_t>(fan),
                                             index)
                                .first->second;
                }
                if (index == made.positions.size()) {
                    add_vertex(triangle, corner, made);
                }
                made.indices.push_back(index);
            }
        }
        return made;
    }

 private:
    void add_vertex(std::size_t triangle, std::size_t corner, ModelPrimitive& made) {
        const std::uint16_t vertex = object_.triangles[triangle][corner];
        made.positions.emplace_back(from_world_ * glm::vec4(object_.positions[vertex], 1.0F));
        const glm::vec3 normal = normal_from_world_ * normals_.at(triangle, corner);
        const float length = glm::length(normal);
        made.normals.push_back(length > 0.0F ? normal / length : glm::vec3(0.0F, 1.0F, 0.0F));
        if (!object_.uv.empty()) {
            made.uv[0].emplace_back(object_.uv[vertex].x, 1.0F - object_.uv[vertex].y);
        }
    }

    const TdsObject& object_;
    SmoothNormals normals_;
    glm::mat4 from_world_;
    glm::mat3 normal_from_world_;
};

/// Material of each triangle; -1: none.
std::vector<int> materials_of(const TdsObject& object,
                              const std::map<std::string, int>& materials) {
    std::vector<int> of_triangle(object.triangles.size(), -1);
    for (const TdsFaceGroup& group : object.groups) {
        const auto found = materials.find(group.material);
        for (const std::uint16_t triangle : group.triangles) {
            of_triangle[triangle] = found == materials.end() ? -1 : found->second;
        }
    }
    return of_triangle;
}

}  // namespace

Expected<ModelMesh> make_tds_mesh(const TdsObject& object,
                                  const glm::mat4& from_world,
                                  const std::map<std::string, int>& materials,
                                  ImportBudget& budget) {
    constexpr std::size_t kBytesPerTriangle = 3 * (4 + 12 + 12 + 8);
    constexpr std::size_t kBytesPerVertex = 36;  // while the normals are made
    if (!budget.claim(object.triangles.size(), kBytesPerTriangle) ||
        !budget.claim(object.positions.size(), kBytesPerVertex)) {
        return fail("the model needs too much memory");
    }
    ModelMesh mesh;
    mesh.name = printable(object.name, 200);
    std::map<int, std::vector<std::size_t>> by_material;
    const std::vector<int> of_triangle = materials_of(object, materials);
    for (std::size_t t = 0; t < of_triangle.size(); ++t) {
        by_material[of_triangle[t]].push_back(t);
    }
    MeshMaker maker(object, from_world);
    for (const auto& [material, triangles] : by_material) {
        mesh.primitives.push_back(maker.primitive(material, triangles));
        const std::vector<glm::vec3>& places = mesh.primitives.back().positions;
        if (!std::all_of(places.begin(), places.end(), [](const glm::vec3& place) {
                return is_finite(place);
            })) {
            return fail(fmt::format("\"{}\": its axes move it too far away", mesh.name));
        }
    }
    return mesh;
}

}  // namespace raks::render
