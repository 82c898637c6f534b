#pragma once

#include <array>
#include <cstdint>
#include <string_view>

#include "motion/figures/figure_model.hpp"

namespace raks::motion {

/// Where an HMM's states lie before Baum-Welch.
enum class StatesStart : std::uint8_t {
    flat,       ///< on equal slices of the sequences
    segmental,  ///< from there to the most likely segments: k-means of left-to-right models
};
inline constexpr std::array<std::string_view, 2> kStatesStartNames = {"flat", "segmental"};

/// How the HMM of one part is learnt.
struct StateLearning {
    int states = 16;
    int iterations = 0;  ///< of Baum-Welch, after the start
    /// Share of each feature's variance that lies under every variance (diagonal) or is added to
    /// the diagonal of every covariance.
    double covariance_floor = 0.1;
    CovarianceKind covariance = CovarianceKind::tied;
    StatesStart start = StatesStart::flat;
};

}  // namespace raks::motion
