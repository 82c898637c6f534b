#pragma once

#include <string>
#include <vector>

namespace raks::engine {

/// Leads connections that lead nowhere to where they can only be meant: the mesh of a binary FBX
/// whose connection names a model that is not there goes to a mesh model that has none, one after
/// the other as they are in the file. Such a mesh would be left out in silence. Says in `notes`
/// what it did, a line each. `bytes`: what check_fbx finds good; their length stays. Threads: any.
/// Real-time: no.
void mend_fbx_connections(std::string& bytes, std::vector<std::string>& notes);

}  // namespace raks::engine
