#pragma once

#include "base/expected.hpp"
#include "render/gl/mesh.hpp"
#include "render/gl/shader_program.hpp"
#include "render/renderer.hpp"

namespace raks::render {

/// Floor, beat rings and backdrop. Sets no state but program and vertex array; the frame's uniform
/// block must be bound. Threads: the context's.
class StagePainter {
 public:
    /// `quality` is fast or high. Errors: a shader that the driver refuses.
    [[nodiscard]] static Expected<StagePainter> create(Quality quality);

    /// The floor disc with its shadows; with Quality::high with rings and reflection.
    void draw_floor(const TileFloor& tiles) const noexcept;
    /// The rings as geometry; with Quality::high they are part of the floor and this does nothing.
    void draw_rings(int count) const noexcept;
    /// Fills what is still empty, at the far end of the depth range.
    void draw_backdrop() const noexcept;
    /// Beams and haze, added to what is there. Last: they hide nothing.
    void draw_beams(const LightBeams& beams) const noexcept;

 private:
    struct Programs {
        gl::Program floor;
        gl::Program tiled_floor;
        gl::Program rings;
        gl::Program backdrop;
        gl::Program beams;
    };
    StagePainter(Quality quality, Programs programs);

    Quality quality_;
    gl::Mesh floor_;
    gl::Mesh ring_;
    gl::Mesh backdrop_;
    gl::Mesh beam_;
    Programs programs_;
};

}  // namespace raks::render
