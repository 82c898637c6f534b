#include "engine/import/draco_unpacker.hpp"

#include <cstdint>
#include <cstring>
#include <memory>
#include <span>
#include <string_view>
#include <utility>
#include <vector>

#include "base/gltf/glb_document.hpp"

#include <draco/compression/decode.h>
#include <fmt/format.h>

namespace raks::engine {
namespace {

using Json = GlbDocument::Json;

constexpr const char* kDraco = "KHR_draco_mesh_compression";
constexpr std::size_t kMostBytes = std::size_t{512} << 20U;  // of all buffers

// Component types of accessors.
enum Component : int { kByte = 5120, kOctet = 5121, kShort = 5122, kWord = 5123, kLong = 5125 };

/// A file taken apart.
struct Document {
    Json json;
    std::string_view binary;
};

Expected<Document> take_apart(std::string_view bytes) {
    constexpr std::size_t kHead = 12;
    constexpr std::size_t kChunkHead = 8;
    std::string_view text = bytes;
    std::string_view binary;
    if (bytes.substr(0, 4) == "glTF") {
        const auto word = [&](std::size_t at) {
            std::uint32_t value = 0;
            std::memcpy(&value, bytes.data() + at, sizeof(value));
            return std::size_t{value};
        };
        if (bytes.size() < kHead + kChunkHead || word(kHead) > bytes.size() - kHead - kChunkHead) {
            return fail("is cut off");
        }
        text = bytes.substr(kHead + kChunkHead, word(kHead));
        const std::size_t next = kHead + kChunkHead + text.size();
        if (bytes.size() - next >= kChunkHead) {
            binary = bytes.substr(next + kChunkHead, word(next));
        }
    }
    Json json = Json::parse(text, nullptr, false);
    if (!json.is_object()) {
        return fail("is not glTF: its JSON cannot be read");
    }
    return Document{std::move(json), binary};
}

/// Puts all buffers into one, which the views look into from then on.
Expected<std::string> one_buffer(Document& document, const ImportWays& ways) {
    std::string all;
    std::vector<std::size_t> starts;
    for (const Json& buffer : document.json.value("buffers", Json::array())) {
        constexpr std::size_t kAlignment = 8;
        all.resize((all.size() + kAlignment - 1) / kAlignment * kAlignment, '\0');
        starts.push_back(all.size());
        if (buffer.contains("uri")) {
            const auto bytes = ways.fetch(buffer.at("uri").get<std::string>());
            if (!bytes) {
                return fail(bytes.error());
            }
            all += *bytes;
        } else {
            all += document.binary;
        }
        if (all.size() > kMostBytes) {
            return fail("has more than 512 MB of buffers");
        }
    }
    if (document.json.contains("bufferViews")) {
        for (Json& view : document.json.at("bufferViews")) {
            const std::size_t offset = view.value("byteOffset", std::size_t{0});
            const std::size_t length = view.at("byteLength").get<std::size_t>();
            const std::size_t start = starts.at(view.at("buffer").get<std::size_t>());
            if (offset > all.size() - start || length > all.size() - start - offset) {
                return fail("has a bufferView that lies outside of its buffer");
            }
            view["byteOffset"] = start + offset;
            view["buffer"] = 0;
        }
    }
    return all;
}

template <typename Number>
void append_values(const draco::PointAttribute& attribute,
                   std::size_t points,
                   std::size_t width,
                   std::string& bytes) {
    std::vector<Number> value(width);
    for (std::size_t p = 0; p < points; ++p) {
        const auto index = attribute.mapped_index(draco::PointIndex(static_cast<std::uint32_t>(p)));
        attribute.ConvertValue<Number>(index, static_cast<std::int8_t>(width), value.data());
        bytes.append(reinterpret_cast<const char*>(value.data()), width * sizeof(Number));
        // Values of vertices begin at multiples of four bytes.
        bytes.resize((bytes.size() + 3) / 4 * 4, '\0');
    }
}

std::size_t width_of(const std::string& type) {
    return type == "SCALAR" ? 1 : type == "VEC2" ? 2 : type == "VEC3" ? 3 : 4;
}

/// Unpacks the meshes of one document.
class Unpacker {
 public:
    Unpacker(Json json, std::string binary) : glb_(std::move(json), std::move(binary)) {}

    Expected<std::string> run() {
        Json& json = glb_.json();
        for (Json& mesh : json.at("meshes")) {
            for (Json& primitive : mesh.at("primitives")) {
                if (primitive.contains("extensions") &&
                    primitive.at("extensions").contains(kDraco)) {
                    if (auto done = unpack(primitive); !done) {
                        return fail(done.error());
                    }
                }
            }
        }
        for (const char* list : {"extensionsUsed", "extensionsRequired"}) {
            forget_draco(list);
        }
        return glb_.bytes();
    }

 private:
    void forget_draco(const char* list) {
        Json& json = glb_.json();
        if (!json.contains(list)) {
            return;
        }
        Json others = Json::array();
        for (const Json& name : json.at(list)) {
            if (name != kDraco) {
                others.push_back(name);
            }
        }
        json[list] = others;
        if (others.empty()) {
            json.erase(list);
        }
    }

    Expected<std::unique_ptr<draco::Mesh>> decode(std::size_t view_index) {
        const Json& view = glb_.json().at("bufferViews").at(view_index);
        const std::string_view packed = glb_.binary().substr(
            view.at("byteOffset").get<std::size_t>(), view.at("byteLength").get<std::size_t>());
        draco::DecoderBuffer buffer;
        buffer.Init(packed.data(), packed.size());
        draco::Decoder decoder;
        auto mesh = decoder.DecodeMeshFromBuffer(&buffer);
        if (!mesh.ok()) {
            return fail(fmt::format("Draco cannot unpack bufferViews[{}]: {}",
                                    view_index,
                                    mesh.status().error_msg_string()));
        }
        return std::move(mesh).value();
    }

    Expected<void> unpack(Json& primitive) {
        const Json packed = primitive.at("extensions").at(kDraco);
        auto mesh = decode(packed.at("bufferView").get<std::size_t>());
        if (!mesh) {
            return fail(mesh.error());
        }
        for (const auto& [name, id] : packed.at("attributes").items()) {
            const draco::PointAttribute* const attribute =
                (*mesh)->GetAttributeByUniqueId(id.get<std::uint32_t>());
            if (attribute == nullptr) {
                return fail(fmt::format("Draco has packed no attribute {}", name));
            }
            unpack_attribute(*attribute,
                             (*mesh)->num_points(),
                             primitive.at("attributes").at(name).get<std::size_t>());
        }
        if (primitive.contains("indices")) {
            unpack_corners(**mesh, primitive.at("indices").get<std::size_t>());
        }
        primitive.at("extensions").erase(kDraco);
        if (primitive.at("extensions").empty()) {
            primitive.erase("extensions");
        }
        return glb_.binary().size() > kMostBytes ? fail("has more than 512 MB when it is unpacked")
                                                 : Expected<void>();
    }

    void unpack_attribute(const draco::PointAttribute& attribute,
                          std::size_t points,
                          std::size_t accessor_index) {
        Json& accessor = glb_.json().at("accessors").at(accessor_index);
        const std::size_t width = width_of(accessor.at("type").get<std::string>());
        std::string bytes;
        switch (accessor.at("componentType").get<int>()) {
            case kByte:
                append_values<std::int8_t>(attribute, points, width, bytes);
                break;
            case kOctet:
                append_values<std::uint8_t>(attribute, points, width, bytes);
                break;
            case kShort:
                append_values<std::int16_t>(attribute, points, width, bytes);
                break;
            case kWord:
                append_values<std::uint16_t>(attribute, points, width, bytes);
                break;
            default:
                append_values<float>(attribute, points, width, bytes);
                break;
        }
        put(accessor_index, points, bytes, points > 0 ? bytes.size() / points : 0);
    }

    void unpack_corners(const draco::Mesh& mesh, std::size_t accessor_index) {
        std::vector<std::uint32_t> corners;
        corners.reserve(std::size_t{mesh.num_faces()} * 3);
        for (std::uint32_t f = 0; f < mesh.num_faces(); ++f) {
            for (const draco::PointIndex& corner : mesh.face(draco::FaceIndex(f))) {
                corners.push_back(corner.value());
            }
        }
        glb_.json().at("accessors").at(accessor_index)["componentType"] = int{kLong};
        put(accessor_index,
            corners.size(),
            {reinterpret_cast<const char*>(corners.data()), corners.size() * sizeof(corners[0])},
            0);
    }

    /// Gives an accessor bytes of its own; `stride`: between vertices, 0 of corners.
    void put(std::size_t accessor_index,
             std::size_t count,
             std::string_view bytes,
             std::size_t stride) {
        const std::size_t view =
            glb_.add_view(std::as_bytes(std::span(bytes.data(), bytes.size())));
        if (stride != 0) {
            glb_.json().at("bufferViews").at(view)["byteStride"] = stride;
        }
        Json& accessor = glb_.json().at("accessors").at(accessor_index);
        accessor["bufferView"] = view;
        accessor["byteOffset"] = 0;
        accessor["count"] = count;
    }

    GlbDocument glb_;
};

}  // namespace

Expected<std::string> unpack_draco(const std::string& bytes, const ImportWays& ways) {
    try {
        auto document = take_apart(bytes);
        if (!document) {
            return fail(document.error());
        }
        auto binary = one_buffer(*document, ways);
        if (!binary) {
            return fail(binary.error());
        }
        return Unpacker(std::move(document->json), std::move(*binary)).run();
    } catch (const Json::exception&) {
        // What is missing or of another type is told by no more than this.
        return fail("is not glTF that Draco has packed: a part of it is missing or damaged");
    }
}

}  // namespace raks::engine
