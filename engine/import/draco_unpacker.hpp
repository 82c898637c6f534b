// glTF whose meshes Draco packed.
#pragma once

#include <string>

#include "base/expected.hpp"
#include "engine/import/side_source.hpp"

namespace raks::engine {

/// The same model as a binary glTF without KHR_draco_mesh_compression: its attributes and corners
/// unpacked, all buffers in the one of the container, all else as it was. `bytes`: a glTF as text
/// or in a container. Errors: no glTF, buffers and views that are not there, what Draco cannot
/// unpack, more than 512 MB. Threads: any. Real-time: no.
[[nodiscard]] Expected<std::string> unpack_draco(const std::string& bytes, const ImportWays& ways);

}  // namespace raks::engine
