// Bones by the names of nodes.
#pragma once

#include "render/model/model.hpp"

namespace raks::render {

/// The bones that names give away, by motion::bones_by_name.
[[nodiscard]] HumanoidMap map_by_names(const Model& model);

}  // namespace raks::render
