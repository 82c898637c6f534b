#pragma once

#include <map>
#include <string>

#include "render/import/import_budget.hpp"
#include "render/import/side_files.hpp"
#include "render/import/tds_chunks.hpp"
#include "render/import/tds_file.hpp"
#include "render/model/model.hpp"

namespace raks::render {

/// Reads a material's chunk (AFFF). Faults: as of TdsChunk.
[[nodiscard]] TdsMaterial read_tds_material(TdsChunk& chunk);

/// Adds the materials of a file to a model, with the pictures that lie beside it: the folders of
/// other machines that a name begins with are left out, and a name of capitals may lie there in
/// small letters. What cannot be had or drawn is a warning. Returns which material has which name;
/// the first of two. Threads: one. Real-time: no.
[[nodiscard]] std::map<std::string, int> add_tds_materials(const TdsFile& file,
                                                           const SideFiles& side,
                                                           ImportBudget& budget,
                                                           Model& model);

}  // namespace raks::render
