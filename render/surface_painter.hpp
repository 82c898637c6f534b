#pragma once

#include <map>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "base/expected.hpp"
#include "render/avatar/expressions.hpp"
#include "render/avatar/surface.hpp"
#include "render/gl/mesh.hpp"
#include "render/gl/program.hpp"
#include "render/gl/texture.hpp"
#include "render/surface_material.hpp"

#include <glm/mat4x4.hpp>

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

/// One imported avatar's surface in the driver's memory. Dancers of it have numbers from 0 on. Sets
/// no state but program, vertex array, textures, face culling and blending; the frame's uniform
/// blocks must be bound. Threads: the context's.
class SurfacePainter {
 public:
    /// Uploads the surface; keeps no reference to it. `programs` must outlive it.
    /// Errors: a shader that the driver refuses.
    [[nodiscard]] static Expected<SurfacePainter> create(const Surface& surface,
                                                         SurfacePrograms& programs);

    /// Uploads the matrices of a dancer. `world`: of the avatar's joints.
    void set_joints(std::size_t dancer, std::span<const glm::mat4> world);

    /// The face of what is drawn until the next call: moves vertices, colours and textures where
    /// they differ from the last one's.
    void set_face(const FaceState& face);

    /// What of the surface: what hides all behind it, or what lets it through.
    enum class Layer { solid, blended };
    /// Draws a layer. `mirror`: 1, or -1 for the image in the floor; the caller then reverses the
    /// front face's winding. `seconds`: of stream time, for moving textures.
    struct Drawn {
        Layer layer = Layer::solid;
        float mirror = 1.0F;
        double seconds = 0.0;
        bool has_costume = true;  ///< parts of costumes are drawn, too
    };
    void draw(std::size_t dancer, const Drawn& drawn) const noexcept;

    /// Depth alone, for the shadow map.
    void draw_depth(std::size_t dancer,
                    const glm::mat4& clip_from_light,
                    bool has_costume) const noexcept;

 private:
    /// A part with what draws it.
    struct Part {
        SurfacePart range;
        const gl::Program* colour;
        const gl::Program* outline;  // null: none
        const gl::Program* depth;
        Layer layer;
        bool is_double_sided;
        bool writes_depth;
        bool is_costume;
        std::vector<std::pair<int, std::size_t>> textures;  // unit, index in textures_
    };
    SurfacePainter(const Surface& surface, Quality quality);
    [[nodiscard]] Expected<void> add_part(const Surface& surface,
                                          const SurfacePart& part,
                                          SurfacePrograms& programs);
    [[nodiscard]] std::size_t texture_for(const Surface& surface,
                                          const TextureUse& use,
                                          bool is_colour);
    void set_morphs(std::span<const float> weights);
    void set_materials(std::span<const MaterialFace> faces);
    void bind(std::size_t dancer, const Part& part) const noexcept;
    void draw_part(const Part& part,
                   const gl::Program& program,
                   float mirror,
                   float seconds) const noexcept;

    Quality quality_;
    gl::Mesh mesh_;
    std::vector<std::vector<gl::Buffer>> skins_;  // matrices by dancer and skin
    std::vector<gl::Buffer> materials_;           // SurfaceUniforms, one buffer a material
    std::vector<gl::Texture2d> textures_;
    std::map<std::pair<int, bool>, std::size_t> texture_of_;  // by model texture and colour space
    std::vector<Part> parts_;
    std::vector<SurfaceSkin> skin_joints_;
    // For morphs: the vertices at rest and as they are in the driver.
    std::vector<SurfaceMorph> morphs_;
    std::vector<SurfaceVertex> rest_;
    std::vector<SurfaceVertex> morphed_;
    std::vector<float> weights_;  // of FaceState::morphs
    std::vector<ModelMaterial> made_of_;
    std::vector<SurfaceUniforms> uniforms_;  // by material, as they are in the driver
};

}  // namespace raks::render
