#pragma once

#include <string>
#include <vector>

namespace raks::engine {

/// Mends meshes of a binary FBX that belong to no model: the file connects each of them to a model
/// that it does not hold, and readers leave such a mesh out without a word. Each one is connected
/// to a model for meshes that has no mesh, in the order in which both stand in the file. `notes`
/// gets a line for each. `bytes`: a file that check_fbx finds good; its length stays. Threads: any.
/// Real-time: no.
void mend_fbx_connections(std::string& bytes, std::vector<std::string>& notes);

}  // namespace raks::engine
