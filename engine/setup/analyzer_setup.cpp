#include "engine/setup/analyzer_setup.hpp"

#include <utility>

#include "audio/beat/network/network_file.hpp"
#include "audio/genre/genre_file.hpp"
#include "engine/setup/settings.hpp"

namespace raks::engine {

Expected<std::shared_ptr<const audio::BeatNetwork>> load_beat_network(
    const std::filesystem::path& path) {
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

namespace {

Expected<audio::MusicAnalyzer> prepared(const audio::AnalyzerConfig& config) {
    audio::MusicAnalyzer analyzer;
    if (auto done = analyzer.prepare(config); !done) {
        return fail(done.error());
    }
    return analyzer;
}

}  // namespace

Expected<audio::MusicAnalyzer> make_analyzer(SampleRate rate, audio::BeatMethod method) {
    auto network = load_beat_network();
    if (!network) {
        return fail(network.error());
    }
    auto model = load_genre_model();
    if (!model) {
        return fail(model.error());
    }
    audio::AnalyzerConfig config;
    config.sample_rate = rate;
    config.beat_method = method;
    config.beat_network = std::move(*network);
    config.genre_model = std::move(*model);
    return prepared(config);
}

Expected<audio::MusicAnalyzer> make_analyzer(SampleRate rate,
                                             audio::BeatMethod method,
                                             std::shared_ptr<const audio::BeatNetwork> network) {
    audio::AnalyzerConfig config;
    config.sample_rate = rate;
    config.beat_method = method;
    config.beat_network = std::move(network);
    return prepared(config);
}

}  // namespace raks::engine
