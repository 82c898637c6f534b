#include "render/gl/mesh.hpp"

namespace raks::render::gl {
namespace {

/// OpenGL takes byte offsets into a buffer as pointers.
const void* buffer_offset(std::size_t bytes) noexcept {
    return reinterpret_cast<const void*>(bytes);  // NOLINT(performance-no-int-to-ptr): GL's form
}

/// Tells the bound vertex array where in the vertex record an attribute lies. Integers need a call
/// of their own: the ordinary one would convert them to floats.
void describe(const Attribute& attribute, GLsizei stride) {
    glEnableVertexAttribArray(attribute.location);
    const void* const offset = buffer_offset(attribute.offset);
    if (attribute.reading == Reading::raw) {
        glVertexAttribIPointer(
            attribute.location, attribute.components, attribute.type, stride, offset);
    } else {
        glVertexAttribPointer(
            attribute.location, attribute.components, attribute.type, GL_TRUE, stride, offset);
    }
}

}  // namespace

Mesh::Mesh(std::span<const std::byte> vertices,
           std::size_t stride,
           std::span<const Attribute> attributes,
           std::span<const std::uint16_t> indices)
    : index_count_(static_cast<GLsizei>(indices.size())), index_type_(GL_UNSIGNED_SHORT) {
    const std::span<const std::byte> packed = std::as_bytes(indices);
    upload({vertices.data(), vertices.size()}, stride, attributes, {packed.data(), packed.size()});
}

Mesh::Mesh(std::span<const std::byte> vertices,
           std::size_t stride,
           std::span<const Attribute> attributes,
           std::span<const std::uint32_t> indices)
    : index_count_(static_cast<GLsizei>(indices.size())), index_type_(GL_UNSIGNED_INT) {
    const std::span<const std::byte> packed = std::as_bytes(indices);
    upload({vertices.data(), vertices.size()}, stride, attributes, {packed.data(), packed.size()});
}

Mesh::Mesh(std::size_t vertex_bytes,
           std::size_t stride,
           std::span<const Attribute> attributes,
           std::size_t index_count)
    : index_count_(static_cast<GLsizei>(index_count)), index_type_(GL_UNSIGNED_INT) {
    upload({nullptr, vertex_bytes},
           stride,
           attributes,
           {nullptr, index_count * sizeof(std::uint32_t)});
}

void Mesh::upload(Bytes vertices,
                  std::size_t stride,
                  std::span<const Attribute> attributes,
                  Bytes indices) noexcept {
    // The vertex array records the attributes and the index buffer bound while it is current.
    glBindVertexArray(array_.name());
    glBindBuffer(GL_ARRAY_BUFFER, vertices_.name());
    glBufferData(
        GL_ARRAY_BUFFER, static_cast<GLsizeiptr>(vertices.size), vertices.data, GL_STATIC_DRAW);
    for (const Attribute& attribute : attributes) {
        describe(attribute, static_cast<GLsizei>(stride));
    }
    glBindBuffer(GL_ELEMENT_ARRAY_BUFFER, indices_.name());
    glBufferData(GL_ELEMENT_ARRAY_BUFFER,
                 static_cast<GLsizeiptr>(indices.size),
                 indices.data,
                 GL_STATIC_DRAW);
    // So that no later buffer binding changes this mesh by mistake.
    glBindVertexArray(0);
}

void Mesh::draw() const noexcept {
    glBindVertexArray(array_.name());
    glDrawElements(GL_TRIANGLES, index_count_, index_type_, nullptr);
}

void Mesh::draw_range(std::uint32_t first, std::uint32_t count) const noexcept {
    const std::size_t size = index_type_ == GL_UNSIGNED_INT ? 4 : 2;
    glBindVertexArray(array_.name());
    glDrawElements(
        GL_TRIANGLES, static_cast<GLsizei>(count), index_type_, buffer_offset(first * size));
}

void Mesh::replace_vertices(std::size_t offset, std::span<const std::byte> bytes) noexcept {
    glBindBuffer(GL_ARRAY_BUFFER, vertices_.name());
    glBufferSubData(GL_ARRAY_BUFFER,
                    static_cast<GLintptr>(offset),
                    static_cast<GLsizeiptr>(bytes.size_bytes()),
                    bytes.data());
}

void Mesh::replace_indices(std::size_t offset, std::span<const std::byte> bytes) noexcept {
    // The vertex array knows its index buffer.
    glBindVertexArray(array_.name());
    glBufferSubData(GL_ELEMENT_ARRAY_BUFFER,
                    static_cast<GLintptr>(offset),
                    static_cast<GLsizeiptr>(bytes.size_bytes()),
                    bytes.data());
    glBindVertexArray(0);
}

void Mesh::draw_instances(int count) const noexcept {
    glBindVertexArray(array_.name());
    glDrawElementsInstanced(GL_TRIANGLES, index_count_, index_type_, nullptr, count);
}

}  // namespace raks::render::gl
