#pragma once

#include <cstdint>
#include <vector>

namespace raks::render {

/// Pixels from the upper left on, row by row; four bytes each: red, green, blue, opacity, as they
/// lie in the file (no colour profile is applied).
struct Image {
    int width = 0;
    int height = 0;
    std::vector<std::uint8_t> pixels;
};

}  // namespace raks::render
