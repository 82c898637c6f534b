// Models that assimp reads.
#pragma once

#include <cstdint>
#include <string>

#include "base/expected.hpp"
#include "engine/import/side_source.hpp"
#include "render/model/model.hpp"

namespace raks::engine {

/// The formats that are asked of assimp; what else it reads is read better elsewhere.
enum class ForeignFormat : std::uint8_t { fbx, collada, obj };

/// Reads a model: nodes, meshes with skins and morph targets, materials with their pictures, clips.
/// In metres and y up where the format says what it is in. `bytes`: of the file. Errors: what
/// assimp says, no mesh and no skeleton in it, numbers that are not finite; assimp itself may crash
/// on a file: see main.cpp. Threads: one. Real-time: no.
[[nodiscard]] Expected<render::Model> read_with_assimp(ForeignFormat format,
                                                       const std::string& bytes,
                                                       const ImportWays& ways);

}  // namespace raks::engine
