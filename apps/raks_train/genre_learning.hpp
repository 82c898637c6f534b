#pragma once

#include <filesystem>
#include <memory>
#include <set>
#include <span>
#include <string>
#include <vector>

#include "apps/raks_train/genre_material.hpp"
#include "apps/raks_train/genre_options.hpp"
#include "audio/evaluate/genre_scores.hpp"
#include "audio/evaluate/piece_features.hpp"
#include "audio/genre/genre_model.hpp"
#include "base/expected.hpp"
#include "models/recurrent_network.hpp"
#include "training/genre/genre_samples.hpp"

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

// Adding a genre to a trained model without the music of its other genres.

/// A model that is added to, and the sample of its training features that was stored beside it.
struct GenreBase {
    std::shared_ptr<const audio::GenreModel> model;  ///< whose genres stay
    audio::GenreSamples samples;                     ///< features of pieces of all its genres
};

/// Loads a model and its sample. Errors: those of the model's file; there is no sample beside it;
/// the sample is of a model with other genres.
[[nodiscard]] Expected<GenreBase> load_base(const std::filesystem::path& model);

/// Checks that new features are comparable with the sample's. Errors: the sample was computed with
/// other features, or another beat network, than this program's.
[[nodiscard]] Expected<void> check_features(const GenreBase& base,
                                            const std::filesystem::path& model,
                                            const audio::FeaturePlan& feature_plan);

/// Puts the HMMs of genres without new music back into `model`: they were trained on all of their
/// music, of which the sample holds only a part. `renewed`: genres with new music.
void keep_known(const GenreBase& base,
                const std::set<std::string>& renewed,
                audio::GenreModel& model);

/// Stores a sample of these pieces' features beside the model; does nothing where the options want
/// none.
[[nodiscard]] Expected<void> keep_samples(const GenreOptions& options,
                                          const audio::FeaturePlan& feature_plan,
                                          std::span<const std::string> genres,
                                          std::span<const audio::PieceFeatures* const> pieces);

}  // namespace raks::apps
