// A figure of a dance that a person wrote, danced by the mannequin.
#pragma once

#include <cstddef>
#include <filesystem>
#include <string>

#include "base/beats.hpp"
#include "base/expected.hpp"
#include "motion/choreography/authored_dance.hpp"
#include "motion/choreography/figure_evaluation.hpp"

namespace raks::engine {

/// Reads a written dance. Errors: those of the reader, and the first of motion::faults_in_motion:
/// what the reader takes may still ask for what no body can do.
[[nodiscard]] Expected<motion::AuthoredDance> load_written_dance(const std::filesystem::path& path);

/// The number of the figure of this name; empty: the first. Errors: there is none, with the name
/// nearest to it.
[[nodiscard]] Expected<std::size_t> find_figure(const motion::AuthoredDance& dance,
                                                const std::string& name);

/// Several repeats of a figure, each with noise of its own, of which the first can follow the last.
/// Threads: any. Real-time: no.
[[nodiscard]] motion::EvaluatedFigure danced_figure(const motion::AuthoredDance& dance,
                                                    std::size_t figure,
                                                    Bpm tempo);

}  // namespace raks::engine
