#pragma once

#include <string_view>

#include "base/expected.hpp"

namespace raks::engine {

/// Walks the records of a binary FBX, 7100 to 7900, without reading what they mean; of a text FBX
/// it looks at the braces. Errors: no FBX, cut, a record that ends before it begins or outside its
/// parent, properties that are not in it, more than 64 records inside one another.
/// Threads: any. Real-time: no.
[[nodiscard]] Expected<void> check_fbx(std::string_view bytes);

}  // namespace raks::engine
