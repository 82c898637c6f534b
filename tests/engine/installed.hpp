#pragma once

#include <memory>
#include <string>

#include "engine/setup/analyzer_setup.hpp"
#include "engine/setup/dance_catalogue.hpp"
#include "engine/setup/dancers.hpp"
#include "motion/dance_library.hpp"
#include "motion/skeleton/skeleton.hpp"

/// What the program begins with, for tests: the dances and models of the source tree.
namespace raks::engine::installed {

[[nodiscard]] const DanceCatalogue& dances();
[[nodiscard]] const AnalyzerModels& models();
/// A dance that comes with Raks, for the mannequin.
[[nodiscard]] std::shared_ptr<const motion::DanceLibrary> library_of(const std::string& dance);
/// One dancer of it.
[[nodiscard]] Cast solo(const std::string& dance);

}  // namespace raks::engine::installed
