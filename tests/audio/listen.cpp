#include "tests/audio/listen.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <memory>
#include <span>
#include <utility>

#include "audio/beat/network/beatnet.hpp"
#include "audio/beat/network/network_file.hpp"
#include "audio/genre/genre_file.hpp"
#include "tests/support/dances.hpp"

namespace raks::audio::test {

BeatScore score_beats(const std::vector<MusicState>& states,
                      const std::vector<ReferenceBeat>& beats,
                      double from,
                      double to) {
    constexpr double kWindow = 0.07;
    std::vector<double> announced;
    for (const MusicState& state : states) {
        const double time = to_seconds(state.beat.time);
        if (state.has_beat && time >= from && time < to) {
            announced.push_back(time);
        }
    }
    std::vector<double> errors;
    int wanted = 0;
    for (const ReferenceBeat& beat : beats) {
        const double time = to_seconds(beat.time);
        if (time < from || time >= to) {
            continue;
        }
        ++wanted;
        const auto near =
            std::min_element(announced.begin(), announced.end(), [time](double a, double b) {
                return std::abs(a - time) < std::abs(b - time);
            });
        if (near != announced.end() && std::abs(*near - time) <= kWindow) {
            errors.push_back(*near - time);
            announced.erase(near);
        }
    }
    BeatScore score;
    if (errors.empty()) {
        return score;
    }
    const double hits = static_cast<double>(errors.size());
    score.f_measure = 2.0 * hits / (hits + static_cast<double>(announced.size()) + wanted);
    for (const double error : errors) {
        score.worst_error = std::max(score.worst_error, std::abs(error));
    }
    std::sort(errors.begin(), errors.end());
    score.median_error = errors[errors.size() / 2];
    return score;
}

GeneratedMusic music(Style style, std::vector<TempoPoint> tempo, double seconds, int hertz) {
    MusicPlan plan;
    plan.style = style;
    plan.tempo = std::move(tempo);
    plan.seconds = seconds;
    plan.rate = SampleRate(hertz);
    plan.channels = 1;
    auto piece = generate(plan);
    EXPECT_TRUE(piece) << piece.error().message;
    return *piece;
}

namespace {

// Our own networks, and BeatNet beside them.
std::shared_ptr<const BeatNetwork> shipped_networks() {
    const auto own = load_network(RAKS_SOURCE_DIR "/models/trained/beats.json");
    auto beatnet = load_beatnet(RAKS_SOURCE_DIR "/models/pretrained/beatnet.weights");
    EXPECT_TRUE(own && beatnet) << (own ? beatnet.error() : own.error()).message;
    if (!own || !beatnet) {
        return nullptr;
    }
    auto both = std::make_shared<BeatNetwork>(**own);
    both->set_beatnet(std::move(*beatnet));
    return both;
}

}  // namespace

AnalyzerConfig as_shipped(SampleRate rate) {
    static const auto networks = shipped_networks();
    AnalyzerConfig config;
    config.sample_rate = rate;
    config.beat_network = networks;
    static const auto genres = load_genre(RAKS_SOURCE_DIR "/models/trained/genres.json");
    EXPECT_TRUE(genres) << genres.error().message;
    config.genre_model = genres ? *genres : nullptr;
    static const auto dances = raks::test::shipped_dances();
    config.dances = dances;
    return config;
}

std::vector<MusicState> listen(const GeneratedMusic& piece) {
    MusicAnalyzer analyzer;
    EXPECT_TRUE(analyzer.prepare(as_shipped(piece.rate)));
    Collect collect;
    const std::vector<float> mono = piece.mono();
    for (std::size_t at = 0; at < mono.size(); at += 256) {
        analyzer.process(std::span(mono).subspan(at, std::min<std::size_t>(256, mono.size() - at)),
                         collect);
    }
    return collect.states;
}

}  // namespace raks::audio::test
