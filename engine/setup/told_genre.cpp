#include "engine/setup/told_genre.hpp"

#include <filesystem>
#include <string_view>
#include <utility>
#include <vector>

#include "base/file.hpp"
#include "engine/setup/settings.hpp"

namespace raks::engine {

Expected<std::shared_ptr<const audio::GenreWords>> load_told_genres(
    const DanceList& dances, const audio::GenreModel* model) {
    std::vector<std::string_view> names = dances.names();
    if (model != nullptr) {
        names.insert(names.end(), model->genres.begin(), model->genres.end());
    }
    const auto installed = data_path(std::filesystem::path("config") / "genres.toml");
    if (!installed) {
        return fail(installed.error());
    }
    auto words = audio::load_genre_words(*installed, names);
    // The person's own rows win.
    const std::filesystem::path settings = user_settings_path();
    const std::filesystem::path own =
        settings.empty() ? settings : settings.parent_path() / "genres.toml";
    if (words && !own.empty() && is_there(own)) {
        words = audio::load_genre_words(own, names, std::move(*words));
    }
    return words ? Expected<std::shared_ptr<const audio::GenreWords>>(
                       std::make_shared<const audio::GenreWords>(std::move(*words)))
                 : fail(words.error());
}

audio::TagEvidence told_by(const AnalyzerModels& models, const audio::AudioTags& tags) {
    return models.words ? audio::evidence_of({tags.genre, tags.title, tags.artist, tags.album},
                                             *models.words)
                        : audio::TagEvidence();
}

AnalyzerModels told(AnalyzerModels models, const audio::AudioTags& tags) {
    if (models.genres) {
        models.genre_prior = audio::prior_of(told_by(models, tags), *models.genres);
    }
    return models;
}

std::string_view told_name(const audio::TagEvidence& evidence) {
    const std::string_view dance = evidence.dance();
    return dance == audio::GenreWords::kFallback ? "none of the dances" : dance;
}

}  // namespace raks::engine
