#pragma once

#include <cstddef>
#include <cstdint>
#include <span>

#include "render/gl/objects.hpp"

namespace raks::render::gl {

/// How the shader reads a vertex attribute: `raw` integers, integers scaled to [0, 1] or [-1, 1],
/// or floats as they are.
enum class Reading { raw, normalized };

/// One input of the vertex shader, as glVertexAttribPointer takes it.
struct Attribute {
    /// As in the shader's layout(location).
    GLuint location = 0;
    /// 1 to 4.
    GLint components = 1;
    /// Of one component in the vertex record.
    GLenum type = GL_FLOAT;
    /// Floats are read as they are.
    Reading reading = Reading::normalized;
    std::size_t offset = 0;  ///< bytes from the vertex's start
};

/// Vertices and triangles in the driver's memory. Threads: the context's.
class Mesh {
 public:
    /// `vertices`: records of `stride` bytes; `indices`: three a triangle.
    Mesh(std::span<const std::byte> vertices,
         std::size_t stride,
         std::span<const Attribute> attributes,
         std::span<const std::uint16_t> indices);
    /// The same for meshes of 65,536 vertices and more.
    Mesh(std::span<const std::byte> vertices,
         std::size_t stride,
         std::span<const Attribute> attributes,
         std::span<const std::uint32_t> indices);
    /// Room for a mesh of 32-bit indices that is put in piece by piece.
    Mesh(std::size_t vertex_bytes,
         std::size_t stride,
         std::span<const Attribute> attributes,
         std::size_t index_count);

    /// Draws all triangles with the program in use.
    void draw() const noexcept;
    /// Draws the triangles of `count` indices from `first` on.
    void draw_range(std::uint32_t first, std::uint32_t count) const noexcept;
    /// Puts other bytes in place of those from `offset` on.
    void replace_vertices(std::size_t offset, std::span<const std::byte> bytes) noexcept;
    /// The same for indices; `offset` in bytes.
    void replace_indices(std::size_t offset, std::span<const std::byte> bytes) noexcept;
    /// Draws them `count` times; the shader tells the instances apart by gl_InstanceID.
    void draw_instances(int count) const noexcept;

 private:
    VertexArray array_;
    Buffer vertices_;
    Buffer indices_;
    GLsizei index_count_;
    GLenum index_type_;

    /// Null: room alone.
    struct Bytes {
        const std::byte* data;
        std::size_t size;
    };
    void upload(Bytes vertices,
                std::size_t stride,
                std::span<const Attribute> attributes,
                Bytes indices) noexcept;
};

}  // namespace raks::render::gl
