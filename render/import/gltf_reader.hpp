#pragma once

#include <cstddef>
#include <span>

#include "base/expected.hpp"
#include "render/import/side_files.hpp"
#include "render/model/model.hpp"

namespace raks::render {

/// Reads glTF 2.0, as text or in a container, and what is built on it: VRM 0.x and 1.0, VRMA. Every
/// index, length and number is checked; what a model claims is compared with the bytes that there
/// are before anything is allocated, and all of it stays below 900 MB with the
/// file. Images stay packed.
/// Errors: "nodes[3].mesh: 9 is not one of 5".
/// Threads: workers. Real-time: no.
[[nodiscard]] Expected<Model> read_gltf(std::span<const std::byte> file, const SideFiles& side);

}  // namespace raks::render
