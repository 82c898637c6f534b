#pragma once

#include <vector>

#include "audio/music/generator/music_generator.hpp"
#include "audio/music_analyzer.hpp"
#include "base/music_state.hpp"

namespace raks::audio::test {

/// Keeps every state.
class Collect final : public MusicAnalyzer::Sink {
 public:
    explicit Collect(std::size_t hops = 10'000) { states.reserve(hops); }
    void on_state(const MusicState& state) noexcept override { states.push_back(state); }
    std::vector<MusicState> states;
};

/// Hits, misses and timing of announced beats against those of the generator, from `from` to `to`
/// seconds.
struct BeatScore {
    double f_measure = 0.0;     ///< +-70 ms
    double median_error = 0.0;  ///< seconds, signed
    double worst_error = 0.0;   ///< of the hits, absolute
};
BeatScore score_beats(const std::vector<MusicState>& states,
                      const std::vector<ReferenceBeat>& beats,
                      double from,
                      double to);

/// Music of one style with these tempi, mono.
GeneratedMusic music(Style style,
                     std::vector<TempoPoint> tempo,
                     double seconds,
                     int hertz = 48'000);

/// What the program prepares an analyzer with: the networks and the genre model that are shipped,
/// for samples of a rate.
AnalyzerConfig as_shipped(SampleRate rate = SampleRate(48'000));

/// All states of a piece, fed in blocks of 256.
std::vector<MusicState> listen(const GeneratedMusic& piece);

}  // namespace raks::audio::test
