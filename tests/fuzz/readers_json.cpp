// What is done with texts that are JSON: models, which are danced and listened with.
#include <cmath>
#include <cstdint>
#include <memory>
#include <vector>

#include "audio/beat/network/network_file.hpp"
#include "audio/genre/genre_file.hpp"
#include "audio/music_analyzer.hpp"
#include "base/dance_list.hpp"
#include "base/music_state.hpp"
#include "motion/dance_library.hpp"
#include "motion/dancer.hpp"
#include "motion/figures/figure_model.hpp"
#include "motion/skeleton/pose_track.hpp"
#include "motion/skeleton/skeleton.hpp"
#include "tests/fuzz/readers.hpp"

namespace raks::fuzz {
namespace {

constexpr double kTempo = 120.0;         // BPM
constexpr HopIndex kDancedHops = 200;    // 2 s
constexpr std::uint32_t kRate = 16'000;  // samples a second

/// Counts the states; what they hold is of no matter here.
class StateCount final : public audio::MusicAnalyzer::Sink {
 public:
    void on_state(const MusicState& /*state*/) noexcept override { ++count_; }

    [[nodiscard]] int count() const noexcept { return count_; }

 private:
    int count_ = 0;
};

/// The dances that come with Raks.
std::shared_ptr<const DanceList> shipped_dances() {
    static const auto dances = [] {
        auto file = load_dances(RAKS_SOURCE_DIR "/models/trained/dances.toml", {});
        return std::make_shared<const DanceList>(file ? file->dances : std::vector<DanceInfo>{});
    }();
    return dances;
}

/// Hears one second of clicks over a hum. False: the analyzer refuses the models.
bool listen(const audio::AnalyzerConfig& config) {
    audio::MusicAnalyzer analyzer;
    if (!analyzer.prepare(config)) {
        return false;
    }
    std::vector<float> samples(kRate);
    for (std::size_t i = 0; i < samples.size(); ++i) {
        const bool is_click = i % (kRate / 2) < 80;
        samples[i] = static_cast<float>(0.2 * std::sin(0.05 * static_cast<double>(i)) +
                                        (is_click ? 0.5 : 0.0));
    }
    StateCount states;
    analyzer.process(samples, states);
    return states.count() > 0;
}

}  // namespace

bool read_figure(std::string_view text) {
    const auto model = motion::parse_figure(text, "x.json");
    if (!model) {
        return false;
    }
    const auto library = motion::DanceLibrary::build({&*model, 1}, motion::mannequin_skeleton());
    if (!library) {
        return false;
    }
    motion::Dancer dancer;
    if (!dancer.prepare(*library, motion::mannequin_skeleton(), std::uint64_t{1})) {
        return false;
    }
    motion::PoseTrack track;
    for (HopIndex hop = 0; hop < kDancedHops; ++hop) {
        MusicState state;
        state.hop = hop;
        state.time = time_of_hop(hop);
        state.audio_end = state.time;
        state.grid.tempo = Bpm(kTempo);
        state.grid.confidence = 1.0F;
        state.is_silent = false;
        state.loudness_lufs = -14.0F;
        dancer.advance(state, track);
    }
    return true;
}

bool read_genre(std::string_view text) {
    auto model = audio::parse_genre(text);
    if (!model) {
        return false;
    }
    audio::AnalyzerConfig config;
    config.sample_rate = SampleRate(kRate);
    config.genre_model = std::make_shared<const audio::GenreModel>(std::move(*model));
    config.dances = shipped_dances();
    config.genre_window = 0.5;
    return listen(config);
}

bool read_beats(std::string_view text) {
    auto network = audio::parse_network(text, "x.json");
    if (!network) {
        return false;
    }
    audio::AnalyzerConfig config;
    config.sample_rate = SampleRate(kRate);
    config.beat_network = std::move(*network);
    return listen(config);
}

}  // namespace raks::fuzz
