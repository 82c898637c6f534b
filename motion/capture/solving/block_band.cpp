#include "motion/capture/solving/block_band.hpp"

#include <Eigen/Cholesky>
#include <algorithm>

namespace raks::capture {

BlockBand::BlockBand(std::size_t blocks, std::size_t size)
    : blocks_(blocks),
      matrix_(
          blocks * 3,
          Eigen::MatrixXd::Zero(static_cast<Eigen::Index>(size), static_cast<Eigen::Index>(size))),
      right_(blocks, Eigen::VectorXd::Zero(static_cast<Eigen::Index>(size))) {}

bool BlockBand::factor(std::size_t block) {
    Eigen::MatrixXd& diagonal = at(block, 0);
    for (std::size_t back = 1; back <= std::min<std::size_t>(2, block); ++back) {
        const Eigen::MatrixXd& left = at(block - back, back);
        diagonal.selfadjointView<Eigen::Lower>().rankUpdate(left, -1.0);
    }
    const Eigen::LLT<Eigen::Ref<Eigen::MatrixXd>, Eigen::Lower> llt(diagonal);
    if (llt.info() != Eigen::Success) {
        return false;
    }
    if (block + 1 < blocks_) {
        Eigen::MatrixXd& below = at(block, 1);
        if (block > 0) {
            below.noalias() -= at(block - 1, 2) * at(block - 1, 1).transpose();
        }
        diagonal.triangularView<Eigen::Lower>().transpose().solveInPlace<Eigen::OnTheRight>(below);
    }
    if (block + 2 < blocks_) {
        diagonal.triangularView<Eigen::Lower>().transpose().solveInPlace<Eigen::OnTheRight>(
            at(block, 2));
    }
    return true;
}

bool BlockBand::solve() {
    for (std::size_t block = 0; block < blocks_; ++block) {
        if (!factor(block)) {
            return false;
        }
        for (std::size_t back = 1; back <= std::min<std::size_t>(2, block); ++back) {
            right_[block].noalias() -= at(block - back, back) * right_[block - back];
        }
        at(block, 0).triangularView<Eigen::Lower>().solveInPlace(right_[block]);
    }
    for (std::size_t block = blocks_; block-- > 0;) {
        for (std::size_t below = 1; below <= 2 && block + below < blocks_; ++below) {
            right_[block].noalias() -= at(block, below).transpose() * right_[block + below];
        }
        at(block, 0).triangularView<Eigen::Lower>().transpose().solveInPlace(right_[block]);
    }
    return true;
}

}  // namespace raks::capture
