#pragma once

#include <memory>
#include <vector>

#include "apps/raks_train/genre_material.hpp"
#include "audio/evaluate/genre_scores.hpp"
#include "audio/genre/genre_model.hpp"
#include "base/expected.hpp"
#include "models/recurrent_network.hpp"

namespace raks::apps {

/// Trains the recurrent networks on the written music; weights are kept in the cache between runs.
[[nodiscard]] std::vector<std::shared_ptr<const models::RecurrentNetwork>> written_networks(
    const GenreOptions& options,
    const GenreMaterial& material,
    const std::vector<std::string>& genres);

/// Cross-validates by artist: scores of pieces by models that were trained without their artist.
/// Prints the tables; where asked for, also those of damaged recordings. Errors: as cross_validate;
/// the report cannot be written.
[[nodiscard]] Expected<std::vector<audio::WindowScore>> validate_by_group(
    const GenreOptions& options,
    const GenreMaterial& material,
    const audio::FeaturePlan& feature_plan,
    const std::vector<std::string>& genres);

/// Tests the finished model on written music that it was not trained on, and prints the tables.
/// Errors: a soundfont cannot be read.
[[nodiscard]] Expected<void> test_on_written(const GenreOptions& options,
                                             const audio::FeaturePlan& feature_plan,
                                             const audio::GenreModel& model);

}  // namespace raks::apps
