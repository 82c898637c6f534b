#pragma once

#include <array>
#include <cstddef>
#include <string>

#include "motion/figures/figure_model.hpp"

#include <fmt/format.h>

namespace raks::apps {

/// "torso 1.2, upper 3.4, lower 5.6": log-likelihoods of those parts that figures with these
/// features have.
[[nodiscard]] inline std::string listed_likelihoods(motion::FigureFeatures features,
                                                    const std::array<double, 3>& log_likelihood) {
    std::string line;
    for (const motion::Part part : motion::parts_of(features)) {
        const auto p = static_cast<std::size_t>(part);
        line += fmt::format(
            "{}{} {:.1f}", line.empty() ? "" : ", ", motion::kPartNames[p], log_likelihood[p]);
    }
    return line;
}

}  // namespace raks::apps
