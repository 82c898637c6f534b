#pragma once

#include <cstdint>
#include <vector>

#include "base/random.hpp"
#include "motion/figures/figure_model.hpp"

#include <Eigen/Core>

namespace raks::motion {

/// Normal numbers of a part's features, together as its covariance says, each of variance one.
class FeatureDraw {
 public:
    explicit FeatureDraw(const PartModel& part);
    /// Draws from `random` one after the other. As long as the part has features.
    [[nodiscard]] Eigen::VectorXd next(const CounterRandom& random);

 private:
    Eigen::MatrixXd root_;  // lower triangle of the correlation
    std::uint64_t draw_ = 0;
};

}  // namespace raks::motion
