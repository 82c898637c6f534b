#include "engine/setup/analyzer_setup.hpp"

#include <utility>

#include "audio/beat/network/beatnet.hpp"
#include "audio/beat/network/network_file.hpp"
#include "audio/genre/genre_file.hpp"
#include "audio/genre/music_tagger.hpp"
#include "audio/genre/tagger_file.hpp"
#include "engine/setup/settings.hpp"
#include "engine/setup/told_genre.hpp"

namespace raks::engine {

namespace {

Expected<std::shared_ptr<const audio::BeatNetwork>> load_own_network(
    const std::filesystem::path& path) {
    // A file that was named must not be replaced by the shipped one when it is missing.
    if (!path.empty()) {
        return audio::load_network(path);
    }
    const auto shipped = data_path("models/trained/beats.json");
    if (!shipped) {
        return fail(shipped.error());
    }
    return audio::load_network(*shipped);
}

}  // namespace

Expected<std::shared_ptr<const audio::BeatNetwork>> load_beat_network(
    const std::filesystem::path& path, BeatNetUse beatnet) {
    auto own = load_own_network(path);
    if (!own || beatnet == BeatNetUse::off) {
        return own;
    }
    const auto shipped = data_path("models/pretrained/beatnet.weights");
    if (!shipped) {
        return fail(shipped.error());
    }
    auto weights = audio::load_beatnet(*shipped);
    if (!weights) {
        return fail(weights.error());
    }
    auto both = std::make_shared<audio::BeatNetwork>(**own);
    both->set_beatnet(std::move(*weights));
    return both;
}

Expected<std::shared_ptr<const audio::GenreModel>> load_genre_model(
    const std::filesystem::path& path) {
    if (!path.empty()) {
        return audio::load_genre(path);
    }
    const auto shipped = data_path("models/trained/genres.json");
    if (!shipped) {
        return fail(shipped.error());
    }
    return audio::load_genre(*shipped);
}

namespace {

Expected<std::shared_ptr<const audio::TaggerNetwork>> load_shipped_tagger() {
    const auto shipped = data_path("models/pretrained/msd_musicnn.tagger");
    if (!shipped) {
        return fail(shipped.error());
    }
    return audio::load_tagger(*shipped);
}

}  // namespace

Expected<AnalyzerModels> load_analyzer_models(std::shared_ptr<const DanceList> dances,
                                              const GenreAids& aids) {
    auto beats = load_beat_network();
    if (!beats) {
        return fail(beats.error());
    }
    auto genres = load_genre_model();
    if (!genres) {
        return fail(genres.error());
    }
    AnalyzerModels models{std::move(*beats), std::move(*genres), std::move(dances)};
    if (aids.tags == FileTags::read) {
        auto words = load_told_genres(*models.dances, models.genres.get());
        if (!words) {
            return fail(words.error());
        }
        models.words = std::move(*words);
    }
    if (aids.tagger == TaggerUse::on) {
        if (auto network = load_shipped_tagger()) {
            models.tagger = std::move(*network);
        } else {
            models.tagger_note = network.error().message + "; music is not tagged";
        }
    }
    return models;
}

std::shared_ptr<audio::TagSource> make_tagger(const AnalyzerModels& models) {
    return models.tagger ? std::make_shared<audio::HopTagger>(models.tagger) : nullptr;
}

namespace {

audio::AnalyzerConfig config_of(SampleRate rate,
                                const AnalyzerModels& models,
                                audio::BeatMethod method,
                                std::shared_ptr<audio::TagSource> tags) {
    audio::AnalyzerConfig config;
    config.sample_rate = rate;
    config.beat_method = method;
    config.beat_network = models.beats;
    config.genre_model = models.genres;
    config.dances = models.dances;
    config.tags = std::move(tags);
    config.genre_prior = models.genre_prior;
    config.told_bpm = models.told_bpm;
    return config;
}

// prepare() checks the whole configuration and makes all allocations; later calls cannot fail.
template <class Analyzer>
Expected<Analyzer> prepared(const audio::AnalyzerConfig& config) {
    Analyzer analyzer;
    if (auto done = analyzer.prepare(config); !done) {
        return fail(done.error());
    }
    return analyzer;
}

}  // namespace

Expected<audio::MusicAnalyzer> make_analyzer(SampleRate rate,
                                             const AnalyzerModels& models,
                                             audio::BeatMethod method,
                                             std::shared_ptr<audio::TagSource> tags) {
    return prepared<audio::MusicAnalyzer>(config_of(rate, models, method, std::move(tags)));
}

Expected<audio::SongAnalyzer> make_song_analyzer(SampleRate rate,
                                                 const AnalyzerModels& models,
                                                 std::shared_ptr<audio::TagSource> tags) {
    return prepared<audio::SongAnalyzer>(
        config_of(rate, models, audio::BeatMethod::pointer, std::move(tags)));
}

}  // namespace raks::engine
