#pragma once

#include <cstddef>
#include <cstdint>
#include <span>

#include "render/gl/objects.hpp"

namespace raks::render::gl {

/// How the shader reads a vertex attribute: `raw` integers, integers scaled to [0, 1] or [-1, 1],
/// or floats as they are.
enum class Reading { raw, normalized };

struct Attribute {
    GLuint location = 0;
    GLint components = 1;
    GLenum type = GL_FLOAT;
    Reading reading = Reading::normalized;
    std::size_t offset = 0;  ///< bytes from the vertex's start
};

/// Vertices and triangles in the driver's memory, never changed. Threads: the context's.
class Mesh {
 public:
    /// `vertices`: records of `stride` bytes; `indices`: three a triangle.
    Mesh(std::span<const std::byte> vertices,
         std::size_t stride,
         std::span<const Attribute> attributes,
         std::span<const std::uint16_t> indices);

    void draw() const noexcept;
    void draw_instances(int count) const noexcept;

 private:
    VertexArray array_;
    Buffer vertices_;
    Buffer indices_;
    GLsizei index_count_;
};

}  // namespace raks::render::gl
