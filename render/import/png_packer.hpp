#pragma once

#include <cstddef>
#include <vector>

#include "base/expected.hpp"
#include "render/model/image.hpp"

namespace raks::render {

/// Packs a picture as PNG, fast rather than small. Errors: what libpng says. Threads: any.
/// Real-time: no.
[[nodiscard]] Expected<std::vector<std::byte>> pack_png(const Image& image);

}  // namespace raks::render
