// What is done to foreign files before assimp sees them.
#pragma once

#include <string>
#include <vector>

#include "base/expected.hpp"
#include "engine/import/assimp_reader.hpp"

namespace raks::engine {

/// The file as assimp can read it: Collada in UTF-8 and without the blanks at which it stumbles, an
/// FBX whose connections assimp takes and whose colours have no factor. `notes` gets a line for
/// each thing that its author should mend. Errors: what assimp would read in silence, or break at:
/// no file of the format by its first bytes, a binary FBX that is cut or whose parts lie outside
/// one another, an OBJ whose faces have corners that are not there. Threads: any. Real-time: no.
[[nodiscard]] Expected<std::string> mended_text(ForeignFormat format,
                                                const std::string& bytes,
                                                std::vector<std::string>& notes);

}  // namespace raks::engine
