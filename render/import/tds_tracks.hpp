#pragma once

#include "render/import/import_budget.hpp"
#include "render/import/tds_file.hpp"
#include "render/model/model.hpp"

namespace raks::render {

/// Sets place, rotation and scale of a node to the first key of each track, y up.
void set_rest(const TdsNode& from, ModelNode& node);

/// Adds the tracks that move as a clip, "keyframes", at 30 frames a second: nodes of the file are
/// the first ones of the model (add_tds_nodes). Places and scales go through their keys as the
/// curves of Kochanek and Bartels do, turns evenly. Tracks for which the budget is too small are
/// left out, with a warning. Threads: one. Real-time: no.
void add_tds_clip(const TdsFile& file, ImportBudget& budget, Model& model);

}  // namespace raks::render
