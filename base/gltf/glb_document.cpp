#include "base/gltf/glb_document.hpp"

#include <algorithm>
#include <bit>
#include <limits>

namespace raks {
namespace {

static_assert(std::endian::native == std::endian::little, "glTF's numbers are little-endian");

// Component types of accessors.
constexpr int kShort = 5123;
constexpr int kWord = 5125;
constexpr int kFloat = 5126;

// What a view is bound to.
constexpr int kArrayBuffer = 34962;
constexpr int kElementArrayBuffer = 34963;

constexpr std::size_t kAlignment = 4;
constexpr std::size_t kShortestRestart = 0xFFFF;  // the index that glTF keeps for itself

const char* name_of(GlbType type) {
    constexpr std::array kNames = {"SCALAR", "VEC2", "VEC3", "VEC4", "MAT4"};
    return kNames[static_cast<std::size_t>(type)];
}

void add_number(std::size_t number, std::string& file) {
    const auto word = static_cast<std::uint32_t>(number);
    file.append(reinterpret_cast<const char*>(&word), sizeof(word));
}

}  // namespace

std::size_t glb_width(GlbType type) noexcept {
    constexpr std::array<std::size_t, 5> kWidths = {1, 2, 3, 4, 16};
    return kWidths[static_cast<std::size_t>(type)];
}

GlbDocument::GlbDocument() { json_["asset"] = {{"version", "2.0"}, {"generator", "Raks"}}; }

void GlbDocument::use_extension(std::string_view name) {
    Json& used = json_["extensionsUsed"];
    if (std::find(used.begin(), used.end(), name) == used.end()) {
        used.push_back(name);
    }
}

std::size_t GlbDocument::append_view(const void* bytes, std::size_t size, GlbUse use) {
    binary_.resize((binary_.size() + kAlignment - 1) / kAlignment * kAlignment, '\0');
    Json view = {{"buffer", 0}, {"byteOffset", binary_.size()}, {"byteLength", size}};
    if (use != GlbUse::values) {
        view["target"] = use == GlbUse::indices ? kElementArrayBuffer : kArrayBuffer;
    }
    binary_.append(static_cast<const char*>(bytes), size);
    Json& views = json_["bufferViews"];
    views.push_back(std::move(view));
    return views.size() - 1;
}

std::size_t GlbDocument::add_view(std::span<const std::byte> bytes) {
    return append_view(bytes.data(), bytes.size(), GlbUse::values);
}

std::size_t GlbDocument::add_accessor(std::optional<std::size_t> view,
                                      int component,
                                      std::size_t count,
                                      GlbType type) {
    Json accessor = Json::object();
    if (view) {
        accessor["bufferView"] = *view;
    }
    accessor["componentType"] = component;
    accessor["count"] = count;
    accessor["type"] = name_of(type);
    Json& accessors = json_["accessors"];
    accessors.push_back(std::move(accessor));
    return accessors.size() - 1;
}

void GlbDocument::set_bounds(std::size_t accessor,
                             std::span<const float> values,
                             std::size_t width) {
    if (values.size() < width) {
        return;
    }
    std::vector<float> low(values.begin(), values.begin() + static_cast<std::ptrdiff_t>(width));
    std::vector<float> high = low;
    for (std::size_t i = 0; i < values.size(); ++i) {
        low[i % width] = std::min(low[i % width], values[i]);
        high[i % width] = std::max(high[i % width], values[i]);
    }
    json_["accessors"][accessor]["min"] = low;
    json_["accessors"][accessor]["max"] = high;
}

std::size_t GlbDocument::add_floats(std::span<const float> values,
                                    GlbType type,
                                    GlbUse use,
                                    bool has_bounds) {
    const std::size_t view = append_view(values.data(), values.size_bytes(), use);
    const std::size_t accessor = add_accessor(view, kFloat, values.size() / glb_width(type), type);
    if (has_bounds) {
        set_bounds(accessor, values, glb_width(type));
    }
    return accessor;
}

std::size_t GlbDocument::add_indices(std::span<const std::uint32_t> indices, std::size_t vertices) {
    if (vertices > kShortestRestart) {
        const std::size_t view = append_view(indices.data(), indices.size_bytes(), GlbUse::indices);
        return add_accessor(view, kWord, indices.size(), GlbType::scalar);
    }
    std::vector<std::uint16_t> narrow;
    narrow.reserve(indices.size());
    for (const std::uint32_t index : indices) {
        narrow.push_back(static_cast<std::uint16_t>(index));
    }
    const std::size_t view =
        append_view(narrow.data(), narrow.size() * sizeof(narrow[0]), GlbUse::indices);
    return add_accessor(view, kShort, narrow.size(), GlbType::scalar);
}

std::size_t GlbDocument::add_joints(std::span<const std::array<std::uint16_t, 4>> joints) {
    const std::size_t view = append_view(joints.data(), joints.size_bytes(), GlbUse::vertices);
    return add_accessor(view, kShort, joints.size(), GlbType::vec4);
}

std::size_t GlbDocument::add_sparse_vec3(std::size_t count,
                                         std::span<const std::uint32_t> places,
                                         std::span<const float> values,
                                         bool has_bounds) {
    constexpr std::array<float, 3> kZero{};
    if (places.empty() && count > 0) {
        // One zero that is stated: assimp refuses a file with an accessor that has neither a view
        // nor sparse values.
        return add_sparse_vec3(count, std::array<std::uint32_t, 1>{0}, kZero, has_bounds);
    }
    const std::size_t accessor = add_accessor(std::nullopt, kFloat, count, GlbType::vec3);
    std::vector<float> all(values.begin(), values.end());
    if (places.size() < count) {
        all.insert(all.end(), kZero.begin(), kZero.end());
    }
    if (has_bounds) {
        set_bounds(accessor, all, 3);
    }
    if (!places.empty()) {
        const std::size_t where = append_view(places.data(), places.size_bytes(), GlbUse::values);
        const std::size_t what = append_view(values.data(), values.size_bytes(), GlbUse::values);
        json_["accessors"][accessor]["sparse"] = {
            {"count", places.size()},
            {"indices", {{"bufferView", where}, {"componentType", kWord}}},
            {"values", {{"bufferView", what}}}};
    }
    return accessor;
}

Expected<std::string> GlbDocument::bytes() {
    if (!binary_.empty()) {
        binary_.resize((binary_.size() + kAlignment - 1) / kAlignment * kAlignment, '\0');
        json_["buffers"] = {{{"byteLength", binary_.size()}}};
    }
    std::string text = json_.dump(-1, ' ', false, Json::error_handler_t::replace);
    text.resize((text.size() + kAlignment - 1) / kAlignment * kAlignment, ' ');
    constexpr std::size_t kHead = 12;
    constexpr std::size_t kChunkHead = 8;
    const std::size_t binary_chunk = binary_.empty() ? 0 : kChunkHead + binary_.size();
    const std::size_t size = kHead + kChunkHead + text.size() + binary_chunk;
    if (size > std::numeric_limits<std::uint32_t>::max()) {
        return fail("too large for a binary glTF: more than 4 GiB");
    }
    std::string file = "glTF";
    file.reserve(size);
    add_number(2, file);
    add_number(size, file);
    add_number(text.size(), file);
    file += "JSON";
    file += text;
    if (binary_chunk > 0) {
        add_number(binary_.size(), file);
        file += std::string_view("BIN\0", 4);
        file += binary_;
    }
    return file;
}

}  // namespace raks
