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

using gl::Attribute;
using gl::Reading;

// Locations as in skin.glsl and surface.vert; layout as in surface.hpp.
constexpr std::array<Attribute, 7> kSurfaceAttributes = {{
    {0, 3, GL_FLOAT, Reading::normalized, offsetof(SurfaceVertex, position)},
    {1, 3, GL_SHORT, Reading::normalized, offsetof(SurfaceVertex, normal)},
    {2, 4, GL_UNSIGNED_SHORT, Reading::raw, offsetof(SurfaceVertex, joints)},
    {3, 4, GL_UNSIGNED_SHORT, Reading::normalized, offsetof(SurfaceVertex, weights)},
    {4, 4, GL_SHORT, Reading::normalized, offsetof(SurfaceVertex, tangent)},
    {5, 4, GL_FLOAT, Reading::normalized, offsetof(SurfaceVertex, uv)},
    {6, 4, GL_UNSIGNED_SHORT, Reading::normalized, offsetof(SurfaceVertex, colour)},
}};

constexpr std::size_t kBoneRows = 3 * SurfaceSkin::kMostJoints;
// Units from 1 on: the shadow map has 0.
constexpr int unit_of(SurfaceSlot slot) noexcept { return static_cast<int>(slot) + 1; }

std::string joined(const std::vector<std::string_view>& macros) {
    std::string all;
    for (const std::string_view macro : macros) {
        all.append(macro).append(" ");
    }
    return all;
}

/// Whether a program samples the texture of a slot. Fast shaders have no use for some.
bool is_read(SurfaceSlot slot, std::initializer_list<const gl::Program*> programs) noexcept {
    return std::any_of(programs.begin(), programs.end(), [slot](const gl::Program* program) {
        return program != nullptr && program->uniform(slot_names(slot).sampler.data()) >= 0;
    });
}

/// The samplers' units never change: they are set once.
void set_units(const gl::Program& program) noexcept {
    program.use();
    for (std::size_t i = 0; i < kSurfaceSlots; ++i) {
        const auto slot = static_cast<SurfaceSlot>(i);
        const GLint place = program.uniform(slot_names(slot).sampler.data());
        if (place >= 0) {
            glUniform1i(place, unit_of(slot));
        }
    }
}

GLint wrap_of(TextureWrap wrap) noexcept {
    switch (wrap) {
        case TextureWrap::repeat:
            return GL_REPEAT;
        case TextureWrap::mirror:
            return GL_MIRRORED_REPEAT;
        case TextureWrap::clamp:
            return GL_CLAMP_TO_EDGE;
    }
    return GL_REPEAT;
}

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

}  // namespace

Expected<const gl::Program*> SurfacePrograms::find(const ModelMaterial& material,
                                                   SurfacePass pass) {
    static constexpr std::array<std::string_view, 5> kVertex = {
        "frame.glsl", "skin.glsl", "light.glsl", "surface.glsl", "surface.vert"};
    static constexpr std::array<std::string_view, 4> kFast = {
        "frame.glsl", "light.glsl", "surface.glsl", "surface.frag"};
    static constexpr std::array<std::string_view, 5> kHigh = {
        "frame.glsl", "light.glsl", "shadow.glsl", "surface.glsl", "surface.frag"};
    const std::vector<std::string_view> macros = surface_macros(material, pass, quality_);
    std::unique_ptr<gl::Program>& program = programs_[joined(macros)];
    if (program == nullptr) {
        const auto fragment = quality_ == Quality::fast ? std::span<const std::string_view>(kFast)
                                                        : std::span<const std::string_view>(kHigh);
        Expected<gl::Program> built =
            gl::Program::build({"surface (" + joined(macros) + ")", kVertex, fragment, macros});
        if (!built) {
            return fail(std::move(built.error()));
        }
        program = std::make_unique<gl::Program>(std::move(*built));
        set_units(*program);
    }
    return program.get();
}

SurfacePainter::SurfacePainter(const Surface& surface, Quality quality)
    : quality_(quality),
      mesh_(std::as_bytes(std::span(surface.vertices)),
            sizeof(SurfaceVertex),
            kSurfaceAttributes,
            std::span<const std::uint32_t>(surface.indices)),
      skin_joints_(surface.skins),
      morphs_(surface.morphs),
      made_of_(surface.materials) {
    if (!morphs_.empty()) {
        rest_ = surface.vertices;
        morphed_ = surface.vertices;
    }
    for (const ModelMaterial& material : surface.materials) {
        const SurfaceUniforms& uniforms =
            uniforms_.emplace_back(surface_uniforms(material, quality));
        glBindBuffer(GL_UNIFORM_BUFFER, materials_.emplace_back().name());
        glBufferData(GL_UNIFORM_BUFFER, sizeof(uniforms), &uniforms, GL_STATIC_DRAW);
    }
}

Expected<SurfacePainter> SurfacePainter::create(const Surface& surface, SurfacePrograms& programs) {
    SurfacePainter painter(surface, programs.quality());
    for (const SurfacePart& part : surface.parts) {
        if (Expected<void> added = painter.add_part(surface, part, programs); !added) {
            return fail(std::move(added.error()));
        }
    }
    return painter;
}

Expected<void> SurfacePainter::add_part(const Surface& surface,
                                        const SurfacePart& part,
                                        SurfacePrograms& programs) {
    const ModelMaterial& material = surface.materials[static_cast<std::size_t>(part.material)];
    const bool is_blended = material.alpha_mode == AlphaMode::blend;
    Part made{
        .range = part,
        .colour = nullptr,
        .outline = nullptr,
        .depth = nullptr,
        .layer = is_blended ? Layer::blended : Layer::solid,
        .is_double_sided = material.is_double_sided,
        .writes_depth = !is_blended || (material.mtoon && material.mtoon->transparent_with_z_write),
        .textures = {}};
    const bool has_outline = material.mtoon && material.mtoon->outline_mode != OutlineWidth::none &&
                             material.mtoon->outline_width > 0.0F;
    for (const auto& [pass, program] : {std::pair{SurfacePass::colour, &made.colour},
                                        std::pair{SurfacePass::outline, &made.outline},
                                        std::pair{SurfacePass::depth, &made.depth}}) {
        if (pass == SurfacePass::outline && !has_outline) {
            continue;
        }
        Expected<const gl::Program*> found = programs.find(material, pass);
        if (!found) {
            return fail(std::move(found.error()));
        }
        *program = *found;
    }
    for (std::size_t i = 0; i < kSurfaceSlots; ++i) {
        const auto slot = static_cast<SurfaceSlot>(i);
        const TextureUse& use = slot_use(material, slot);
        if (use.texture >= 0 && is_read(slot, {made.colour, made.outline, made.depth})) {
            made.textures.emplace_back(unit_of(slot),
                                       texture_for(surface, use, slot_names(slot).is_colour));
        }
    }
    parts_.push_back(std::move(made));
    return {};
}

std::size_t SurfacePainter::texture_for(const Surface& surface,
                                        const TextureUse& use,
                                        bool is_colour) {
    // Fast shaders take shown colours as they are.
    const bool is_srgb = is_colour && quality_ != Quality::fast;
    const auto [place, is_new] = texture_of_.try_emplace({use.texture, is_srgb}, textures_.size());
    if (is_new) {
        const ModelTexture& texture = surface.textures[static_cast<std::size_t>(use.texture)];
        static const Image kWhite{1, 1, {255, 255, 255, 255}};
        const Image& image =
            texture.image < 0 ? kWhite : surface.images[static_cast<std::size_t>(texture.image)];
        textures_.emplace_back(image.width,
                               image.height,
                               image.pixels,
                               gl::TextureSampling{.is_srgb = is_srgb,
                                                   .wrap_u = wrap_of(texture.wrap_u),
                                                   .wrap_v = wrap_of(texture.wrap_v),
                                                   .is_smooth = texture.is_smooth,
                                                   .has_mipmaps = texture.has_mipmaps});
    }
    return place->second;
}

void SurfacePainter::set_joints(std::size_t dancer, std::span<const glm::mat4> world) {
    while (skins_.size() <= dancer) {
        skins_.emplace_back(skin_joints_.size());
    }
    std::array<glm::mat3x4, SurfaceSkin::kMostJoints> rows;
    for (std::size_t s = 0; s < skin_joints_.size(); ++s) {
        const SurfaceSkin& skin = skin_joints_[s];
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
    if (!morphs_.empty()) {
        set_morphs(face.morphs);
    }
    set_materials(face.materials);
}

void SurfacePainter::set_materials(std::span<const MaterialFace> faces) {
    for (const MaterialFace& face : faces) {
        const auto place = static_cast<std::size_t>(face.material);
        const SurfaceUniforms uniforms =
            surface_uniforms(with_face(made_of_[place], face), quality_);
        if (std::memcmp(&uniforms, &uniforms_[place], sizeof(uniforms)) != 0) {
            uniforms_[place] = uniforms;
            glBindBuffer(GL_UNIFORM_BUFFER, materials_[place].name());
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
    std::size_t first = rest_.size();
    std::size_t end = 0;
    for (const SurfaceMorph& morph : morphs_) {
        for (const std::uint32_t vertex : morph.vertices) {
            morphed_[vertex] = rest_[vertex];
            first = std::min<std::size_t>(first, vertex);
            end = std::max<std::size_t>(end, vertex + 1);
        }
    }
    for (const SurfaceMorph& morph : morphs_) {
        if (weights_[morph.weight] != 0.0F) {
            add_morph(morph, weights_[morph.weight], morphed_);
        }
    }
    if (first < end) {
        const std::span<const SurfaceVertex> moved =
            std::span<const SurfaceVertex>(morphed_).subspan(first, end - first);
        mesh_.replace_vertices(first * sizeof(SurfaceVertex), std::as_bytes(moved));
    }
}

void SurfacePainter::bind(std::size_t dancer, const Part& part) const noexcept {
    for (const auto& [unit, texture] : part.textures) {
        textures_[texture].bind(unit);
    }
    glBindBufferBase(GL_UNIFORM_BUFFER,
                     gl::kBonesBinding,
                     skins_[dancer][static_cast<std::size_t>(part.range.skin)].name());
    glBindBufferBase(GL_UNIFORM_BUFFER,
                     gl::kSurfaceBinding,
                     materials_[static_cast<std::size_t>(part.range.material)].name());
}

void SurfacePainter::draw_part(const Part& part,
                               const gl::Program& program,
                               float mirror,
                               float seconds) const noexcept {
    program.use();
    glUniform1f(program.uniform("mirror"), mirror);
    glUniform1f(program.uniform("seconds"), seconds);
    mesh_.draw_range(part.range.first_index, part.range.index_count);
}

void SurfacePainter::draw(std::size_t dancer,
                          Layer layer,
                          float mirror,
                          double seconds) const noexcept {
    const auto now = static_cast<float>(seconds);
    for (const Part& part : parts_) {
        if (part.layer != layer) {
            continue;
        }
        bind(dancer, part);
        if (layer == Layer::blended) {
            glEnable(GL_BLEND);
            glDepthMask(part.writes_depth ? GL_TRUE : GL_FALSE);
        }
        if (part.is_double_sided) {
            glDisable(GL_CULL_FACE);
        }
        draw_part(part, *part.colour, mirror, now);
        glEnable(GL_CULL_FACE);
        if (part.outline != nullptr) {
            glCullFace(GL_FRONT);
            draw_part(part, *part.outline, mirror, now);
            glCullFace(GL_BACK);
        }
    }
    glDisable(GL_BLEND);
    glDepthMask(GL_TRUE);
    glActiveTexture(GL_TEXTURE0);
}

void SurfacePainter::draw_depth(std::size_t dancer,
                                const glm::mat4& clip_from_light) const noexcept {
    for (const Part& part : parts_) {
        // What lets light through casts no shadow.
        if (part.layer == Layer::solid) {
            bind(dancer, part);
            part.depth->use();
            glUniformMatrix4fv(
                part.depth->uniform("clip_from_light"), 1, GL_FALSE, &clip_from_light[0][0]);
            mesh_.draw_range(part.range.first_index, part.range.index_count);
        }
    }
    glActiveTexture(GL_TEXTURE0);
}

}  // namespace raks::render
