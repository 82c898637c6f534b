#include "render/import/gltf_file.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cstdint>
#include <cstring>
#include <set>
#include <string>
#include <string_view>

#include "base/printable.hpp"
#include "render/import/characters.hpp"
#include "render/import/model_warnings.hpp"

namespace raks::render {
namespace {

constexpr std::uint32_t kMagic = 0x46546C67;   // "glTF", little-endian
constexpr std::uint32_t kJson = 0x4E4F534A;    // "JSON"
constexpr std::uint32_t kBinary = 0x004E4942;  // "BIN\0"
constexpr std::size_t kHeader = 12;
constexpr std::size_t kChunkHeader = 8;
/// The parser takes up to 14 times as much memory.
constexpr std::size_t kLongestJson = std::size_t{32} << 20U;

/// What may stand in extensionsRequired.
constexpr std::array<std::string_view, 14> kExtensions = {
    "EXT_meshopt_compression",
    "EXT_texture_webp",
    "KHR_materials_emissive_strength",
    "KHR_materials_unlit",
    "KHR_mesh_quantization",
    "KHR_texture_transform",
    "VRM",
    "VRMC_materials_hdr_emissiveMultiplier",
    "VRMC_materials_mtoon",
    "VRMC_node_constraint",
    "VRMC_springBone",
    "VRMC_springBone_extended_collider",
    "VRMC_vrm",
    "VRMC_vrm_animation",
};

std::uint32_t word_at(std::span<const std::byte> bytes, std::size_t at) {
    std::uint32_t word = 0;
    for (std::size_t i = 0; i < 4; ++i) {
        word |= std::to_integer<std::uint32_t>(bytes[at + i]) << (8 * i);
    }
    return word;
}

/// The document in UTF-8, without what some put before and behind it.
Expected<JsonDocument> parse_json(std::string_view text, Model& model) {
    constexpr std::string_view kMark = "\xEF\xBB\xBF";
    if (text.substr(0, kMark.size()) == kMark) {
        text.remove_prefix(kMark.size());
        warn(model, "has a byte-order mark before its JSON");
    }
    if (!text.empty() && text.back() == '\0') {
        text = text.substr(0, text.find_last_not_of('\0') + 1);
        warn(model, "has zero bytes after its JSON");
    }
    if (text.size() > kLongestJson) {
        return fail(
            fmt::format("has more than {} MiB of JSON; keep buffers and images in files beside it",
                        kLongestJson >> 20U));
    }
    return JsonDocument::parse(text);
}

/// The chunks of a container, in the only order that they may have.
struct Chunks {
    std::optional<std::span<const std::byte>> json;
    std::optional<std::span<const std::byte>> binary;
};

/// Puts the chunk with number `order` where it belongs. Others than the two are left out, as
/// the specification asks for.
Expected<void> take_chunk(Chunks& chunks,
                          std::size_t order,
                          std::uint32_t type,
                          std::span<const std::byte> bytes) {
    if ((order == 0) != (type == kJson)) {
        return fail(order == 0 ? "its first chunk is not JSON; export it again"
                               : "has two chunks of JSON; export it again");
    }
    if (type == kJson) {
        chunks.json = bytes;
    } else if (type == kBinary) {
        if (order != 1) {
            return fail("its BIN chunk is not the second one; export it again");
        }
        chunks.binary = bytes;
    }
    return {};
}

Expected<Chunks> read_chunks(std::span<const std::byte> body) {
    Chunks chunks;
    std::size_t order = 0;
    for (std::size_t at = 0; at < body.size(); ++order) {
        if (body.size() - at < kChunkHeader) {
            return fail("is cut off within the header of a chunk; copy it again");
        }
        const std::size_t length = word_at(body, at);
        const std::uint32_t type = word_at(body, at + 4);
        at += kChunkHeader;
        if (length > body.size() - at) {
            return fail(
                fmt::format("a chunk says that it has {} bytes, but only {} are left: it is cut "
                            "off; copy it again",
                            length,
                            body.size() - at));
        }
        if (length % 4 != 0) {
            return fail("the length of a chunk is not a multiple of 4; export it again");
        }
        if (auto ok = take_chunk(chunks, order, type, body.subspan(at, length)); !ok) {
            return fail(ok.error());
        }
        at += length;
    }
    if (!chunks.json || chunks.json->empty()) {
        return fail("has no JSON in it");
    }
    return chunks;
}

Expected<GltfFile> open_container(std::span<const std::byte> file, Model& model) {
    if (file.size() < kHeader) {
        return fail("is cut off within its header; copy it again");
    }
    if (const std::uint32_t version = word_at(file, 4); version != 2) {
        return fail(fmt::format("is a GLB file of version {}, not 2", version));
    }
    const std::size_t length = word_at(file, 8);
    if (length < kHeader || length > file.size()) {
        return fail(
            fmt::format("says that it has {} bytes, but has {}: it is cut off; copy it again",
                        length,
                        file.size()));
    }
    if (length < file.size()) {
        warn(model, fmt::format("has {} bytes after its end", file.size() - length));
    }
    const auto chunks = read_chunks(file.subspan(kHeader, length - kHeader));
    if (!chunks) {
        return fail(chunks.error());
    }
    if (chunks->binary && chunks->binary->empty()) {
        warn(model, "has an empty BIN chunk");
    }
    auto json = parse_json(characters_of(*chunks->json), model);
    if (!json) {
        return fail(json.error());
    }
    return GltfFile{.json = std::move(*json),
                    .binary = chunks->binary,
                    .is_glb = true,
                    .json_bytes = chunks->json->size()};
}

/// "2.0" as (2, 0); none: no version.
std::optional<std::pair<int, int>> version_of(std::string_view text) {
    int major = 0;
    int minor = 0;
    char rest = 0;
    const std::string copy(text.substr(0, 20));
    const bool has_digits_only = copy.find_first_not_of("0123456789.") == std::string::npos;
    if (!has_digits_only || std::sscanf(copy.c_str(), "%4d.%4d%c", &major, &minor, &rest) != 2) {
        return std::nullopt;
    }
    return std::pair{major, minor};
}

void check_version(const JsonField& asset, Model& model) {
    if (!asset.is_object()) {
        asset.complain("is missing or not an object: this is not glTF 2.0");
        return;
    }
    constexpr std::pair kOurs{2, 0};
    const auto version = version_of(asset["version"].text());
    if (!version) {
        asset["version"].complain("is not a version, such as 2.0");
        return;
    }
    const JsonField least = asset["minVersion"];
    const auto needed = least.exists() ? version_of(least.text()) : kOurs;
    if (version->first != 2 || !needed || *needed > std::max(kOurs, *version)) {
        asset.complain("is not of glTF 2.0; export it as that");
    } else if (*version != kOurs || *needed != kOurs) {
        warn(model, asset.line("is newer than glTF 2.0; read as 2.0"));
    }
}

/// Names in an array of texts; a fault where one stands twice.
std::set<std::string_view> names_in(const JsonField& list, Model& model) {
    std::set<std::string_view> names;
    for (const JsonField& item : list.items()) {
        if (!names.insert(item.text()).second) {
            warn(model, item.line("is listed twice"));
        }
    }
    return names;
}

}  // namespace

Expected<GltfFile> open_gltf(std::span<const std::byte> file, Model& model) {
    if (file.empty()) {
        return fail("empty");
    }
    if (file.size() >= 4 && word_at(file, 0) == kMagic) {
        return open_container(file, model);
    }
    auto json = parse_json(characters_of(file), model);
    if (!json) {
        return fail(fmt::format("is not glTF, as it {}", json.error().message));
    }
    return GltfFile{.json = std::move(*json),
                    .binary = std::nullopt,
                    .is_glb = false,
                    .json_bytes = file.size()};
}

void check_gltf_needs(const JsonField& root, Model& model) {
    check_version(root["asset"], model);
    const std::set<std::string_view> used = names_in(root["extensionsUsed"], model);
    for (const std::string_view name : names_in(root["extensionsRequired"], model)) {
        if (std::find(kExtensions.begin(), kExtensions.end(), name) == kExtensions.end()) {
            root["extensionsRequired"].complain(fmt::format(
                "it needs the extension {}, which Raks does not read; export it without",
                printable(name, 80)));
        }
        if (used.count(name) == 0) {
            warn(model,
                 fmt::format("needs the extension {}, which is missing from extensionsUsed", name));
        }
    }
    for (const auto& [name, extension] : root["extensions"].entries()) {
        if (used.count(name) == 0) {
            warn(model, extension.line("is missing from extensionsUsed"));
        }
        if (!extension.is_object()) {
            warn(model, extension.line("is not an object"));
        }
    }
}

}  // namespace raks::render
