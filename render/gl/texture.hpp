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
    /// Room for a picture, which is put in row by row.
    Texture2d(int width, int height, const TextureSampling& sampling);
    /// Puts rows in from row `first` on; rows count from v = 0. `rgba`: width * 4 bytes for each of
    /// `count` rows.
    void put_rows(int first, int count, std::span<const std::uint8_t> rgba) noexcept;
    /// Once all rows are in: makes the smaller copies, where there are to be any. `rgba`: all rows.
    void finish(std::span<const std::uint8_t> rgba);
    /// Binds it to a texture unit.
    void bind(int unit) const noexcept;

 private:
    Texture texture_;
    int width_;
    int height_;
    TextureSampling sampling_;
    bool has_room_ = false;  // for all levels
};

}  // namespace raks::render::gl
