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

/// Adding a genre to a model without the music of the others.
namespace raks::apps {

/// A model that is added to, and the sample that was kept beside it.
struct GenreBase {
    std::shared_ptr<const audio::GenreModel> model;
    audio::GenreSamples samples;
};

/// Errors: of the model's file; no sample beside it; a sample of another model's genres.
[[nodiscard]] Expected<GenreBase> load_base(const std::filesystem::path& model);

/// Errors: the sample was heard with other features, or another beat network, than this program's.
[[nodiscard]] Expected<void> check_features(const GenreBase& base,
                                            const std::filesystem::path& model,
                                            const audio::FeaturePlan& feature_plan);

/// Puts back the HMMs of genres without new music: they knew all of it. `renewed`: those with.
void keep_known(const GenreBase& base,
                const std::set<std::string>& renewed,
                audio::GenreModel& model);

/// Keeps a sample of these pieces beside the model. Nothing, where the options want none.
[[nodiscard]] Expected<void> keep_samples(const GenreOptions& options,
                                          const audio::FeaturePlan& feature_plan,
                                          std::span<const std::string> genres,
                                          std::span<const audio::PieceFeatures* const> pieces);

}  // namespace raks::apps
