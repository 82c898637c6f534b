// What raks and the program raks-unpack say to one another, over a stream socket. Both are of the
// same build; neither trusts what the other says.
#pragma once

#include <cstdint>

namespace raks::render {

/// What is packed.
enum class PackedKind : std::uint32_t {
    png,        ///< to red, green, blue and opacity, each a byte
    jpeg,       ///< likewise
    webp,       ///< likewise
    vertices,   ///< by meshopt, ATTRIBUTES
    triangles,  ///< by meshopt, TRIANGLES
    indices,    ///< by meshopt, INDICES
};

/// How meshopt's vertices are to be changed once they are unpacked.
enum class PackedFilter : std::uint32_t { none, octahedral, quaternion, exponential };

/// What raks asks; the packed bytes follow it. The answer (base/talk_answer.hpp) is what is
/// unpacked, `rows` times `row_bytes` bytes: lines of a picture, or vertices or indices.
struct UnpackRequest {
    std::uint32_t magic = 0x52550001;  ///< other builds have another one
    PackedKind kind = PackedKind::png;
    PackedFilter filter = PackedFilter::none;
    std::uint32_t row_bytes = 0;  ///< of pictures four times their width
    std::uint64_t rows = 0;
    std::uint64_t packed_bytes = 0;
};

/// Whether meshopt may be called with such a mesh: it asserts what it needs.
[[nodiscard]] constexpr bool can_be_unpacked(const UnpackRequest& mesh) noexcept {
    const std::uint32_t stride = mesh.row_bytes;
    if (mesh.kind != PackedKind::vertices) {
        return (stride == 2 || stride == 4) && mesh.filter == PackedFilter::none &&
               (mesh.kind != PackedKind::triangles || mesh.rows % 3 == 0);
    }
    if (stride == 0 || stride % 4 != 0 || stride > 256) {
        return false;
    }
    return mesh.filter == PackedFilter::none || mesh.filter == PackedFilter::exponential ||
           (mesh.filter == PackedFilter::octahedral && (stride == 4 || stride == 8)) ||
           (mesh.filter == PackedFilter::quaternion && stride == 8);
}

}  // namespace raks::render
