// From an avatar's surface to what lies in the driver's memory, in pieces: none keeps a picture
// waiting for long.
#pragma once

#include <cstddef>
#include <map>
#include <memory>
#include <string>
#include <utility>
#include <vector>

#include "base/expected.hpp"
#include "render/avatar/surface.hpp"
#include "render/gl/mesh.hpp"
#include "render/gl/shader_program.hpp"
#include "render/gl/texture.hpp"
#include "render/surface_material.hpp"

namespace raks::render {

/// The programs of all surfaces of a renderer: materials that need the same shaders share one.
class SurfacePrograms {
 public:
    explicit SurfacePrograms(Quality quality) : quality_(quality) {}
    /// Builds it when it is first asked for. Errors: a shader that the driver refuses. The pointer
    /// holds as long as this object.
    [[nodiscard]] Expected<const gl::Program*> find(const ModelMaterial& material,
                                                    SurfacePass pass);
    [[nodiscard]] Quality quality() const noexcept { return quality_; }

 private:
    Quality quality_;
    std::map<std::string, std::unique_ptr<gl::Program>> programs_;  // by their macros
};

/// What of a surface: what hides all behind it, or what lets it through.
enum class SurfaceLayer { solid, blended };

/// A part with what draws it.
struct LoadedPart {
    SurfacePart range;
    const gl::Program* colour = nullptr;
    const gl::Program* outline = nullptr;  ///< null: none
    const gl::Program* depth = nullptr;
    SurfaceLayer layer = SurfaceLayer::solid;
    bool is_double_sided = false;
    bool writes_depth = true;
    bool is_costume = false;                            // drawn where the theme dresses its dancers
    std::vector<std::pair<int, std::size_t>> textures;  ///< unit, index in `textures`
};

/// A surface in the driver's memory, and what of it is needed here to move it.
struct LoadedSurface {
    Quality quality;
    gl::Mesh mesh;
    std::vector<gl::Buffer> materials;  ///< SurfaceUniforms, one buffer a material
    std::vector<gl::Texture2d> textures;
    std::vector<LoadedPart> parts;
    std::vector<SurfaceSkin> skins;
    std::vector<ModelMaterial> made_of;
    std::vector<SurfaceUniforms> uniforms;  ///< by material, as they are in the driver
    // For morphs: the vertices at rest and as they are in the driver.
    std::vector<SurfaceMorph> morphs;
    std::vector<SurfaceVertex> rest;
    std::vector<SurfaceVertex> morphed;
};

/// Uploads one surface. Threads: the context's.
///
///     SurfaceUpload upload(surface, programs);
///     while (!*upload.next()) {}       // Errors are looked at, too
///     SurfacePainter painter(std::move(upload).finished());
class SurfaceUpload {
 public:
    /// `surface` must live until the last piece, when its images are let go, `programs` longer.
    SurfaceUpload(const Surface& surface, SurfacePrograms& programs);
    /// Does the next piece: one program, or about kPieceBytes. True: it was the last.
    /// Errors: a shader that the driver refuses.
    [[nodiscard]] Expected<bool> next();
    /// Precondition: next() has returned true.
    [[nodiscard]] LoadedSurface finished() && noexcept { return std::move(loaded_); }

    static constexpr std::size_t kPieceBytes = std::size_t{1} << 20U;

 private:
    [[nodiscard]] bool put_vertices();
    [[nodiscard]] bool put_indices();
    [[nodiscard]] bool put_texture();
    [[nodiscard]] Expected<void> add_program();
    void plan_textures(LoadedPart& part);
    void add_part(const SurfacePart& part);
    [[nodiscard]] std::size_t planned(const TextureUse& use, bool is_colour);

    const Surface* surface_;
    SurfaceImages::Images images_;  // null: it has none, or all are there
    SurfacePrograms* programs_;
    LoadedSurface loaded_;
    /// A texture that parts use, and whether its sampler makes shown colours linear.
    using TextureKey = std::pair<int, bool>;
    std::vector<TextureKey> wanted_;
    std::map<TextureKey, std::size_t> texture_of_;  // index in loaded_.textures
    // How far it is.
    std::size_t vertices_ = 0;
    std::size_t indices_ = 0;
    std::size_t texture_ = 0;  // in wanted_
    int row_ = 0;              // of that texture
    std::size_t part_ = 0;
    std::size_t pass_ = 0;  // of that part
};

}  // namespace raks::render
