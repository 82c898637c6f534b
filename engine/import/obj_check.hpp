#pragma once

#include <string_view>

#include "base/expected.hpp"

namespace raks::engine {

/// Looks at the vertices and faces of a Wavefront OBJ, line after line. Errors: no text, no
/// vertices, a vertex that is no finite number, a corner that is not there or has index 0, a face
/// of more than 4096 corners, each with its line. Threads: any. Real-time: no.
[[nodiscard]] Expected<void> check_obj(std::string_view text);

}  // namespace raks::engine
