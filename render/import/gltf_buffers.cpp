#include "render/import/gltf_buffers.hpp"

#include <fmt/format.h>
#include <meshoptimizer.h>

#include <algorithm>

#include "render/import/notes.hpp"

namespace raks::render {
namespace {

constexpr std::int64_t kLongestBuffer = std::int64_t{1} << 30U;  // bytes
constexpr std::size_t kMostBuffers = 10'000;
constexpr std::size_t kMostViews = 500'000;

enum PackMode : std::size_t { kPackedVertices, kPackedTriangles, kPackedIndices };
enum PackFilter : std::size_t {
    kNoFilter,
    kOctahedralFilter,
    kQuaternionFilter,
    kExponentialFilter
};

/// Whether meshopt's decoders may be called with it: they assert what they need.
bool can_be_unpacked(std::size_t mode,
                     std::size_t filter,
                     std::size_t stride,
                     std::uint64_t count) {
    if (mode != kPackedVertices) {
        return (stride == 2 || stride == 4) && filter == kNoFilter &&
               (mode != kPackedTriangles || count % 3 == 0);
    }
    if (stride == 0 || stride % 4 != 0 || stride > 256) {
        return false;
    }
    return filter == kNoFilter || filter == kExponentialFilter ||
           (filter == kOctahedralFilter && (stride == 4 || stride == 8)) ||
           (filter == kQuaternionFilter && stride == 8);
}

/// Unpacks into `out`, which has room for it. False: it is not packed so.
bool unpack_into(std::vector<std::byte>& out,
                 std::size_t mode,
                 std::size_t count,
                 std::size_t stride,
                 std::span<const std::byte> packed) {
    const auto* const bytes = reinterpret_cast<const unsigned char*>(packed.data());
    switch (mode) {
        case kPackedVertices:
            return meshopt_decodeVertexBuffer(out.data(), count, stride, bytes, packed.size()) == 0;
        case kPackedTriangles:
            return meshopt_decodeIndexBuffer(out.data(), count, stride, bytes, packed.size()) == 0;
        default:
            return meshopt_decodeIndexSequence(out.data(), count, stride, bytes, packed.size()) ==
                   0;
    }
}

void filter_in_place(std::vector<std::byte>& bytes,
                     std::size_t filter,
                     std::size_t count,
                     std::size_t stride) {
    if (filter == kOctahedralFilter) {
        meshopt_decodeFilterOct(bytes.data(), count, stride);
    } else if (filter == kQuaternionFilter) {
        meshopt_decodeFilterQuat(bytes.data(), count, stride);
    } else if (filter == kExponentialFilter) {
        meshopt_decodeFilterExp(bytes.data(), count, stride);
    }
}

}  // namespace

GltfBuffers::GltfBuffers(const GltfFile& file,
                         const SideFiles& side,
                         const JsonField& root,
                         ImportBudget& budget,
                         Model& model)
    : file_(file), side_(side), budget_(budget), model_(model) {
    read_buffers(root["buffers"]);
    read_views(root["bufferViews"]);
}

std::uint64_t GltfBuffers::offset(int view) const {
    return views_[at(view)].packed ? 0 : views_[at(view)].offset;
}

void GltfBuffers::read_buffers(const JsonField& list) {
    for (const JsonField& field : list.objects(kMostBuffers)) {
        Buffer buffer{.field = field, .length = 0, .is_fetched = false, .own = {}, .bytes = {}};
        buffer.length = static_cast<std::uint64_t>(field["byteLength"].whole(1, kLongestBuffer));
        const bool is_first_of_glb = file_.is_glb && buffers_.empty();
        const JsonField packing = field["extensions"]["EXT_meshopt_compression"];
        buffer.is_fallback = packing["fallback"].truth_or(false);
        if (is_first_of_glb && !field["uri"].exists() && !packing.exists()) {
            const std::size_t size = file_.binary ? file_.binary->size() : 0;
            if (size < buffer.length) {
                field.complain(
                    fmt::format("{} bytes long, but the file holds {}", buffer.length, size));
            } else if (size > buffer.length + 3) {
                warn(model_, field.line("shorter than the bytes in the file"));
            }
        }
        buffers_.push_back(std::move(buffer));
    }
}

void GltfBuffers::check_range(const JsonField& field,
                              int buffer,
                              std::uint64_t offset,
                              std::uint64_t size) {
    if (buffers_.empty()) {
        return;  // the index was a fault
    }
    const std::uint64_t length = buffers_[at(buffer)].length;
    if (offset > length || size > length - offset) {
        field.complain(
            fmt::format("bytes {} to {} of a buffer of {}", offset, offset + size, length));
    }
}

void GltfBuffers::read_views(const JsonField& list) {
    const std::vector<JsonField> fields = list.objects(kMostViews);
    views_.reserve(fields.size());
    for (const JsonField& field : fields) {
        View view;
        view.buffer = field["buffer"].index(buffers_.size());
        view.offset =
            static_cast<std::uint64_t>(field["byteOffset"].whole_or(0, 0, kLongestBuffer));
        view.length = static_cast<std::uint64_t>(field["byteLength"].whole(1, kLongestBuffer));
        view.stride = static_cast<std::size_t>(field["byteStride"].whole_or(0, 0, 252));
        if (field["byteStride"].exists() && (view.stride < 4 || view.stride % 4 != 0)) {
            field["byteStride"].complain(fmt::format("{} is not 4, 8 .. 252", view.stride));
        }
        view.target = field["target"].whole_or(0, 0, 100'000);
        const JsonField packing = field["extensions"]["EXT_meshopt_compression"];
        if (packing.exists()) {
            view.packed = read_packed(packing, view);
        } else {
            check_range(field, view.buffer, view.offset, view.length);
        }
        views_.push_back(std::move(view));
    }
}

GltfBuffers::Packed GltfBuffers::read_packed(const JsonField& field, const View& view) {
    Packed packed;
    packed.buffer = field["buffer"].index(buffers_.size());
    packed.offset = static_cast<std::uint64_t>(field["byteOffset"].whole_or(0, 0, kLongestBuffer));
    packed.length = static_cast<std::uint64_t>(field["byteLength"].whole(1, kLongestBuffer));
    packed.stride = static_cast<std::size_t>(field["byteStride"].whole(2, 256));
    packed.count = static_cast<std::uint64_t>(field["count"].whole(1, kLongestBuffer));
    packed.mode =
        field["mode"].choice_or(kPackedIndices + 1, {"ATTRIBUTES", "TRIANGLES", "INDICES"});
    packed.filter =
        field["filter"].choice_or(kNoFilter, {"NONE", "OCTAHEDRAL", "QUATERNION", "EXPONENTIAL"});
    check_range(field, packed.buffer, packed.offset, packed.length);
    if (packed.mode > kPackedIndices ||
        !can_be_unpacked(packed.mode, packed.filter, packed.stride, packed.count)) {
        field.complain("mode, filter, stride and count do not fit");
    } else if (packed.stride * packed.count != view.length) {
        field.complain(fmt::format(
            "{} x {} bytes for a view of {}", packed.count, packed.stride, view.length));
    }
    return packed;
}

std::span<const std::byte> GltfBuffers::bytes(int view, const JsonField& user) {
    View& here = views_[at(view)];
    if (here.packed) {
        return unpack(*here.packed, user);
    }
    const std::span<const std::byte> all = fetch(here.buffer, user);
    if (here.offset > all.size() || here.length > all.size() - here.offset) {
        return {};  // noted: the buffer could not be fetched, or the range is a fault
    }
    return all.subspan(here.offset, here.length);
}

std::span<const std::byte> GltfBuffers::fetch(int index, const JsonField& user) {
    Buffer& buffer = buffers_[at(index)];
    if (buffer.is_fetched) {
        return buffer.bytes;
    }
    buffer.is_fetched = true;
    if (!buffer.field["uri"].exists()) {
        if (!file_.is_glb || index != 0 || !file_.binary) {
            user.complain(fmt::format("its bytes (buffers[{}]) are not in the file", index));
            return {};
        }
        buffer.bytes = *file_.binary;
    } else {
        buffer.own = fetched(buffer, user);
        buffer.bytes = buffer.own;
    }
    if (buffer.bytes.size() < buffer.length) {
        buffer.field.complain(
            fmt::format("says {} bytes and has {}", buffer.length, buffer.bytes.size()));
        buffer.bytes = {};
    }
    return buffer.bytes;
}

std::vector<std::byte> GltfBuffers::fetched(Buffer& buffer, const JsonField& /*user*/) {
    const std::string_view uri = buffer.field["uri"].text();
    auto bytes =
        is_data_uri(uri) ? read_data_uri(uri, budget_.left()) : side_.read(uri, budget_.left());
    if (!bytes) {
        buffer.field["uri"].complain(bytes.error().message);
        return {};
    }
    if (!budget_.claim(bytes->size(), 1)) {
        buffer.field.complain("too large");
        return {};
    }
    return std::move(*bytes);
}

void GltfBuffers::check_unread() {
    for (std::size_t i = 0; i < buffers_.size(); ++i) {
        const Buffer& buffer = buffers_[i];
        if (!buffer.is_fetched && !buffer.is_fallback && buffer.field["uri"].exists()) {
            (void)fetch(static_cast<int>(i), buffer.field);
        }
    }
}

std::span<const std::byte> GltfBuffers::unpack(Packed& packed, const JsonField& user) {
    if (packed.is_unpacked) {
        return packed.unpacked;
    }
    packed.is_unpacked = true;
    const std::span<const std::byte> all = fetch(packed.buffer, user);
    if (packed.offset > all.size() || packed.length > all.size() - packed.offset) {
        return {};
    }
    if (!can_be_unpacked(packed.mode, packed.filter, packed.stride, packed.count)) {
        return {};  // noted when the view was read
    }
    if (!budget_.claim(packed.count, packed.stride)) {
        user.complain("unpacks to too much");
        return {};
    }
    const auto count = static_cast<std::size_t>(packed.count);
    std::vector<std::byte> out(count * packed.stride);
    if (!unpack_into(
            out, packed.mode, count, packed.stride, all.subspan(packed.offset, packed.length))) {
        user.complain("its meshopt data cannot be unpacked");
        return {};
    }
    filter_in_place(out, packed.filter, count, packed.stride);
    packed.unpacked = std::move(out);
    return packed.unpacked;
}

}  // namespace raks::render
