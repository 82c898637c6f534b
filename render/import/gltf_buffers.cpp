#include "render/import/gltf_buffers.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>

#include "render/import/model_warnings.hpp"

namespace raks::render {
namespace {

constexpr std::int64_t kLongestBuffer = std::int64_t{1} << 30U;  // bytes
constexpr std::size_t kMostBuffers = 10'000;
constexpr std::size_t kMostViews = 500'000;

constexpr std::size_t kModes = 3;
constexpr std::size_t kFilters = 4;

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
                    fmt::format("is {} bytes long, but the file holds {}", buffer.length, size));
            } else if (size > buffer.length + 3) {
                warn(model_, field.line("is shorter than the bytes in the file"));
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
    UnpackRequest& how = packed.how;
    how.row_bytes = static_cast<std::uint32_t>(field["byteStride"].whole(2, 256));
    how.rows = static_cast<std::uint64_t>(field["count"].whole(1, kLongestBuffer));
    const std::size_t mode =
        field["mode"].choice_or(kModes, {"ATTRIBUTES", "TRIANGLES", "INDICES"});
    const std::size_t filter =
        field["filter"].choice_or(0, {"NONE", "OCTAHEDRAL", "QUATERNION", "EXPONENTIAL"});
    constexpr std::array<PackedKind, kModes> kKinds = {
        PackedKind::vertices, PackedKind::triangles, PackedKind::indices};
    how.kind = mode < kModes ? kKinds[mode] : PackedKind::vertices;
    how.filter = static_cast<PackedFilter>(filter);
    check_range(field, packed.buffer, packed.offset, packed.length);
    packed.is_good = mode < kModes && filter < kFilters && can_be_unpacked(how);
    if (!packed.is_good) {
        field.complain("its mode, filter, byteStride and count do not fit together");
    } else if (how.row_bytes * how.rows != view.length) {
        field.complain(fmt::format("unpacks to {} x {} bytes, but is {} bytes long",
                                   how.rows,
                                   how.row_bytes,
                                   view.length));
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
        buffer.field.complain(fmt::format(
            "says that it has {} bytes, but has {}", buffer.length, buffer.bytes.size()));
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
    if (!packed.is_good) {
        return {};  // noted when the view was read
    }
    if (!budget_.claim(packed.how.rows, packed.how.row_bytes)) {
        user.complain("is too large when it is unpacked");
        return {};
    }
    std::vector<std::byte> out(static_cast<std::size_t>(packed.how.rows * packed.how.row_bytes));
    const auto done = unpacker_.unpack(packed.how, all.subspan(packed.offset, packed.length), out);
    if (!done) {
        user.complain(done.error().message);
        return {};
    }
    if (unpacker_.is_uncaged()) {
        warn(model_, kUncagedWarning);
    }
    packed.unpacked = std::move(out);
    return packed.unpacked;
}

}  // namespace raks::render
