#include "engine/setup/told_genre.hpp"

#include <algorithm>
#include <numeric>
#include <utility>
#include <vector>

#include "audio/beat/analyzer_command.hpp"
#include "audio/genre/genre_recognizer.hpp"
#include "base/file.hpp"
#include "engine/setup/dance_corrections.hpp"
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

namespace {

// Dances that the model does not know, such as one that is no longer there, are passed over.
audio::TagEvidence said_by_person(const DanceCorrections& corrections,
                                  const audio::GenreModel& model,
                                  std::string_view artist,
                                  const std::filesystem::path& file) {
    const auto is_known = [&](std::string_view dance) {
        return std::find(model.genres.begin(), model.genres.end(), dance) != model.genres.end();
    };
    audio::TagEvidence evidence;
    evidence.is_by_person = true;
    if (const std::string_view dance = corrections.of_song(file); is_known(dance)) {
        evidence.dances.emplace_back(dance, audio::kCertainPrior);
        return evidence;
    }
    auto dances = corrections.of_album(artist, file);
    std::erase_if(dances, [&](const auto& dance) { return !is_known(dance.first); });
    const int songs =
        std::accumulate(dances.begin(), dances.end(), 0, [](int sum, const auto& dance) {
            return sum + dance.second;
        });
    for (auto& [dance, count] : dances) {
        evidence.dances.emplace_back(
            std::move(dance),
            kAlbumStrength * static_cast<float>(count) / static_cast<float>(songs));
    }
    return evidence;
}

// A tempo that the tracker can find; of any other an octave would be a mistake that is none.
double told_tempo(double bpm) {
    return bpm >= audio::kSlowestTempo.bpm() && bpm <= audio::kFastestTempo.bpm() ? bpm : 0.0;
}

}  // namespace

audio::TagEvidence told_by(const AnalyzerModels& models,
                           const audio::AudioTags& tags,
                           const std::filesystem::path& file) {
    if (models.corrections && models.genres && !file.empty()) {
        auto said = said_by_person(*models.corrections->now(), *models.genres, tags.artist, file);
        if (!said.dances.empty()) {
            return said;
        }
    }
    return models.words ? audio::evidence_of({tags.genre, tags.title, tags.artist, tags.album},
                                             *models.words)
                        : audio::TagEvidence();
}

AnalyzerModels told(AnalyzerModels models,
                    const audio::AudioTags& tags,
                    const std::filesystem::path& file) {
    if (models.genres) {
        models.genre_prior = audio::prior_of(told_by(models, tags, file), *models.genres);
    }
    models.told_bpm = models.words && tags.bpm ? told_tempo(*tags.bpm) : 0.0;
    return models;
}

std::string_view told_name(const audio::TagEvidence& evidence) {
    const std::string_view dance = evidence.dance();
    return dance == audio::GenreWords::kFallback ? "none of the dances" : dance;
}

std::string_view teller_of(const audio::TagEvidence& evidence) {
    return evidence.is_by_person ? "as you said" : "as the file says";
}

}  // namespace raks::engine
