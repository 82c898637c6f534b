#pragma once

#include <memory>
#include <string>
#include <vector>

#include "base/expected.hpp"
#include "engine/settings.hpp"
#include "motion/ensemble.hpp"
#include "motion/figures/figure_model.hpp"

namespace raks::engine {

/// Dances whose trained figures come with Raks.
[[nodiscard]] std::vector<std::string> known_dances();

/// Errors: `dance` is neither known nor "auto"; the nearest is named.
[[nodiscard]] Expected<void> check_dance(const std::string& dance);

/// What `dance` and `fallback_dance` come to: "auto" is the fallback until a dance is recognised.
[[nodiscard]] std::string dance_to_load(const Settings& settings);

/// Reads the trained figures of a dance from models/trained and solves them for the built-in
/// mannequin. Errors: an unknown dance, a model file that is missing or bad.
[[nodiscard]] Expected<std::shared_ptr<const motion::DanceLibrary>> load_dance(
    const std::string& dance, motion::DanceRole role = motion::DanceRole::lead);

/// Who dances, by the settings: dance, formation and seed. Errors: as load_dance, an unknown
/// formation.
[[nodiscard]] Expected<std::vector<motion::EnsembleMember>> load_dancers(const Settings& settings);

}  // namespace raks::engine
