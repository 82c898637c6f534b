// Banded least squares, solved by Cholesky.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <utility>
#include <vector>

namespace raks::motion {

/// Minimises a sum of squares w (c^T x - m)^2 over a row of unknowns x, where each term spans at
/// most Bands + 1 neighbours: normal equations with Bands bands beside the diagonal, by Cholesky.
/// Threads: one. Real-time: no (it allocates).
template <std::size_t Bands>
class BandedSystem {
 public:
    /// Coefficients c of one term.
    using Coefficients = std::array<double, Bands + 1>;

    /// `size`: number of unknowns.
    explicit BandedSystem(std::size_t size) : bands_(size), right_(size) {}

    /// Adds weight (c^T x - mean)^2, c at unknowns first, first + 1, ...; those outside the row are
    /// left out. weight >= 0; all terms together must determine every unknown.
    void add(std::ptrdiff_t first, const Coefficients& c, double weight, double mean) {
        const auto size = static_cast<std::ptrdiff_t>(right_.size());
        for (std::size_t a = 0; a <= Bands; ++a) {
            const std::ptrdiff_t i = first + static_cast<std::ptrdiff_t>(a);
            if (i < 0 || i >= size || c[a] == 0.0) {
                continue;
            }
            const auto row = static_cast<std::size_t>(i);
            right_[row] += weight * mean * c[a];
            for (std::size_t b = 0; b <= a; ++b) {
                if (first + static_cast<std::ptrdiff_t>(b) >= 0) {
                    bands_[row][a - b] += weight * c[a] * c[b];
                }
            }
        }
    }

    /// The least-squares solution. Call it once: it uses the system up.
    [[nodiscard]] std::vector<double> solve() {
        factor();
        const std::size_t size = right_.size();
        for (std::size_t i = 0; i < size; ++i) {
            for (std::size_t k = 1; k <= std::min(Bands, i); ++k) {
                right_[i] -= bands_[i][k] * right_[i - k];
            }
            right_[i] /= bands_[i][0];
        }
        for (std::size_t i = size; i-- > 0;) {
            for (std::size_t k = 1; k <= Bands && i + k < size; ++k) {
                right_[i] -= bands_[i + k][k] * right_[i + k];
            }
            right_[i] /= bands_[i][0];
        }
        return std::move(right_);
    }

 private:
    // Floor against rounding; a well-posed system lies far above it
    static constexpr double kLeastDiagonal = 1e-12;

    /// Cholesky factor (lower triangle), in place.
    void factor() {
        for (std::size_t i = 0; i < bands_.size(); ++i) {
            for (std::size_t k = std::min(Bands, i); k > 0; --k) {
                double sum = bands_[i][k];
                for (std::size_t m = k + 1; m <= std::min(Bands, i); ++m) {
                    sum -= bands_[i][m] * bands_[i - k][m - k];
                }
                bands_[i][k] = sum / bands_[i - k][0];
            }
            double diagonal = bands_[i][0];
            for (std::size_t k = 1; k <= std::min(Bands, i); ++k) {
                diagonal -= bands_[i][k] * bands_[i][k];
            }
            bands_[i][0] = std::sqrt(std::max(diagonal, kLeastDiagonal));
        }
    }

    std::vector<std::array<double, Bands + 1>> bands_;  // [i][k]: element (i, i - k)
    std::vector<double> right_;
};

}  // namespace raks::motion
