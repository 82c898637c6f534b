#pragma once

#include <memory>
#include <span>
#include <string>
#include <vector>

#include "audio/music/instruments/soundfont_band.hpp"
#include "audio/music/score/score.hpp"
#include "base/expected.hpp"

namespace raks::audio {

/// A soundfont that is open for reading.
struct SoundfontFile {
    std::string name;     ///< for messages
    int descriptor = -1;  ///< stays the caller's; open as long as it is played
};

/// Plays performances with soundfonts (FluidSynth), in this process: for raks-soundfont and tests.
/// Opens no file. Threads: one each. Real-time: no.
class SoundfontPlayer {
 public:
    SoundfontPlayer();
    ~SoundfontPlayer();
    SoundfontPlayer(const SoundfontPlayer&) = delete;             ///< one synthesizer each
    SoundfontPlayer& operator=(const SoundfontPlayer&) = delete;  ///< likewise

    /// Loads what is played with; once. Errors: a soundfont cannot be loaded.
    [[nodiscard]] Expected<void> load(std::span<const SoundfontFile> soundfonts);

    /// Mono samples at kPerformanceRate, performance.seconds long, peak 0.7; the synthesizer's
    /// delay of 2.5 ms is taken off. The first soundfont plays everything.
    [[nodiscard]] std::vector<float> play(const Performance& performance, const PlayerRoom& room);
    /// The same, played by a band whose players have soundfonts and sounds of their own.
    [[nodiscard]] std::vector<float> play(const Performance& performance,
                                          const PlayerRoom& room,
                                          const PlayerBand& band);

 private:
    struct Synth;
    std::unique_ptr<Synth> synth_;
};

}  // namespace raks::audio
