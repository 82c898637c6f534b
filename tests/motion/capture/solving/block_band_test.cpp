#include "motion/capture/solving/block_band.hpp"

#include <gtest/gtest.h>

#include <Eigen/Cholesky>

#include "base/dice.hpp"

namespace raks::capture {
namespace {

/// A positive definite band of blocks, and the same as one dense matrix.
struct Equations {
    BlockBand band;
    Eigen::MatrixXd dense;
    Eigen::VectorXd right;
};

Equations drawn_equations(std::size_t blocks, std::size_t size) {
    Dice dice(7, blocks * 100 + size);
    const auto n = static_cast<Eigen::Index>(size);
    const auto all = static_cast<Eigen::Index>(blocks) * n;
    Equations equations{
        {blocks, size}, Eigen::MatrixXd::Zero(all, all), Eigen::VectorXd::Zero(all)};
    for (std::size_t block = 0; block < blocks; ++block) {
        const auto column = static_cast<Eigen::Index>(block) * n;
        for (std::size_t below = 0; below <= 2 && block + below < blocks; ++below) {
            Eigen::MatrixXd& part = equations.band.at(block, below);
            part = part.unaryExpr([&](double) { return dice.uniform(-1.0, 1.0); });
            if (below == 0) {
                part = (part + part.transpose()).eval();
                part.diagonal().array() += 10.0 * static_cast<double>(size);
            }
            const auto row = column + static_cast<Eigen::Index>(below) * n;
            equations.dense.block(row, column, n, n) = part;
            equations.dense.block(column, row, n, n) = part.transpose();
        }
        Eigen::VectorXd& right = equations.band.right(block);
        right = right.unaryExpr([&](double) { return dice.uniform(-1.0, 1.0); });
        equations.right.segment(column, n) = right;
    }
    return equations;
}

TEST(BlockBand, solves_as_the_dense_equations) {
    for (const std::size_t blocks : {1U, 2U, 3U, 12U}) {
        for (const std::size_t size : {1U, 5U}) {
            Equations equations = drawn_equations(blocks, size);
            const Eigen::VectorXd expected = equations.dense.llt().solve(equations.right);
            ASSERT_TRUE(equations.band.solve());
            const auto n = static_cast<Eigen::Index>(size);
            for (std::size_t block = 0; block < blocks; ++block) {
                const Eigen::VectorXd difference =
                    equations.band.right(block) -
                    expected.segment(static_cast<Eigen::Index>(block) * n, n);
                EXPECT_LT(difference.norm(), 1e-12) << blocks << " blocks, block " << block;
            }
        }
    }
}

TEST(BlockBand, refuses_what_is_not_positive_definite) {
    BlockBand band(3, 2);
    for (std::size_t block = 0; block < 3; ++block) {
        band.at(block, 0).setIdentity();
    }
    band.at(1, 0)(1, 1) = -1.0;
    EXPECT_FALSE(band.solve());
}

}  // namespace
}  // namespace raks::capture
