// Names in 3DS files.
#pragma once

#include <string>
#include <vector>

#include "render/model/model.hpp"

namespace raks::render {

/// Names for all nodes, of 1 to 10 characters, no two the same, in small or large letters: bones by
/// what they are ("LowLegR", "IndexL2"), others by their own names, cut.
[[nodiscard]] std::vector<std::string> tds_node_names(const Model& model);

/// Names for all materials, of 1 to 16 characters, no two the same.
[[nodiscard]] std::vector<std::string> tds_material_names(const Model& model);

}  // namespace raks::render
