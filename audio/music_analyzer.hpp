#pragma once

#include <cstdint>
#include <memory>
#include <span>

#include "audio/beat/analyzer_command.hpp"
#include "audio/features/cepstral_mean.hpp"
#include "base/expected.hpp"
#include "base/music_state.hpp"
#include "base/realtime.hpp"
#include "base/time.hpp"

/// The one door of audio analysis: samples in, one MusicState every 10 ms out.
namespace raks::audio {

/// How the beat is found: the bar pointer, or the paper's method (audio/beat/paper_beat.hpp), which
/// knows no bars and heeds no commands.
enum class BeatMethod : std::uint8_t { pointer, paper };

class BeatNetwork;
struct GenreModel;

struct AnalyzerConfig {
    SampleRate sample_rate{48'000};  ///< of the samples that process() gets; 8 to 192 kHz
    BeatMethod beat_method = BeatMethod::pointer;
    /// Hears beats and bars (audio/beat/network/network_file.hpp loads the shipped one). None: the
    /// onset strength alone leads, and bars are not known.
    std::shared_ptr<const BeatNetwork> beat_network = nullptr;
    CepstralMeanConfig cepstral_mean = {};  ///< of mfcc(); a genre model brings its own
    /// Says which dance the music is (audio/genre/genre_file.hpp loads the shipped one). None:
    /// always unknown.
    std::shared_ptr<const GenreModel> genre_model = nullptr;
    /// The dances that MusicState::genre numbers. The tempi of the recognised one become likelier
    /// (hint_genre). None: the genre is always none.
    std::shared_ptr<const DanceList> dances = nullptr;
    double genre_window = 3.0;  ///< seconds that the genre is judged by, 0.5 to 10
};

/// Beat, tempo, genre, loudness and silence of a stream of mono samples, causal and in real time.
///
///     MusicAnalyzer analyzer;
///     analyzer.prepare({.sample_rate = rate});        // once, checks, allocates
///     analyzer.process(block, sink);                  // every block, any size
///
/// The same samples give the same states, bit for bit, whatever the blocks. A state depends on the
/// samples before its time + delay() alone.
/// Threads: one owner; prepare elsewhere before. Real-time: process, command, skip and reset yes.
class MusicAnalyzer {
 public:
    /// Gets each finished state, in order, on the thread of process().
    class Sink {
     public:
        virtual void on_state(const MusicState& state) noexcept = 0;

     protected:
        ~Sink() = default;
    };

    MusicAnalyzer();
    ~MusicAnalyzer();
    MusicAnalyzer(MusicAnalyzer&&) noexcept;
    MusicAnalyzer& operator=(MusicAnalyzer&&) noexcept;

    /// Errors: a sample rate outside 8 to 192 kHz; a genre model that is not valid, or a window
    /// outside 0.5 to 10 s.
    [[nodiscard]] Expected<void> prepare(const AnalyzerConfig& config);

    /// Takes the next samples, nominally in [-1, 1]; NaN and infinities count as 0, louder samples
    /// than +-16 are clamped. Hands out the states that became complete: none to many.
    /// Cost: about 60 us a hop; nothing grows with the length of the stream.
    void process(std::span<const float> mono, Sink& sink) noexcept RAKS_NONBLOCKING;

    /// Queues a command (16 wait at most; more are dropped).
    void command(const AnalyzerCommand& command) noexcept RAKS_NONBLOCKING;

    /// Audio was lost before the next sample: stream time goes on by `lost` (at most 10 s count).
    /// The hops in the gap come out with the next process(), the grid running on; the first state
    /// after it says is_discontinuity, and the tracker looks for the beat anew. With 0: a jump to
    /// other audio (a seek).
    void skip(Nanos lost) noexcept RAKS_NONBLOCKING;

    /// Back to just-prepared.
    void reset() noexcept RAKS_NONBLOCKING;

    /// The state of hop n is complete when the samples before time_of_hop(n) + delay() are in.
    [[nodiscard]] Nanos delay() const noexcept;

    /// MFCC-39 (features/mfcc.hpp) with the running cepstral mean taken off, as of the newest hop:
    /// of the sound MfccHops::kAge before it. All 0 until the first is known; in a gap the last one
    /// stays. Threads: the owner.
    [[nodiscard]] const MfccVector& mfcc() const noexcept;

    /// Magnitudes of the newest hop's mel bands (OnsetDetector). Threads: the owner.
    [[nodiscard]] std::span<const float> mel_magnitudes() const noexcept;

    /// Samples that were NaN or infinite, since reset().
    [[nodiscard]] std::uint64_t bad_samples() const noexcept;

 private:
    struct State;
    std::unique_ptr<State> state_;
};

}  // namespace raks::audio
