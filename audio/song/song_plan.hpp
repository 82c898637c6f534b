#pragma once

#include <cstddef>
#include <memory>
#include <span>
#include <vector>

#include "audio/music_analyzer.hpp"
#include "audio/song/song_beats.hpp"
#include "audio/song/song_dances.hpp"
#include "base/expected.hpp"
#include "base/music_state.hpp"
#include "base/time.hpp"

namespace raks::audio {

/// A song as it is known before it sounds: the states that the dancer gets instead of the stream's,
/// one a hop. Immutable once made. Threads: any may read.
struct SongPlan {
    std::vector<MusicState> states;     ///< by hop, each with a Foresight
    std::vector<SongBeat> beats;        ///< all, in order
    std::vector<SongSection> sections;  ///< by the genre model's classes
    /// Bar lines at which a show that began without the plan may take it over, ascending: that of
    /// bar 5, then of every eighth bar. They follow from the song alone.
    std::vector<StreamTime> joins;

    /// The state at a place of the song for hop `hop` of a stream: grid and times are shifted to
    /// that hop's time. Places outside the song have the state of its first or last hop. Real-time:
    /// yes.
    [[nodiscard]] MusicState at(StreamTime place, HopIndex hop) const noexcept RAKS_NONBLOCKING;
};

/// Analyzes a whole song: the streaming analysis first, whose evidence is kept, then the most
/// likely beats, bars and dances over all of it. Breaks, drops and the ending are known ahead.
///
///     SongAnalyzer analyzer;
///     analyzer.prepare(config);
///     while (... block ...) analyzer.process(block);
///     const SongPlan plan = analyzer.finish();
///
/// The same samples give the same plan, whatever the blocks. Cost: the stream's, and about 6 us a
/// hop. Memory: 0.5 kB a hop. Threads: one. Real-time: no.
class SongAnalyzer {
 public:
    SongAnalyzer();                                    ///< call prepare() before anything else
    ~SongAnalyzer();                                   ///< frees all
    SongAnalyzer(SongAnalyzer&&) noexcept;             ///< movable, not copyable
    SongAnalyzer& operator=(SongAnalyzer&&) noexcept;  ///< as above

    /// Sets up; only the pointer's method has a second pass. Errors: those of
    /// MusicAnalyzer::prepare.
    [[nodiscard]] Expected<void> prepare(const AnalyzerConfig& config);
    /// Takes the next samples.
    void process(std::span<const float> mono);
    /// Ends the song where its samples end. Leaves nothing behind.
    [[nodiscard]] SongPlan finish();

 private:
    struct State;
    std::unique_ptr<State> state_;
};

}  // namespace raks::audio
