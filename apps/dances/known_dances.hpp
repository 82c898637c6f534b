#pragma once

#include "base/expected.hpp"
#include "engine/setup/analyzer_setup.hpp"

namespace raks::apps {

/// The analyzer's models, for all dances that are found. `aids`: what helps to tell them.
/// Errors: those of the catalogue and of the models. Threads: workers. Real-time: no.
[[nodiscard]] Expected<engine::AnalyzerModels> load_models_of_known_dances(
    const engine::GenreAids& aids = {engine::TaggerUse::off, engine::FileTags::ignored});

}  // namespace raks::apps
