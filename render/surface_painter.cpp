#include "render/surface_painter.hpp"

#include <algorithm>
#include <cstddef>
#include <cstring>
#include <initializer_list>
#include <utility>

#include <glm/geometric.hpp>
#include <glm/mat3x4.hpp>
#include <glm/matrix.hpp>

namespace raks::render {
namespace {

constexpr std::size_t kBoneRows = 3 * SurfaceSkin::kMostJoints;

std::int16_t snorm16(float value) noexcept {
    return static_cast<std::int16_t>(std::clamp(value, -1.0F, 1.0F) * 32767.0F);
}

glm::vec3 normal_of(const SurfaceVertex& vertex) noexcept {
    return glm::vec3(vertex.normal[0], vertex.normal[1], vertex.normal[2]) / 32767.0F;
}

/// Adds a morph target to the vertices, normals included.
void add_morph(const SurfaceMorph& morph, float weight, std::span<SurfaceVertex> vertices) {
    for (std::size_t i = 0; i < morph.vertices.size(); ++i) {
        SurfaceVertex& vertex = vertices[morph.vertices[i]];
        for (int axis = 0; axis < 3; ++axis) {
            vertex.position[static_cast<std::size_t>(axis)] += weight * morph.positions[i][axis];
        }
        if (!morph.normals.empty()) {
            const glm::vec3 normal = normal_of(vertex) + weight * morph.normals[i];
            const float length = std::max(glm::length(normal), 1e-6F);
            vertex.normal = {snorm16(normal.x / length),
                             snorm16(normal.y / length),
                             snorm16(normal.z / length),
                             0};
        }
    }
}

/// The state that parts may have changed.
void end_drawing() noexcept {
    glDisable(GL_BLEND);
    glDepthMask(GL_TRUE);
    glActiveTexture(GL_TEXTURE0);
}

}  // namespace

void SurfacePainter::set_joints(std::size_t dancer, std::span<const glm::mat4> world) {
    while (skins_.size() <= dancer) {
        skins_.emplace_back(loaded_.skins.size());
    }
    std::array<glm::mat3x4, SurfaceSkin::kMostJoints> rows;
    for (std::size_t s = 0; s < loaded_.skins.size(); ++s) {
        const SurfaceSkin& skin = loaded_.skins[s];
        for (std::size_t i = 0; i < skin.joints.size(); ++i) {
            const glm::mat4 matrix =
                world[static_cast<std::size_t>(skin.joints[i])] * skin.inverse_bind[i];
            rows[i] = glm::mat3x4(glm::transpose(matrix));
        }
        glBindBuffer(GL_UNIFORM_BUFFER, skins_[dancer][s].name());
        // The block has room for the most joints; what is behind these is never read.
        glBufferData(GL_UNIFORM_BUFFER, kBoneRows * sizeof(glm::vec4), nullptr, GL_STREAM_DRAW);
        glBufferSubData(GL_UNIFORM_BUFFER,
                        0,
                        static_cast<GLsizeiptr>(skin.joints.size() * sizeof(glm::mat3x4)),
                        rows.data());
    }
}

void SurfacePainter::set_face(const FaceState& face) {
    if (!loaded_.morphs.empty()) {
        set_morphs(face.morphs);
    }
    set_materials(face.materials);
}

void SurfacePainter::set_materials(std::span<const MaterialFace> faces) {
    for (const MaterialFace& face : faces) {
        const auto place = static_cast<std::size_t>(face.material);
        const SurfaceUniforms uniforms =
            surface_uniforms(with_face(loaded_.made_of[place], face), loaded_.quality);
        if (std::memcmp(&uniforms, &loaded_.uniforms[place], sizeof(uniforms)) != 0) {
            loaded_.uniforms[place] = uniforms;
            glBindBuffer(GL_UNIFORM_BUFFER, loaded_.materials[place].name());
            glBufferData(GL_UNIFORM_BUFFER, sizeof(uniforms), &uniforms, GL_STREAM_DRAW);
        }
    }
}

void SurfacePainter::set_morphs(std::span<const float> weights) {
    if (std::equal(weights.begin(), weights.end(), weights_.begin(), weights_.end())) {
        return;
    }
    weights_.assign(weights.begin(), weights.end());
    // All vertices that any morph moves begin again from rest.
    std::size_t first = loaded_.rest.size();
    std::size_t end = 0;
    for (const SurfaceMorph& morph : loaded_.morphs) {
        for (const std::uint32_t vertex : morph.vertices) {
            loaded_.morphed[vertex] = loaded_.rest[vertex];
            first = std::min<std::size_t>(first, vertex);
            end = std::max<std::size_t>(end, vertex + 1);
        }
    }
    for (const SurfaceMorph& morph : loaded_.morphs) {
        if (weights_[morph.weight] != 0.0F) {
            add_morph(morph, weights_[morph.weight], loaded_.morphed);
        }
    }
    if (first < end) {
        const std::span<const SurfaceVertex> moved =
            std::span<const SurfaceVertex>(loaded_.morphed).subspan(first, end - first);
        loaded_.mesh.replace_vertices(first * sizeof(SurfaceVertex), std::as_bytes(moved));
    }
}

void SurfacePainter::bind(std::size_t dancer, const LoadedPart& part) const noexcept {
    for (const auto& [unit, texture] : part.textures) {
        loaded_.textures[texture].bind(unit);
    }
    glBindBufferBase(GL_UNIFORM_BUFFER,
                     gl::kBonesBinding,
                     skins_[dancer][static_cast<std::size_t>(part.range.skin)].name());
    glBindBufferBase(GL_UNIFORM_BUFFER,
                     gl::kSurfaceBinding,
                     loaded_.materials[static_cast<std::size_t>(part.range.material)].name());
}

void SurfacePainter::draw_with(const gl::Program& program,
                               const LoadedPart& part,
                               const Stroke& stroke) const noexcept {
    program.use();
    glUniform1f(program.uniform("mirror"), stroke.mirror);
    glUniform1f(program.uniform("seconds"), stroke.seconds);
    loaded_.mesh.draw_range(part.range.first_index, stroke.indices);
}

void SurfacePainter::draw_colour(const LoadedPart& part, const Stroke& stroke) const noexcept {
    if (part.layer == SurfaceLayer::blended) {
        glEnable(GL_BLEND);
        glDepthMask(part.writes_depth ? GL_TRUE : GL_FALSE);
    }
    if (part.is_double_sided) {
        glDisable(GL_CULL_FACE);
    }
    draw_with(*part.colour, part, stroke);
    glEnable(GL_CULL_FACE);
}

void SurfacePainter::draw_outline(const LoadedPart& part, const Stroke& stroke) const noexcept {
    if (part.outline != nullptr) {
        glCullFace(GL_FRONT);
        draw_with(*part.outline, part, stroke);
        glCullFace(GL_BACK);
    }
}

void SurfacePainter::draw(std::size_t dancer, const Drawn& drawn) const noexcept {
    for (const LoadedPart& part : loaded_.parts) {
        if (part.layer == drawn.layer && (drawn.has_costume || !part.is_costume)) {
            const Stroke all{
                part.range.index_count, drawn.mirror, static_cast<float>(drawn.seconds)};
            bind(dancer, part);
            draw_colour(part, all);
            draw_outline(part, all);
        }
    }
    end_drawing();
}

// Even steps are colours, odd ones outlines.
bool SurfacePainter::warm_up(std::size_t step) const noexcept {
    if (step / 2 >= loaded_.parts.size()) {
        return false;
    }
    constexpr Stroke kOneTriangle{3, 1.0F, 0.0F};
    const LoadedPart& part = loaded_.parts[step / 2];
    bind(0, part);
    step % 2 == 0 ? draw_colour(part, kOneTriangle) : draw_outline(part, kOneTriangle);
    end_drawing();
    return true;
}

void SurfacePainter::draw_depth(std::size_t dancer,
                                const glm::mat4& clip_from_light,
                                bool has_costume) const noexcept {
    for (const LoadedPart& part : loaded_.parts) {
        // What lets light through casts no shadow.
        if (part.layer == SurfaceLayer::solid && (has_costume || !part.is_costume)) {
            bind(dancer, part);
            part.depth->use();
            glUniformMatrix4fv(
                part.depth->uniform("clip_from_light"), 1, GL_FALSE, &clip_from_light[0][0]);
            loaded_.mesh.draw_range(part.range.first_index, part.range.index_count);
        }
    }
    glActiveTexture(GL_TEXTURE0);
}

}  // namespace raks::render
