#pragma once

#include <optional>

#include "base/key.hpp"

namespace raks::render {

/// The key of GLFW's number, or nothing for a key that types a character.
[[nodiscard]] std::optional<Key> named_key(int glfw_key);

}  // namespace raks::render
