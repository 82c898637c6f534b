#include "render/gl/texture.hpp"

namespace raks::render::gl {
namespace {

GLint minifying(const TextureSampling& sampling) noexcept {
    if (!sampling.has_mipmaps) {
        return sampling.is_smooth ? GL_LINEAR : GL_NEAREST;
    }
    // One copy, the nearest in size: between two copies costs twice as much in software.
    return sampling.is_smooth ? GL_LINEAR_MIPMAP_NEAREST : GL_NEAREST_MIPMAP_NEAREST;
}

}  // namespace

Texture2d::Texture2d(int width, int height, const TextureSampling& sampling)
    : width_(width), has_mipmaps_(sampling.has_mipmaps) {
    glBindTexture(GL_TEXTURE_2D, texture_.name());
    glTexImage2D(GL_TEXTURE_2D,
                 0,
                 sampling.is_srgb ? GL_SRGB8_ALPHA8 : GL_RGBA8,
                 width,
                 height,
                 0,
                 GL_RGBA,
                 GL_UNSIGNED_BYTE,
                 nullptr);
    glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_WRAP_S, sampling.wrap_u);
    glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_WRAP_T, sampling.wrap_v);
    glTexParameteri(
        GL_TEXTURE_2D, GL_TEXTURE_MAG_FILTER, sampling.is_smooth ? GL_LINEAR : GL_NEAREST);
    glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MIN_FILTER, minifying(sampling));
    glBindTexture(GL_TEXTURE_2D, 0);
}

void Texture2d::put_rows(int first, int count, std::span<const std::uint8_t> rgba) noexcept {
    glBindTexture(GL_TEXTURE_2D, texture_.name());
    glPixelStorei(GL_UNPACK_ALIGNMENT, 4);
    glTexSubImage2D(
        GL_TEXTURE_2D, 0, 0, first, width_, count, GL_RGBA, GL_UNSIGNED_BYTE, rgba.data());
    glBindTexture(GL_TEXTURE_2D, 0);
}

void Texture2d::finish() noexcept {
    if (has_mipmaps_) {
        glBindTexture(GL_TEXTURE_2D, texture_.name());
        glGenerateMipmap(GL_TEXTURE_2D);
        glBindTexture(GL_TEXTURE_2D, 0);
    }
}

void Texture2d::bind(int unit) const noexcept {
    glActiveTexture(GL_TEXTURE0 + static_cast<GLenum>(unit));
    glBindTexture(GL_TEXTURE_2D, texture_.name());
}

}  // namespace raks::render::gl
