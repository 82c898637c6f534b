#include "engine/hearing.hpp"

#include <utility>

#include "audio/beat/network/network_file.hpp"
#include "engine/settings.hpp"

namespace raks::engine {

Expected<audio::MusicAnalyzer> make_analyzer(SampleRate rate, audio::BeatMethod method) {
    const auto path = data_path("models/trained/beats.json");
    if (!path) {
        return fail(path.error());
    }
    auto network = audio::load_network(*path);
    if (!network) {
        return fail(network.error());
    }
    audio::MusicAnalyzer analyzer;
    if (auto prepared = analyzer.prepare(
            {.sample_rate = rate, .beat_method = method, .beat_network = std::move(*network)});
        !prepared) {
        return fail(prepared.error());
    }
    return analyzer;
}

}  // namespace raks::engine
