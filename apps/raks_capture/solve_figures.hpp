// Solve figures: what scripts want to know of a solved dance, as JSON.
#pragma once

#include <optional>
#include <string>

#include "apps/raks_capture/body_facts.hpp"
#include "motion/capture/solving/solve.hpp"

namespace raks::apps {

/// raks-solve, version 1 (docs/reference/files.md): body and bones, how far markers are from where
/// they were measured, how far joints are beyond their limits, how feet stand, what is doubtful.
/// `body`: the dance as it was written; none: no feet are told.
[[nodiscard]] std::string solve_json(const capture::SolvedDance& dance,
                                     const std::optional<BodyFacts>& body);

}  // namespace raks::apps
