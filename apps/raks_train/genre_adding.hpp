#pragma once

#include <filesystem>
#include <memory>
#include <set>
#include <span>
#include <string>
#include <vector>

#include "apps/raks_train/genre_options.hpp"
#include "audio/evaluate/piece_features.hpp"
#include "audio/genre/genre_model.hpp"
#include "base/expected.hpp"
#include "training/genre/genre_samples.hpp"

/// Adding a genre to a trained model without the music of its other genres.
namespace raks::apps {

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
