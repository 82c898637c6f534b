#pragma once

#include <cstdint>
#include <span>

#include "render/gl/objects.hpp"

namespace raks::render::gl {

/// How a picture is sampled.
struct TextureSampling {
    bool is_srgb = false;  ///< the sampler turns shown colours into linear ones
    GLint wrap_u = GL_REPEAT;
    GLint wrap_v = GL_REPEAT;
    bool is_smooth = true;    ///< linear between texels
    bool has_mipmaps = true;  ///< smaller copies for what is far away
};

/// A picture in the driver's memory. Threads: the context's.
class Texture2d {
 public:
    /// `rgba`: width * height * 4 bytes, rows from v = 0 on.
    Texture2d(int width,
              int height,
              std::span<const std::uint8_t> rgba,
              const TextureSampling& sampling);
    /// Binds it to a texture unit.
    void bind(int unit) const noexcept;

 private:
    Texture texture_;
};

}  // namespace raks::render::gl
