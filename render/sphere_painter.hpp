#pragma once

#include <span>

#include "base/expected.hpp"
#include "render/gl/mesh.hpp"
#include "render/gl/shader_program.hpp"
#include "render/scene/scene.hpp"

namespace raks::render {

/// Lit spheres, such as the markers on a dancer who is filmed. Sets no state but program and vertex
/// array; the frame's uniform block must be bound. Threads: the context's.
class SpherePainter {
 public:
    /// Errors: a shader that the driver refuses.
    [[nodiscard]] static Expected<SpherePainter> create();
    /// Draws them.
    void draw(std::span<const LitSphere> spheres) const noexcept;

 private:
    explicit SpherePainter(gl::Program program);

    gl::Program program_;
    gl::Mesh sphere_;
};

}  // namespace raks::render
