// Models of other formats, which the program raks-import reads in a cage.
#pragma once

#include <chrono>
#include <cstddef>
#include <span>
#include <string_view>

#include "base/expected.hpp"
#include "render/import/side_files.hpp"
#include "render/model/model.hpp"

namespace raks::render {

/// How long reading a model of another format may take.
inline constexpr std::chrono::seconds kLongestImport(20);

/// Reads a model of another format: raks-import makes a binary glTF of it, which read_gltf reads.
/// `format`: "fbx", "dae", "obj", or "draco" for a glTF with meshes that Draco packed. Its
/// libraries run in a process of their own that opens no file, has 1 GiB and `longest`, and which a
/// damaged or malicious file can at worst end; of what lies beside the model it gets what
/// WantedFiles gives.
/// Nothing of it runs when this returns. Errors: why it cannot be read; the process broke off, hung
/// or answered nonsense; it is not there, or this build is without it.
/// Threads: workers. Real-time: no.
[[nodiscard]] Expected<Model> read_foreign_model(
    std::string_view format,
    std::span<const std::byte> bytes,
    const SideFiles& side,
    std::chrono::milliseconds longest = kLongestImport);

/// Whether a glTF says that it has meshes packed by Draco.
[[nodiscard]] bool uses_draco(std::span<const std::byte> gltf);

}  // namespace raks::render
