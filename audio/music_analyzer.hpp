#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <span>

#include "audio/beat/analyzer_command.hpp"
#include "audio/features/mfcc.hpp"
#include "base/expected.hpp"
#include "base/music_state.hpp"
#include "base/realtime.hpp"
#include "base/time.hpp"

/// Audio analysis: samples in, one MusicState every 10 ms out.
namespace raks::audio {

/// Method of beat tracking: the bar pointer, or the paper's (audio/beat/paper_beat.hpp), which
/// finds no bars and ignores commands.
enum class BeatMethod : std::uint8_t { pointer, paper };

class BeatTracker;      // audio/beat/beat_tracker.hpp
class GenreRecognizer;  // audio/genre/genre_recognizer.hpp
class BeatNetwork;      // audio/beat/network/beat_network.hpp
struct GenreModel;      // audio/genre/genre_model.hpp
struct TrackedHop;      // audio/beat/beat_tracker.hpp
struct HopSound;        // audio/form/hop_sound.hpp
class TagSource;        // audio/genre/tag_source.hpp

/// What is known of a song beside its sound, as its tags say it.
struct ToldSong {
    GenreLogProbabilities genre_prior{};  ///< AnalyzerConfig::genre_prior
    double bpm = 0.0;                     ///< AnalyzerConfig::told_bpm
};

/// What MusicAnalyzer::prepare() needs to know.
struct AnalyzerConfig {
    SampleRate sample_rate{48'000};                ///< of process()'s samples, 8 to 192 kHz
    BeatMethod beat_method = BeatMethod::pointer;  ///< how beats are found
    /// Network for beats and bars (audio/beat/network/network_file.hpp loads the shipped one).
    /// Null: beats follow from the onset strength alone, and bars are not known.
    std::shared_ptr<const BeatNetwork> beat_network = nullptr;
    /// Of mfcc(), for who reads it without a genre model, which has its own. None, and no genre
    /// model: MFCC are not computed.
    std::optional<CepstralMeanConfig> cepstral_mean = std::nullopt;
    /// Model for the genre (audio/genre/genre_file.hpp loads the shipped one). Null: the genre is
    /// always none.
    std::shared_ptr<const GenreModel> genre_model = nullptr;
    /// The dances that MusicState::genre numbers. The tempi of the recognised one become likelier
    /// (hint_genre). Null: the genre is always none.
    std::shared_ptr<const DanceList> dances = nullptr;
    /// Is given the sound at 16 kHz of every hop and has the music tagger's newest word: a
    /// HopTagger (audio/genre/music_tagger.hpp), or a thread's (engine/live/tagger_thread.hpp). Of
    /// this analyzer alone. Null: nothing is tagged.
    std::shared_ptr<TagSource> tags = nullptr;
    double genre_window = 3.0;  ///< seconds of music that the genre is scored on, 0.5 to 10
    /// What is known of the genre beforehand: GenreSettings::prior. All 0: nothing.
    GenreLogProbabilities genre_prior{};
    /// Tempo that is told of the music beforehand: BeatPointerConfig::told_bpm. 0: none.
    double told_bpm = 0.0;
};

/// Beat, tempo, genre, loudness, energy and form of a stream of mono samples, causal and in real
/// time.
///
///     MusicAnalyzer analyzer;
///     analyzer.prepare({.sample_rate = rate});        // once, checks, allocates
///     analyzer.process(block, sink);                  // every block, any size
///
/// The same samples give the same states, bit for bit, whatever the blocks. A state depends only on
/// samples before its time + delay().
/// Threads: one owner; prepare elsewhere before. Real-time: process, command, skip and reset yes.
class MusicAnalyzer {
 public:
    /// Receives each finished state, in order, on the thread of process().
    class Sink {
     public:
        /// Takes one state; mfcc() and mel_magnitudes() are of its hop meanwhile. Real-time: must
        /// be where process() is; a sink of a real-time thread marks it RAKS_NONBLOCKING, one that
        /// collects a whole file may allocate.
        virtual void on_state(const MusicState& state) noexcept = 0;

     protected:
        ~Sink() = default;
    };

    /// Call prepare() before anything else.
    MusicAnalyzer();
    /// Frees all.
    ~MusicAnalyzer();
    /// Movable, not copyable.
    MusicAnalyzer(MusicAnalyzer&&) noexcept;
    /// As above.
    MusicAnalyzer& operator=(MusicAnalyzer&&) noexcept;

    /// Sets everything up and starts a stream. Errors: a sample rate outside 8 to 192 kHz; a genre
    /// model that is not valid, or a window outside 0.5 to 10 s.
    [[nodiscard]] Expected<void> prepare(const AnalyzerConfig& config);

    /// The stream goes on with samples of another rate, from stream time `taken` on: what the
    /// analyzer knows of the music stays, and so do the numbers of the hops. Audio that is lost on
    /// the way counts as skipped. Allocates; while no other function runs. Errors: a rate outside 8
    /// to 192 kHz.
    [[nodiscard]] Expected<void> change_rate(SampleRate rate, StreamTime taken);

    /// Takes the next samples, nominally in [-1, 1]; NaN and infinities count as 0, louder samples
    /// than +-16 are clamped. Hands out the states that became complete: none to many.
    /// Cost: about 22 us a hop, with a genre model 40 to 50; nothing grows with the length of the
    /// stream.
    void process(std::span<const float> mono, Sink& sink) noexcept RAKS_NONBLOCKING;

    /// Queues a command (16 wait at most; more are dropped).
    void command(const AnalyzerCommand& command) noexcept RAKS_NONBLOCKING;

    /// Tells that audio was lost before the next sample: stream time goes on by `lost` (at most 10
    /// s a call). The hops in the gap come out with the next process(), the grid running on; the
    /// first state after it has is_discontinuity, and after more than 200 ms the beat is sought
    /// anew. With 0: a jump to other audio (a seek), the beat is sought anew.
    void skip(Nanos lost) noexcept RAKS_NONBLOCKING;

    /// From now on this is told of the music, in place of what was told before. What was heard so
    /// far stays.
    void tell(const ToldSong& song) noexcept RAKS_NONBLOCKING;

    /// Another song begins with the next sample: beat, bar, form and genre of the one before are
    /// forgotten, as at the start of a file. Stream time and the numbers of hops and beats go on;
    /// so does what a person asked for: commands and a held tempo.
    void begin_song() noexcept RAKS_NONBLOCKING;

    /// Whoever plays the music has paused it: it stops as soon as it is quiet, without waiting
    /// whether that is but a gap in it. Holds for a second.
    void announce_pause() noexcept RAKS_NONBLOCKING;

    /// Back to the state after prepare(). Commands and held tempi are forgotten.
    void reset() noexcept RAKS_NONBLOCKING;

    /// The state of hop n is complete when the samples before time_of_hop(n) + delay() are in.
    [[nodiscard]] Nanos delay() const noexcept;

    /// MFCC-39 (features/mfcc.hpp), running cepstral mean subtracted, at the newest hop: of the
    /// sound MfccHops::kAge before it. All 0 until the first is known, and always where neither a
    /// genre model nor cepstral_mean was given; in a gap the last one stays.
    /// Threads: the owner.
    [[nodiscard]] const MfccVector& mfcc() const noexcept;

    /// Mel magnitudes of the newest hop, not normalized (OnsetDetector). Threads: the owner.
    [[nodiscard]] std::span<const float> mel_magnitudes() const noexcept;

    /// What the beat tracker was given of the newest hop; its mel magnitudes are those above. Empty
    /// with the paper's method. Threads: the owner.
    [[nodiscard]] const TrackedHop& tracked() const noexcept;

    /// What follows the beat, to be asked what its confidence follows from. Threads: the owner.
    [[nodiscard]] const BeatTracker& beats() const noexcept;

    /// What the form tracker heard of the newest hop. Threads: the owner.
    [[nodiscard]] const HopSound& sound() const noexcept;

    /// Who tells the genre, to be asked what its parts heard of the newest hop; null: nobody.
    /// Threads: the owner.
    [[nodiscard]] const GenreRecognizer* genres() const noexcept;

    /// Number of samples that were NaN or infinite since reset(). Threads: the owner.
    [[nodiscard]] std::uint64_t bad_samples() const noexcept;

 private:
    struct State;
    std::unique_ptr<State> state_;
};

}  // namespace raks::audio
