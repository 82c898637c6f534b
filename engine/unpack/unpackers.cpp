#include "engine/unpack/unpackers.hpp"

#include <meshoptimizer.h>

#include "engine/unpack/image_codecs.hpp"
#include "render/import/image_file.hpp"

namespace raks::engine {
namespace {

using render::PackedFilter;
using render::PackedKind;
using render::UnpackRequest;

Expected<void> unpack_picture(const UnpackRequest& what,
                              std::span<const std::byte> packed,
                              std::span<std::byte> out) {
    constexpr std::uint64_t kMost = render::kLargestImageSide;
    if (what.row_bytes % 4 != 0 || what.row_bytes < 4 || what.row_bytes > 4 * kMost ||
        what.rows < 1 || what.rows > kMost) {
        return fail("of an impossible size");
    }
    const PictureRoom room{.width = static_cast<int>(what.row_bytes / 4),
                           .height = static_cast<int>(what.rows),
                           .pixels = out};
    CodecFault fault;
    const bool is_good = what.kind == PackedKind::png    ? unpack_png(packed, room, fault)
                         : what.kind == PackedKind::jpeg ? unpack_jpeg(packed, room, fault)
                                                         : unpack_webp(packed, room, fault);
    return is_good ? Expected<void>() : fail(fault.text.data());
}

/// False: it is not packed so.
bool unpack_mesh(const UnpackRequest& what,
                 std::span<const std::byte> packed,
                 std::span<std::byte> out) {
    const auto* const bytes = reinterpret_cast<const unsigned char*>(packed.data());
    const auto count = static_cast<std::size_t>(what.rows);
    const std::size_t stride = what.row_bytes;
    switch (what.kind) {
        case PackedKind::vertices:
            return meshopt_decodeVertexBuffer(out.data(), count, stride, bytes, packed.size()) == 0;
        case PackedKind::triangles:
            return meshopt_decodeIndexBuffer(out.data(), count, stride, bytes, packed.size()) == 0;
        default:
            return meshopt_decodeIndexSequence(out.data(), count, stride, bytes, packed.size()) ==
                   0;
    }
}

void filter_in_place(const UnpackRequest& what, std::span<std::byte> bytes) {
    const auto count = static_cast<std::size_t>(what.rows);
    const std::size_t stride = what.row_bytes;
    if (what.filter == PackedFilter::octahedral) {
        meshopt_decodeFilterOct(bytes.data(), count, stride);
    } else if (what.filter == PackedFilter::quaternion) {
        meshopt_decodeFilterQuat(bytes.data(), count, stride);
    } else if (what.filter == PackedFilter::exponential) {
        meshopt_decodeFilterExp(bytes.data(), count, stride);
    }
}

}  // namespace

Expected<void> unpack(const UnpackRequest& what,
                      std::span<const std::byte> packed,
                      std::span<std::byte> out) {
    if (what.kind <= PackedKind::webp) {
        return unpack_picture(what, packed, out);
    }
    if (!render::can_be_unpacked(what)) {
        return fail("mode, filter, stride and count do not fit");
    }
    if (!unpack_mesh(what, packed, out)) {
        return fail("its meshopt data cannot be unpacked");
    }
    filter_in_place(what, out);
    return {};
}

}  // namespace raks::engine
