#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <utility>
#include <vector>

#include "render/avatar/expressions.hpp"
#include "render/gl/shader_program.hpp"
#include "render/surface_upload.hpp"

#include <glm/mat4x4.hpp>

namespace raks::render {

/// One imported avatar's surface in the driver's memory. Dancers of it have numbers from 0 on. Sets
/// no state but program, vertex array, textures, face culling and blending; the frame's uniform
/// blocks must be bound. Threads: the context's.
class SurfacePainter {
 public:
    explicit SurfacePainter(LoadedSurface loaded) noexcept : loaded_(std::move(loaded)) {}

    /// Uploads the matrices of a dancer. `world`: of the avatar's joints.
    void set_joints(std::size_t dancer, std::span<const glm::mat4> world);

    /// The face of what is drawn until the next call: moves vertices, colours and textures where
    /// they differ from the last one's.
    void set_face(const FaceState& face);

    /// Draws a layer. `mirror`: 1, or -1 for the image in the floor; the caller then reverses the
    /// front face's winding. `seconds`: of stream time, for moving textures.
    struct Drawn {
        SurfaceLayer layer = SurfaceLayer::solid;
        float mirror = 1.0F;
        double seconds = 0.0;
        bool has_costume = true;  ///< parts of costumes are drawn, too
    };
    void draw(std::size_t dancer, const Drawn& drawn) const noexcept;

    /// Lets the driver finish one program of one part, which it does when they are first used:
    /// draws a triangle of it as dancer 0, to be drawn over. False: there is no such step.
    [[nodiscard]] bool warm_up(std::size_t step) const noexcept;

    /// Depth alone, for the shadow map.
    void draw_depth(std::size_t dancer,
                    const glm::mat4& clip_from_light,
                    bool has_costume) const noexcept;

 private:
    void set_morphs(std::span<const float> weights);
    void set_materials(std::span<const MaterialFace> faces);
    void bind(std::size_t dancer, const LoadedPart& part) const noexcept;
    /// Which of a part's triangles, and how.
    struct Stroke {
        std::uint32_t indices;
        float mirror;
        float seconds;
    };
    void draw_colour(const LoadedPart& part, const Stroke& stroke) const noexcept;
    void draw_outline(const LoadedPart& part, const Stroke& stroke) const noexcept;
    void draw_with(const gl::Program& program,
                   const LoadedPart& part,
                   const Stroke& stroke) const noexcept;

    LoadedSurface loaded_;
    std::vector<std::vector<gl::Buffer>> skins_;  // matrices by dancer and skin
    std::vector<float> weights_;                  // of FaceState::morphs
};

}  // namespace raks::render
