// A glTF model of one triangle with everything that the reader knows, made by the tests themselves.
#pragma once

#include <cstdint>
#include <cstring>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "base/expected.hpp"
#include "render/import/model_reader.hpp"

namespace raks::test {

inline std::string base64(std::string_view bytes) {
    constexpr std::string_view kDigits =
        "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
    std::string text;
    for (std::size_t i = 0; i < bytes.size(); i += 3) {
        std::uint32_t three = 0;
        for (std::size_t k = 0; k < 3; ++k) {
            three = three << 8U |
                    (i + k < bytes.size() ? static_cast<unsigned char>(bytes[i + k]) : 0U);
        }
        for (std::size_t k = 0; k < 4; ++k) {
            text += i + k > bytes.size() ? '=' : kDigits[three >> (18 - 6 * k) & 63U];
        }
    }
    return text;
}

template <typename T>
void append(std::string& bytes, std::initializer_list<T> values) {
    for (const T value : values) {
        bytes.append(reinterpret_cast<const char*>(&value), sizeof(value));
    }
}

/// 332 bytes: positions, indices, joints, weights, inverse bind matrices, a morph target, times,
/// rotations, translations; each begins at the offset that tiny_gltf() says.
inline std::string tiny_buffer() {
    std::string bytes;
    append<float>(bytes, {0, 0, 0, 1, 0, 0, 0, 2, 0});
    append<std::uint16_t>(bytes, {0, 1, 2, 0});
    append<std::uint8_t>(bytes, {0, 0, 0, 0, 0, 1, 0, 0, 1, 0, 0, 0});
    append<float>(bytes, {1, 0, 0, 0, 0.5F, 0.5F, 0, 0, 1, 0, 0, 0});
    append<float>(bytes, {1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1});
    append<float>(bytes, {1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 0, -1, 0, 1});
    append<float>(bytes, {0, 0, 0, 0, 0, 0, 0, 0, 1});
    append<float>(bytes, {0, 1});
    append<float>(bytes, {0, 0, 0, 1, 0, 1, 0, 0});
    append<float>(bytes, {0, 0, 0, 1, 2, 3});
    return bytes;
}

/// The text of the model, with the buffer of tiny_buffer() in it.
inline std::string tiny_gltf(const std::string& buffer = tiny_buffer()) {
    return R"({"asset":{"version":"2.0"},"scene":0,"scenes":[{"nodes":[0,1]}],
"nodes":[{"name":"figure","mesh":0,"skin":0},
 {"name":"lower","children":[2]},{"name":"upper","translation":[0,1,0]}],
"meshes":[{"name":"triangle","extras":{"targetNames":["smile"]},"weights":[0.25],
 "primitives":[{"attributes":{"POSITION":0,"JOINTS_0":2,"WEIGHTS_0":3},"indices":1,"material":0,
  "targets":[{"POSITION":5}]}]}],
"skins":[{"joints":[1,2],"inverseBindMatrices":4}],
"materials":[{"name":"skin","pbrMetallicRoughness":{"baseColorFactor":[1,0.5,0.25,1],
 "metallicFactor":0},"emissiveFactor":[0.5,0,0],"alphaMode":"MASK","alphaCutoff":0.25,
 "doubleSided":true,
 "extensions":{"KHR_materials_emissive_strength":{"emissiveStrength":4},"KHR_materials_unlit":{}}}],
"extensionsUsed":["KHR_materials_emissive_strength","KHR_materials_unlit"],
"animations":[{"name":"turn","samplers":[{"input":6,"output":7},{"input":6,"output":8}],
 "channels":[{"sampler":0,"target":{"node":2,"path":"rotation"}},
  {"sampler":1,"target":{"node":1,"path":"translation"}}]}],
"accessors":[
 {"bufferView":0,"componentType":5126,"count":3,"type":"VEC3","min":[0,0,0],"max":[1,2,0]},
 {"bufferView":1,"componentType":5123,"count":3,"type":"SCALAR"},
 {"bufferView":2,"componentType":5121,"count":3,"type":"VEC4"},
 {"bufferView":3,"componentType":5126,"count":3,"type":"VEC4"},
 {"bufferView":4,"componentType":5126,"count":2,"type":"MAT4"},
 {"bufferView":5,"componentType":5126,"count":3,"type":"VEC3","min":[0,0,0],"max":[0,0,1]},
 {"bufferView":6,"componentType":5126,"count":2,"type":"SCALAR","min":[0],"max":[1]},
 {"bufferView":7,"componentType":5126,"count":2,"type":"VEC4"},
 {"bufferView":8,"componentType":5126,"count":2,"type":"VEC3"}],
"bufferViews":[{"buffer":0,"byteOffset":0,"byteLength":36},
 {"buffer":0,"byteOffset":36,"byteLength":6},{"buffer":0,"byteOffset":44,"byteLength":12},
 {"buffer":0,"byteOffset":56,"byteLength":48},{"buffer":0,"byteOffset":104,"byteLength":128},
 {"buffer":0,"byteOffset":232,"byteLength":36},{"buffer":0,"byteOffset":268,"byteLength":8},
 {"buffer":0,"byteOffset":276,"byteLength":32},{"buffer":0,"byteOffset":308,"byteLength":24}],
"buffers":[{"byteLength":332,"uri":"data:application/octet-stream;base64,)" +
           base64(buffer) + R"("}]})";
}

/// `text` with the first `from` in it replaced; unchanged where there is none.
inline std::string replaced(std::string text, std::string_view from, std::string_view to) {
    if (const std::size_t at = text.find(from); at != std::string::npos) {
        text.replace(at, from.size(), to);
    }
    return text;
}

/// A container around a document and a BIN chunk.
inline std::string glb(std::string json, std::string binary) {
    json.resize((json.size() + 3) / 4 * 4, ' ');
    binary.resize((binary.size() + 3) / 4 * 4, '\0');
    std::string file = "glTF";
    append<std::uint32_t>(file, {2, static_cast<std::uint32_t>(28 + json.size() + binary.size())});
    append<std::uint32_t>(file, {static_cast<std::uint32_t>(json.size()), 0x4E4F534A});
    file += json;
    append<std::uint32_t>(file, {static_cast<std::uint32_t>(binary.size()), 0x004E4942});
    return file + binary;
}

/// tiny_gltf() as a container.
inline std::string tiny_glb() {
    std::string text = tiny_gltf("");
    text = replaced(text, ",\"uri\":\"data:application/octet-stream;base64,\"", "");
    return glb(text, tiny_buffer());
}

/// Reads text or a container that lies in no folder.
inline Expected<render::Model> read_text(std::string_view text, std::string_view name = "x.gltf") {
    return render::read_model(
        std::as_bytes(std::span(text.data(), text.size())), name, render::SideFiles());
}

}  // namespace raks::test
