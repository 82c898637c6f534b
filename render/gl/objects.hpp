#pragma once

#include <epoxy/gl.h>
#include <utility>

/// Owners of OpenGL names: made in the current context, freed by the destructor (with that context
/// current). Threads: the context's. Real-time: no.
namespace raks::render::gl {

struct BufferKind {
    static void make(GLuint& name) { glGenBuffers(1, &name); }
    static void free(GLuint name) { glDeleteBuffers(1, &name); }
};
struct VertexArrayKind {
    static void make(GLuint& name) { glGenVertexArrays(1, &name); }
    static void free(GLuint name) { glDeleteVertexArrays(1, &name); }
};
struct TextureKind {
    static void make(GLuint& name) { glGenTextures(1, &name); }
    static void free(GLuint name) { glDeleteTextures(1, &name); }
};
struct FramebufferKind {
    static void make(GLuint& name) { glGenFramebuffers(1, &name); }
    static void free(GLuint name) { glDeleteFramebuffers(1, &name); }
};
struct RenderbufferKind {
    static void make(GLuint& name) { glGenRenderbuffers(1, &name); }
    static void free(GLuint name) { glDeleteRenderbuffers(1, &name); }
};

template <typename Kind>
class Object {
 public:
    Object() { Kind::make(name_); }
    Object(Object&& other) noexcept : name_(std::exchange(other.name_, 0U)) {}
    Object& operator=(Object&& other) noexcept {
        std::swap(name_, other.name_);
        return *this;
    }
    ~Object() {
        if (name_ != 0U) {
            Kind::free(name_);
        }
    }
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
