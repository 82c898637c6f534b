#pragma once

#include <array>
#include <cstdint>

namespace raks::engine {

/// How a film wants its pictures turned: by quarters of a turn, and mirrored.
struct Orientation {
    bool is_transposed = false;  ///< rows of the stored picture are columns of the seen one
    bool is_x_reversed = false;  ///< along the seen picture's x the stored one runs backwards
    bool is_y_reversed = false;  ///< likewise

    /// Of the matrix (16.16 fixed point, rows of three) that containers store; one that is no
    /// quarter of a turn is passed over.
    [[nodiscard]] static Orientation of_matrix(const std::array<std::int32_t, 9>& matrix) noexcept {
        const bool is_transposed = matrix[0] == 0 && matrix[4] == 0;
        const std::int32_t x = is_transposed ? matrix[3] : matrix[0];
        const std::int32_t y = is_transposed ? matrix[1] : matrix[4];
        if (x == 0 || y == 0) {
            return {};
        }
        return {is_transposed, x < 0, y < 0};
    }

    /// Is the seen picture another than the stored one?
    [[nodiscard]] bool turns() const noexcept {
        return is_transposed || is_x_reversed || is_y_reversed;
    }
    /// Degrees clockwise: 0, 90, 180 or 270, mirrored or not.
    [[nodiscard]] int degrees() const noexcept {
        if (is_transposed) {
            return is_x_reversed ? 90 : 270;
        }
        return is_y_reversed ? 180 : 0;
    }
};

}  // namespace raks::engine
