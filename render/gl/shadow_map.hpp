#pragma once

#include "base/expected.hpp"
#include "render/gl/objects.hpp"

namespace raks::render::gl {

/// A square depth texture to draw into from the light, and to compare with in shaders through a
/// sampler2DShadow (bilinear). Threads: the context's.
class ShadowMap {
 public:
    /// Errors: the driver refuses the size.
    [[nodiscard]] static Expected<ShadowMap> create(GLsizei side);

    /// Makes it the target and clears it; sets a slope-scaled depth offset, which `end` takes back.
    void begin() const noexcept;
    /// Ends drawing and binds the texture to the shadow unit.
    void end() const noexcept;

 private:
    explicit ShadowMap(GLsizei side) noexcept : side_(side) {}
    Texture texture_;
    Framebuffer framebuffer_;
    GLsizei side_;
};

}  // namespace raks::render::gl
