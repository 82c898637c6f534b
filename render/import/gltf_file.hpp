#pragma once

#include <cstddef>
#include <optional>
#include <span>

#include "base/expected.hpp"
#include "render/import/json_field.hpp"
#include "render/model/model.hpp"

/// glTF 2.0 and what stands on it (GLB, VRM, VRMA), read with all that a hostile file may say in
/// mind. Learnt: a reader that trusts loads two of three files that must be refused.
namespace raks::render {

/// A glTF file taken apart. `binary` looks into the bytes that were given.
struct GltfFile {
    JsonDocument json;
    std::optional<std::span<const std::byte>> binary;  ///< the BIN chunk
    bool is_glb = false;
    std::size_t json_bytes = 0;
};

/// Takes a file apart: one of JSON, or a container "glTF" of version 2. Warnings: what follows the
/// container, a byte-order mark. Errors: container cut, lengths that do not fit, chunks missing,
/// twice or out of order; no JSON (see JsonDocument::parse).
[[nodiscard]] Expected<GltfFile> open_gltf(std::span<const std::byte> file, Model& model);

/// Checks asset.version, and that every extension that the file requires is one that is read.
/// Faults: another version than 2, an extension by its name.
void check_gltf_needs(const JsonField& root, Model& model);

}  // namespace raks::render
