#pragma once

#include <string>
#include <vector>

namespace raks::engine {

/// Makes the connections of an FBX such that assimp reads them. `notes` gets a line for each thing
/// that changes what is read. `bytes`: a file that check_fbx finds good; its length stays.
///
/// - A mesh of a binary FBX that belongs to no model: the file connects it to a model that it does
///   not hold, and readers leave it out without a word. Each one is connected to a model for meshes
///   that has no mesh, in the order in which both stand in the file.
/// - A connection of kind PO, from an object's property to an object: assimp takes the property's
///   name for the number of an object and refuses the file (assimp's issue 3467). It becomes one of
///   kind OP between the same objects, with the same property.
/// - Of a binary FBX another connection without two numbers of objects, at which assimp refuses the
///   file, too: it is left out. Kind PP, between properties, is left out by assimp itself.
///
/// Threads: any. Real-time: no.
void mend_fbx_connections(std::string& bytes, std::vector<std::string>& notes);

}  // namespace raks::engine
