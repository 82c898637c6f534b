// What raks and the program raks-unpack say to one another, over a stream socket. Both are of the
// same build; neither trusts what the other says.
#pragma once

#include <cstdint>

namespace raks::render {

/// The descriptor of raks-unpack: its end of the socket.
inline constexpr int kUnpackSocket = 3;

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

/// What raks asks; the packed bytes follow it. What is unpacked has `rows` times `row_bytes` bytes:
/// lines of a picture, or vertices or indices.
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

/// The answer; the unpacked bytes follow it or, of what is broken, the words of `words` bytes.
struct UnpackAnswer {
    std::uint32_t magic = 0x52550002;  ///< other builds have another one
    std::uint32_t is_good = 0;         ///< 0 or 1
    std::uint32_t is_caged = 0;        ///< 0 or 1: by seccomp
    std::uint32_t words = 0;           ///< at most kMostUnpackWords
};

inline constexpr std::uint32_t kMostUnpackWords = 400;

}  // namespace raks::render
