#pragma once

#include <cstdint>
#include <memory>
#include <span>

#include "audio/beat/analyzer_command.hpp"
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

struct AnalyzerConfig {
    SampleRate sample_rate{48'000};  ///< of the samples that process() gets; 8 to 192 kHz
    BeatMethod beat_method = BeatMethod::pointer;
    /// Hears beats and bars (audio/beat/network/network_file.hpp loads the shipped one). None: the
    /// onset strength alone leads, and bars are not known.
    std::shared_ptr<const BeatNetwork> beat_network = nullptr;
};

/// Beat, tempo, loudness and silence of a stream of mono samples, causal and in real time.
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

    /// Errors: a sample rate outside 8 to 192 kHz.
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

    /// Samples that were NaN or infinite, since reset().
    [[nodiscard]] std::uint64_t bad_samples() const noexcept;

 private:
    struct State;
    std::unique_ptr<State> state_;
};

}  // namespace raks::audio
