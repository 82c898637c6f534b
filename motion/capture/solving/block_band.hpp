// Block band: linear equations in which each block of unknowns meets the next two.
#pragma once

#include <Eigen/Core>
#include <cstddef>
#include <vector>

namespace raks::capture {

/// Symmetric positive definite equations over a row of equal blocks of unknowns (the frames of a
/// motion), block (i, k) being 0 for |i - k| > 2.
class BlockBand {
 public:
    /// `blocks` of `size` unknowns, all 0.
    BlockBand(std::size_t blocks, std::size_t size);

    /// The block in row `block + below`, column `block`; below is 0, 1 or 2.
    [[nodiscard]] Eigen::MatrixXd& at(std::size_t block, std::size_t below) {
        return matrix_[block * 3 + below];
    }
    /// The right side of a block.
    [[nodiscard]] Eigen::VectorXd& right(std::size_t block) { return right_[block]; }

    /// Solves by a Cholesky decomposition, in place of the matrix and the right side. The solution
    /// lies in right(). Only the lower triangles of the diagonal's blocks are read. Cost: blocks x
    /// 4 size^3. False: not positive definite.
    [[nodiscard]] bool solve();

 private:
    bool factor(std::size_t block);

    std::size_t blocks_;
    std::vector<Eigen::MatrixXd> matrix_;  // by block: diagonal and the two below
    std::vector<Eigen::VectorXd> right_;
};

}  // namespace raks::capture
