#include "render/gl/texture.hpp"

#include <vector>

#include "render/gl/mipmaps.hpp"

namespace raks::render::gl {
namespace {

GLint minifying(const TextureSampling& sampling) noexcept {
    if (!sampling.has_mipmaps) {
        return sampling.is_smooth ? GL_LINEAR : GL_NEAREST;
    }
    // One copy, the nearest in size: between two copies costs twice as much in software.
    return sampling.is_smooth ? GL_LINEAR_MIPMAP_NEAREST : GL_NEAREST_MIPMAP_NEAREST;
}

// Room for all levels at once, and never again: drivers that guess make it several times over.
// OpenGL 3.3 has it as an extension.
bool make_room(GLsizei levels, GLenum form, int width, int height) noexcept {
    if (epoxy_gl_version() < 42 && !epoxy_has_gl_extension("GL_ARB_texture_storage")) {
        return false;
    }
    glTexStorage2D(GL_TEXTURE_2D, levels, form, width, height);
    return true;
}

void put_level(bool has_room,
               GLint level,
               GLenum form,
               int width,
               int height,
               std::span<const std::uint8_t> rgba) noexcept {
    if (has_room) {
        glTexSubImage2D(
            GL_TEXTURE_2D, level, 0, 0, width, height, GL_RGBA, GL_UNSIGNED_BYTE, rgba.data());
        return;
    }
    glTexImage2D(GL_TEXTURE_2D,
                 level,
                 static_cast<GLint>(form),
                 width,
                 height,
                 0,
                 GL_RGBA,
                 GL_UNSIGNED_BYTE,
                 rgba.data());
}

}  // namespace

Texture2d::Texture2d(int width,
                     int height,
                     std::span<const std::uint8_t> rgba,
                     const TextureSampling& sampling) {
    glBindTexture(GL_TEXTURE_2D, texture_.name());
    glPixelStorei(GL_UNPACK_ALIGNMENT, 4);
    glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_WRAP_S, sampling.wrap_u);
    glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_WRAP_T, sampling.wrap_v);
    glTexParameteri(
        GL_TEXTURE_2D, GL_TEXTURE_MAG_FILTER, sampling.is_smooth ? GL_LINEAR : GL_NEAREST);
    glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MIN_FILTER, minifying(sampling));
    const GLenum form = sampling.is_srgb ? GL_SRGB8_ALPHA8 : GL_RGBA8;
    const MipColours colours = sampling.is_srgb ? MipColours::linear : MipColours::as_they_are;
    const auto smaller =
        sampling.has_mipmaps ? mipmaps(width, height, rgba, colours) : std::vector<MipLevel>();
    const bool has_room = make_room(static_cast<GLsizei>(smaller.size() + 1), form, width, height);
    put_level(has_room, 0, form, width, height, rgba);
    GLint number = 0;
    for (const MipLevel& level : smaller) {
        put_level(has_room, ++number, form, level.width, level.height, level.rgba);
    }
    glBindTexture(GL_TEXTURE_2D, 0);
}

void Texture2d::bind(int unit) const noexcept {
    glActiveTexture(GL_TEXTURE0 + static_cast<GLenum>(unit));
    glBindTexture(GL_TEXTURE_2D, texture_.name());
}

}  // namespace raks::render::gl
