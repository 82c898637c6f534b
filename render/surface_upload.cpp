#include "render/surface_upload.hpp"

#include <algorithm>
#include <array>
#include <span>
#include <string_view>

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

const Image& image_of(const Surface& surface,
                      const SurfaceImages::Images& images,
                      int texture) noexcept {
    static const Image kWhite{1, 1, {255, 255, 255, 255}};
    const int place = surface.textures[static_cast<std::size_t>(texture)].image;
    if (place < 0 || images == nullptr) {
        return kWhite;
    }
    // Empty: it could not be read.
    const Image& image = (*images)[static_cast<std::size_t>(place)];
    return image.pixels.empty() ? kWhite : image;
}

gl::Texture2d room_for(const Image& image, const ModelTexture& texture, bool is_srgb) {
    return {image.width,
            image.height,
            {.is_srgb = is_srgb,
             .wrap_u = wrap_of(texture.wrap_u),
             .wrap_v = wrap_of(texture.wrap_v),
             .is_smooth = texture.is_smooth,
             .has_mipmaps = texture.has_mipmaps}};
}

bool has_outline(const ModelMaterial& material) noexcept {
    return material.mtoon && material.mtoon->outline_mode != OutlineWidth::none &&
           material.mtoon->outline_width > 0.0F;
}

LoadedSurface room_for(const Surface& surface, Quality quality) {
    return {.quality = quality,
            .mesh = gl::Mesh(surface.vertices.size() * sizeof(SurfaceVertex),
                             sizeof(SurfaceVertex),
                             kSurfaceAttributes,
                             surface.indices.size()),
            .materials = {},
            .textures = {},
            .parts = {},
            .skins = surface.skins,
            .made_of = surface.materials,
            .uniforms = {},
            .morphs = surface.morphs,
            .rest = {},
            .morphed = {}};
}

}  // namespace

Expected<const gl::Program*> SurfacePrograms::find(const ModelMaterial& material,
                                                   SurfacePass pass) {
    static constexpr std::array<std::string_view, 6> kVertex = {
        "frame.glsl", "dress.glsl", "skin.glsl", "light.glsl", "surface.glsl", "surface.vert"};
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

SurfaceUpload::SurfaceUpload(const Surface& surface, SurfacePrograms& programs)
    : surface_(&surface),
      images_(surface.images == nullptr ? nullptr : surface.images->get()),
      programs_(&programs),
      loaded_(room_for(surface, programs.quality())) {
    for (const ModelMaterial& material : surface.materials) {
        const SurfaceUniforms& uniforms =
            loaded_.uniforms.emplace_back(surface_uniforms(material, loaded_.quality));
        glBindBuffer(GL_UNIFORM_BUFFER, loaded_.materials.emplace_back().name());
        glBufferData(GL_UNIFORM_BUFFER, sizeof(uniforms), &uniforms, GL_STATIC_DRAW);
    }
    for (const SurfacePart& part : surface.parts) {
        add_part(part);
    }
}

// All of a part but its programs.
void SurfaceUpload::add_part(const SurfacePart& part) {
    const ModelMaterial& material = surface_->materials[static_cast<std::size_t>(part.material)];
    const bool is_blended = material.alpha_mode == AlphaMode::blend;
    LoadedPart& made = loaded_.parts.emplace_back();
    made.range = part;
    made.layer = is_blended ? SurfaceLayer::blended : SurfaceLayer::solid;
    made.is_double_sided = material.is_double_sided;
    made.is_costume = material.is_costume;
    made.writes_depth = !is_blended || (material.mtoon && material.mtoon->transparent_with_z_write);
}

// The textures that a part's programs read.
void SurfaceUpload::plan_textures(LoadedPart& part) {
    const ModelMaterial& material =
        surface_->materials[static_cast<std::size_t>(part.range.material)];
    for (std::size_t i = 0; i < kSurfaceSlots; ++i) {
        const auto slot = static_cast<SurfaceSlot>(i);
        const TextureUse& use = slot_use(material, slot);
        if (use.texture >= 0 && is_read(slot, {part.colour, part.outline, part.depth})) {
            part.textures.emplace_back(unit_of(slot), planned(use, slot_names(slot).is_colour));
        }
    }
}

// Its place among the textures that are uploaded.
std::size_t SurfaceUpload::planned(const TextureUse& use, bool is_colour) {
    // Fast shaders take shown colours as they are.
    const TextureKey key{use.texture, is_colour && loaded_.quality != Quality::fast};
    const auto [place, is_new] = texture_of_.try_emplace(key, wanted_.size());
    if (is_new) {
        wanted_.push_back(key);
    }
    return place->second;
}

Expected<bool> SurfaceUpload::next() {
    if (put_vertices() || put_indices()) {
        return false;
    }
    if (part_ < loaded_.parts.size()) {
        if (auto added = add_program(); !added) {
            return fail(std::move(added.error()));
        }
        return false;
    }
    if (put_texture()) {
        return false;
    }
    if (images_ != nullptr) {
        images_.reset();
        surface_->images->let_go();
    }
    return true;
}

// True: there was something to do.
bool SurfaceUpload::put_vertices() {
    const std::span<const SurfaceVertex> left = std::span(surface_->vertices).subspan(vertices_);
    const std::span<const SurfaceVertex> piece =
        left.first(std::min(left.size(), kPieceBytes / sizeof(SurfaceVertex)));
    if (piece.empty()) {
        return false;
    }
    loaded_.mesh.replace_vertices(vertices_ * sizeof(SurfaceVertex), std::as_bytes(piece));
    if (!loaded_.morphs.empty()) {
        loaded_.rest.insert(loaded_.rest.end(), piece.begin(), piece.end());
        loaded_.morphed.insert(loaded_.morphed.end(), piece.begin(), piece.end());
    }
    vertices_ += piece.size();
    return true;
}

bool SurfaceUpload::put_indices() {
    const std::span<const std::uint32_t> left = std::span(surface_->indices).subspan(indices_);
    const std::span<const std::uint32_t> piece =
        left.first(std::min(left.size(), kPieceBytes / sizeof(std::uint32_t)));
    if (piece.empty()) {
        return false;
    }
    loaded_.mesh.replace_indices(indices_ * sizeof(std::uint32_t), std::as_bytes(piece));
    indices_ += piece.size();
    return true;
}

// Some rows of a texture, or, behind the last, its smaller copies.
bool SurfaceUpload::put_texture() {
    if (texture_ == wanted_.size()) {
        return false;
    }
    const auto [index, is_srgb] = wanted_[texture_];
    const Image& image = image_of(*surface_, images_, index);
    if (row_ == 0) {
        loaded_.textures.push_back(
            room_for(image, surface_->textures[static_cast<std::size_t>(index)], is_srgb));
    }
    if (row_ == image.height) {
        loaded_.textures.back().finish(image.pixels);
        ++texture_;
        row_ = 0;
        return true;
    }
    const std::size_t row_bytes = static_cast<std::size_t>(image.width) * 4;
    const int rows = std::min(image.height - row_,
                              static_cast<int>(std::max<std::size_t>(kPieceBytes / row_bytes, 1)));
    loaded_.textures.back().put_rows(row_,
                                     rows,
                                     std::span(image.pixels)
                                         .subspan(static_cast<std::size_t>(row_) * row_bytes,
                                                  static_cast<std::size_t>(rows) * row_bytes));
    row_ += rows;
    return true;
}

// One program of one part; those that another part has had built cost nothing.
Expected<void> SurfaceUpload::add_program() {
    LoadedPart& part = loaded_.parts[part_];
    const ModelMaterial& material =
        surface_->materials[static_cast<std::size_t>(part.range.material)];
    const std::array<std::pair<SurfacePass, const gl::Program**>, 3> passes = {
        {{SurfacePass::colour, &part.colour},
         {SurfacePass::depth, &part.depth},
         {SurfacePass::outline, &part.outline}}};
    const auto [pass, program] = passes[pass_];
    if (pass != SurfacePass::outline || has_outline(material)) {
        Expected<const gl::Program*> found = programs_->find(material, pass);
        if (!found) {
            return fail(std::move(found.error()));
        }
        *program = *found;
    }
    pass_ = (pass_ + 1) % passes.size();
    if (pass_ == 0) {
        plan_textures(part);
        ++part_;
    }
    return {};
}

}  // namespace raks::render
