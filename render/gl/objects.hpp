#pragma once

#include <epoxy/gl.h>
#include <utility>

/// Owners of OpenGL names: made in the current context, freed by the destructor (with that context
/// current). Threads: the context's. Real-time: no.
namespace raks::render::gl {

/// How the names of a buffer object are made and freed; likewise for the kinds below.
struct BufferKind {
    static void make(GLuint& name) { glGenBuffers(1, &name); }    ///< one name
    static void free(GLuint name) { glDeleteBuffers(1, &name); }  ///< and what it holds
};
/// A vertex array: which buffers feed which attributes.
struct VertexArrayKind {
    static void make(GLuint& name) { glGenVertexArrays(1, &name); }
    static void free(GLuint name) { glDeleteVertexArrays(1, &name); }
};
/// A texture.
struct TextureKind {
    static void make(GLuint& name) { glGenTextures(1, &name); }
    static void free(GLuint name) { glDeleteTextures(1, &name); }
};
/// A framebuffer: what is drawn into.
struct FramebufferKind {
    static void make(GLuint& name) { glGenFramebuffers(1, &name); }
    static void free(GLuint name) { glDeleteFramebuffers(1, &name); }
};
/// A renderbuffer: storage of a framebuffer that no shader reads.
struct RenderbufferKind {
    static void make(GLuint& name) { glGenRenderbuffers(1, &name); }
    static void free(GLuint name) { glDeleteRenderbuffers(1, &name); }
};

/// Owns one OpenGL name of that kind. Move only.
template <typename Kind>
class Object {
 public:
    /// Makes a name in the current context.
    Object() { Kind::make(name_); }
    /// Leaves `other` without a name.
    Object(Object&& other) noexcept : name_(std::exchange(other.name_, 0U)) {}
    /// Exchanges the names; `other` frees what this one held.
    Object& operator=(Object&& other) noexcept {
        std::swap(name_, other.name_);
        return *this;
    }
    /// Frees the name, if it still has one.
    ~Object() {
        if (name_ != 0U) {
            Kind::free(name_);
        }
    }
    /// For OpenGL's calls; 0 after it was moved from.
    [[nodiscard]] GLuint name() const noexcept { return name_; }

 private:
    GLuint name_ = 0U;
};

using Buffer = Object<BufferKind>;
using VertexArray = Object<VertexArrayKind>;
using Texture = Object<TextureKind>;
using Framebuffer = Object<FramebufferKind>;
using Renderbuffer = Object<RenderbufferKind>;

}  // namespace raks::render::gl
