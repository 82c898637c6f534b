#include "motion/dance/baking/feature_draw.hpp"

#include <Eigen/Cholesky>
#include <cmath>
#include <cstddef>

namespace raks::motion {

// The Cholesky factor of the correlation matrix turns white noise into correlated features.
FeatureDraw::FeatureDraw(const PartModel& part) {
    const auto size = static_cast<Eigen::Index>(part.dimension());
    Eigen::MatrixXd correlation(size, size);
    const auto covariance = [&](Eigen::Index i, Eigen::Index j) {
        return part.covariance[static_cast<std::size_t>(i)][static_cast<std::size_t>(j)];
    };
    for (Eigen::Index i = 0; i < size; ++i) {
        for (Eigen::Index j = 0; j < size; ++j) {
            correlation(i, j) = covariance(i, j) / std::sqrt(covariance(i, i) * covariance(j, j));
        }
    }
    root_ = correlation.llt().matrixL();
}

Eigen::VectorXd FeatureDraw::next(const CounterRandom& random) {
    Eigen::VectorXd white(root_.rows());
    for (double& value : white) {
        value = random.normal(draw_++);
    }
    return root_ * white;
}

}  // namespace raks::motion
