// Pictures of boards for tests.
#pragma once

#include <cstdint>
#include <filesystem>
#include <vector>

#include "motion/capture/calibration/board_detection.hpp"

namespace raks::capture::test {

/// A picture that owns its bytes.
struct Picture {
    int width = 0;
    int height = 0;
    std::vector<std::uint8_t> pixels;

    [[nodiscard]] GreyPicture grey() const { return {width, height, pixels}; }
};

/// Reads a JPEG or PNG as grey; without size where it cannot.
[[nodiscard]] Picture read_picture(const std::filesystem::path& path);

}  // namespace raks::capture::test
