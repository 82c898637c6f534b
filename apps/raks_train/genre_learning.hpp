#pragma once

#include <memory>
#include <vector>

#include "apps/raks_train/genre_material.hpp"
#include "audio/evaluate/genre_scores.hpp"
#include "audio/genre/genre_model.hpp"
#include "base/expected.hpp"
#include "models/recurrent_network.hpp"

namespace raks::apps {

/// The recurrent networks that have learnt from the written music; kept between runs in the cache.
[[nodiscard]] std::vector<std::shared_ptr<const models::RecurrentNetwork>> written_networks(
    const GenreOptions& options,
    const GenreMaterial& material,
    const std::vector<std::string>& genres);

/// Scores of pieces by models that did not hear their artist; prints how good they are, of
/// recordings with damage, too, where that is asked for.
/// Errors: as cross_validate; the report cannot be written.
[[nodiscard]] Expected<std::vector<audio::WindowScore>> validate_by_group(
    const GenreOptions& options,
    const GenreMaterial& material,
    const audio::FeaturePlan& feature_plan,
    const std::vector<std::string>& genres);

/// Prints how the finished model hears written music that it never heard.
/// Errors: a soundfont cannot be read.
[[nodiscard]] Expected<void> test_on_written(const GenreOptions& options,
                                             const audio::FeaturePlan& feature_plan,
                                             const audio::GenreModel& model);

}  // namespace raks::apps
