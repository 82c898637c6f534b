#pragma once

#include <map>
#include <string>

#include "base/expected.hpp"
#include "render/import/import_budget.hpp"
#include "render/import/tds_file.hpp"
#include "render/model/model.hpp"

namespace raks::render {

/// Adds the nodes of the keyframer to a model, in their order, and below them the meshes; then a
/// node for each object that the keyframer leaves out. They stand as at the first key of each
/// track. Names become different ones, with a note; a parent that is not there or that hangs on its
/// own child is left out, with a warning. `materials`: by name.
/// Errors: more than 20,000 nodes or 1,000 below one another; as of make_tds_mesh.
/// Threads: one. Real-time: no.
[[nodiscard]] Expected<void> add_tds_nodes(const TdsFile& file,
                                           const std::map<std::string, int>& materials,
                                           ImportBudget& budget,
                                           Model& model);

}  // namespace raks::render
