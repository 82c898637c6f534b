// Whether what a file gave is a place at all: files hold infinities, and numbers that are none.
#pragma once

#include <cmath>

#include <glm/mat4x4.hpp>
#include <glm/vec3.hpp>

namespace raks::render {

/// Whether all coordinates are finite. Threads: any. Real-time: yes.
[[nodiscard]] inline bool is_finite(const glm::vec3& v) noexcept {
    return std::isfinite(v.x) && std::isfinite(v.y) && std::isfinite(v.z);
}

/// Whether all sixteen numbers are.
[[nodiscard]] inline bool is_finite(const glm::mat4& matrix) noexcept {
    for (int column = 0; column < 4; ++column) {
        for (int row = 0; row < 4; ++row) {
            if (!std::isfinite(matrix[column][row])) {
                return false;
            }
        }
    }
    return true;
}

}  // namespace raks::render
