// Feature draw: correlated Gaussian draws of a part's features.
#pragma once

#include <cstdint>
#include <vector>

#include "base/random.hpp"
#include "motion/figures/figure_model.hpp"

#include <Eigen/Core>

namespace raks::motion {

/// Draws normal vectors whose features are correlated as in the part's covariance, each of variance
/// one. Threads: one. Real-time: no (it allocates).
class FeatureDraw {
 public:
    /// `part`: covariance positive definite, as validate() checks.
    explicit FeatureDraw(const PartModel& part);
    /// The next vector (D features); consecutive calls use consecutive numbers of `random`.
    [[nodiscard]] Eigen::VectorXd next(const CounterRandom& random);

 private:
    Eigen::MatrixXd root_;    // lower triangle of the correlation
    std::uint64_t draw_ = 0;  // number of the next draw
};

}  // namespace raks::motion
