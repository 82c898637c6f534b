#pragma once

#include <cstddef>
#include <span>

#include "base/expected.hpp"
#include "render/import/side_files.hpp"
#include "render/model/model.hpp"

namespace raks::render {

/// Reads a 3DS file: the editor's meshes, materials and smoothing groups, the keyframer's tree,
/// pivots and tracks. y points up in the model; its unit is the file's own, which 3DS does not
/// tell. Every length, count and index is checked against the bytes that there are; all of the
/// model stays below 900 MB with the file. Images stay packed.
/// Errors: as of parse_tds and add_tds_nodes.
/// Threads: workers. Real-time: no.
[[nodiscard]] Expected<Model> read_tds(std::span<const std::byte> file, const SideFiles& side);

}  // namespace raks::render
