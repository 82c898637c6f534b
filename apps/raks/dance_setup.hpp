#pragma once

#include "base/expected.hpp"
#include "engine/setup/analyzer_setup.hpp"
#include "engine/setup/dance_catalogue.hpp"
#include "engine/setup/settings.hpp"
#include "motion/skeleton/skeleton.hpp"

namespace raks::apps {

/// What every command that dances begins with.
struct DanceSetup {
    engine::DanceCatalogue catalogue;
    engine::AnalyzerModels models;
    motion::Skeleton skeleton;  ///< of the body that dances
};

/// Whether `--dance` names a place: a folder of dances, or a written dance (.toml).
[[nodiscard]] bool is_dance_place(const std::string& dance);

/// Finds all dances, and says once what is shadowed or left out. Where `settings.dance` is a folder
/// of dances or a written dance, that is danced, and its name takes the place's: a written dance is
/// learnt first, into a folder of the user's cache, and found there the next time.
/// Errors: those of the catalogue, of a written dance, and of the models of the analyzer.
[[nodiscard]] Expected<DanceSetup> open_dances(engine::Settings& settings);

}  // namespace raks::apps
