// Binary glTF 2.0 as it is being written: what every writer of it shares.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "base/expected.hpp"

#include <nlohmann/json.hpp>

namespace raks {

/// What the numbers of an accessor are, value after value.
enum class GlbType : std::uint8_t { scalar, vec2, vec3, vec4, mat4 };

/// How many numbers a value of a type has.
[[nodiscard]] std::size_t glb_width(GlbType type) noexcept;

/// What an accessor of vertices is for.
enum class GlbUse : std::uint8_t { values, vertices, indices };

/// The JSON of a file and its one buffer, which grow together. The same calls give the same bytes.
/// Threads: one. Real-time: no.
class GlbDocument {
 public:
    using Json = nlohmann::ordered_json;

    /// A document with an asset and nothing else.
    GlbDocument();
    /// One that goes on from a document, with the bytes of its only buffer.
    GlbDocument(Json json, std::string binary)
        : json_(std::move(json)), binary_(std::move(binary)) {}

    /// The document, to which writers add their nodes, meshes and so on. Accessors, bufferViews and
    /// buffers are this class's own.
    [[nodiscard]] Json& json() noexcept { return json_; }

    /// Names an extension in extensionsUsed, once.
    void use_extension(std::string_view name);

    /// Appends an accessor with a view of its own; says its index. The size is a multiple of the
    /// type's width. `has_bounds`: min and max are stated, as positions and times need.
    std::size_t add_floats(std::span<const float> values,
                           GlbType type,
                           GlbUse use = GlbUse::values,
                           bool has_bounds = false);
    /// Corners of triangles, in 16 bits where `vertices`, how many there are, allows it.
    std::size_t add_indices(std::span<const std::uint32_t> indices, std::size_t vertices);
    /// Joints of vertices, four each.
    std::size_t add_joints(std::span<const std::array<std::uint16_t, 4>> joints);
    /// Vectors of which all are zero but those at `places` (ascending, without repeats), as a
    /// sparse accessor of `count` values.
    std::size_t add_sparse_vec3(std::size_t count,
                                std::span<const std::uint32_t> places,
                                std::span<const float> values,
                                bool has_bounds);
    /// Appends bytes as a view of their own, such as an image; says its index.
    std::size_t add_view(std::span<const std::byte> bytes);

    /// The bytes of the buffer so far.
    [[nodiscard]] std::string_view binary() const noexcept { return binary_; }

    /// The container around both. Errors: more than 4 GiB.
    [[nodiscard]] Expected<std::string> bytes();

 private:
    std::size_t append_view(const void* bytes, std::size_t size, GlbUse use);
    std::size_t add_accessor(std::optional<std::size_t> view,
                             int component,
                             std::size_t count,
                             GlbType type);
    void set_bounds(std::size_t accessor, std::span<const float> values, std::size_t width);

    Json json_;
    std::string binary_;
};

}  // namespace raks
