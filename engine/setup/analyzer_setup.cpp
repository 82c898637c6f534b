#include "engine/setup/analyzer_setup.hpp"

#include <utility>

#include "audio/beat/network/network_file.hpp"
#include "audio/genre/genre_file.hpp"
#include "engine/setup/settings.hpp"

namespace raks::engine {

Expected<std::shared_ptr<const audio::BeatNetwork>> load_beat_network(
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

Expected<AnalyzerModels> load_analyzer_models(std::shared_ptr<const DanceList> dances) {
    auto beats = load_beat_network();
    if (!beats) {
        return fail(beats.error());
    }
    auto genres = load_genre_model();
    if (!genres) {
        return fail(genres.error());
    }
    return AnalyzerModels{std::move(*beats), std::move(*genres), std::move(dances)};
}

namespace {

audio::AnalyzerConfig config_of(SampleRate rate,
                                const AnalyzerModels& models,
                                audio::BeatMethod method) {
    audio::AnalyzerConfig config;
    config.sample_rate = rate;
    config.beat_method = method;
    config.beat_network = models.beats;
    config.genre_model = models.genres;
    config.dances = models.dances;
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
                                             audio::BeatMethod method) {
    return prepared<audio::MusicAnalyzer>(config_of(rate, models, method));
}

Expected<audio::SongAnalyzer> make_song_analyzer(SampleRate rate, const AnalyzerModels& models) {
    return prepared<audio::SongAnalyzer>(config_of(rate, models, audio::BeatMethod::pointer));
}

}  // namespace raks::engine
