#pragma once

#include <array>
#include <atomic>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <span>
#include <vector>

#include "audio/io/stream_callback.hpp"
#include "audio/music_analyzer.hpp"
#include "base/channels/event_queue.hpp"
#include "base/channels/latest_value.hpp"
#include "base/expected.hpp"
#include "base/music_state.hpp"
#include "base/realtime.hpp"
#include "engine/live/clock_map.hpp"
#include "engine/live/music_feed.hpp"
#include "engine/live/planned_states.hpp"
#include "engine/live/sound_tap.hpp"
#include "engine/live/timing.hpp"
#include "engine/setup/analyzer_setup.hpp"

namespace raks::engine {

/// What is known of the song beside its sound, from who plays it. Each holds from the next block
/// on.
struct SongNews {
    /// What has happened.
    enum class Kind : std::uint8_t {
        told,     ///< `song` is known of what plays: MusicAnalyzer::tell()
        begins,   ///< another song begins, of which `song` is known: MusicAnalyzer::begin_song()
        jump,     ///< the same song goes on elsewhere: MusicAnalyzer::skip() with 0
        pause,    ///< MusicAnalyzer::announce_pause()
        known,    ///< the song is one with `plan`: PlannedStates::follow()
        unknown,  ///< it is not any more: PlannedStates::leave()
    };
    Kind kind = Kind::told;                 ///< see Kind
    audio::ToldSong song{};                 ///< of `told` and `begins`
    const audio::SongPlan* plan = nullptr;  ///< of `known`: see LiveGraph::follow_song()
    Nanos shift{};                          ///< of `known`: place in the song minus stream time
};

/// The work of every audio callback, whatever device or clock calls it: analyzes the samples, hands
/// the music states to the motion thread and keeps the clock that relates stream time to host time.
///
/// Threads: what is marked *audio* only from the callback, the rest from main.
class AnalysisStage {
 public:
    /// States wait here for the motion thread: 5 s deep, so that a stall loses nothing.
    static constexpr std::size_t kQueuedStates = 512;

    /// Errors: a rate that the analyzer refuses.
    [[nodiscard]] static Expected<std::unique_ptr<AnalysisStage>> create(
        SampleRate rate, const AnalyzerModels& models);

    /// *audio* Takes the next block of mono samples. Real-time: yes.
    void analyze(std::span<const float> mono) noexcept RAKS_NONBLOCKING;

    /// *audio* The same sound with all its channels, before analyze() takes it, for who keeps it.
    /// Real-time: yes.
    void pass_on(std::span<const float> interleaved,
                 std::size_t channels) noexcept RAKS_NONBLOCKING;
    /// Who listens to the sound that passes.
    enum class Listener : std::uint8_t { recording, known_song };
    /// Who keeps it, from now on; null: nobody. It must outlive this object, or the next call.
    void set_tap(Listener listener, SoundTap* tap) noexcept {
        taps_[static_cast<std::size_t>(listener)].store(tap, std::memory_order_release);
    }

    /// *audio* The sample of stream time `stream` passed the device at `host` (CLOCK_MONOTONIC).
    /// Real-time: yes.
    void mark_clock(StreamTime stream, HostTime host) noexcept RAKS_NONBLOCKING;

    /// *audio* The device flagged an xrun: see ClockMap::loosen(). Real-time: yes.
    void loosen_clock() noexcept RAKS_NONBLOCKING { clock_map_.loosen(); }

    /// *audio* Samples were lost before the next block: stream time skips them. Real-time: yes.
    void skip(std::int64_t frames) noexcept RAKS_NONBLOCKING;

    /// *audio* One hop (10 ms) passes without sound being known: the grid runs on. Real-time: yes.
    void pass_blind_hop() noexcept RAKS_NONBLOCKING;

    /// Samples have another rate from here on; stream time goes on. Threads: main, while no
    /// callback runs. Errors: a rate that the analyzer refuses.
    [[nodiscard]] Expected<void> change_rate(SampleRate rate);

    /// *audio* Stream time stands still at `stream` (pause). Real-time: yes.
    void stop_clock(StreamTime stream) noexcept RAKS_NONBLOCKING;

    /// *audio* Counts how long the work of one block took. Real-time: yes.
    void add_callback_time(Nanos span) noexcept RAKS_NONBLOCKING { callback_times_.add(span); }

    /// Queues a command for the analyzer; false when the queue is full.
    bool command(const audio::AnalyzerCommand& command) noexcept { return commands_.push(command); }

    /// Queues what is known of the song; false when the queue is full.
    bool tell(const SongNews& news) noexcept { return news_.push(news); }

    /// The clock as of the newest block. Threads: main only (one reader).
    [[nodiscard]] const ClockLine& clock() noexcept { return clock_line_.read(); }

    /// What a reader on a thread of its own is told; it may outlive this.
    [[nodiscard]] const std::shared_ptr<MusicFeed>& feed() const noexcept { return feed_; }

    /// Nobody dances: the feed is told the states by the audio thread. They wait in states() all
    /// the same. Threads: main, while no callback runs.
    void tell_feed() noexcept { queue_.tell(feed_.get()); }

    /// The states of a song that is known before it sounds, in place of those that are found.
    [[nodiscard]] PlannedStates& planned() noexcept { return planned_; }

    /// Sample rate of the analyzed samples.
    [[nodiscard]] SampleRate rate() const noexcept { return rate_; }
    /// The queue of states, one a hop; the motion thread is its one consumer.
    [[nodiscard]] EventQueue<MusicState>& states() noexcept { return states_; }
    /// Latency of the analyzer: a state is complete this long after its time. See MusicAnalyzer.
    [[nodiscard]] Nanos delay() const noexcept { return analyzer_.delay(); }
    /// What add_callback_time counted. Threads: any.
    [[nodiscard]] const TimingHistogram& callback_times() const noexcept { return callback_times_; }
    /// Level for a meter: RMS of a block in dBFS; rises at once and falls slowly, also where no
    /// block comes any more. Threads: any.
    [[nodiscard]] float level_dbfs(HostTime now) const noexcept RAKS_NONBLOCKING;
    /// Stream time up to which samples were taken. Threads: any.
    [[nodiscard]] StreamTime taken_until() const noexcept RAKS_NONBLOCKING;

 private:
    class Queue final : public audio::MusicAnalyzer::Sink {
     public:
        Queue(EventQueue<MusicState>& states, PlannedStates& planned)
            : states_(states), planned_(planned) {}
        void on_state(const MusicState& state) noexcept RAKS_NONBLOCKING override {
            const MusicState told = planned_.at(state);
            states_.push(told);
            if (feed_ != nullptr) {
                feed_->tell({told, {}});
            }
        }
        void tell(MusicFeed* feed) noexcept { feed_ = feed; }

     private:
        EventQueue<MusicState>& states_;
        PlannedStates& planned_;
        MusicFeed* feed_ = nullptr;  // null: another tells it
    };

    AnalysisStage(SampleRate rate, audio::MusicAnalyzer analyzer);
    void run_commands() noexcept;
    void take_news() noexcept;
    void publish_clock() noexcept;

    SampleRate rate_;
    StreamTime blind_until_{};  // of the blind hops so far; audio thread's own
    audio::MusicAnalyzer analyzer_;
    EventQueue<MusicState> states_{kQueuedStates};
    PlannedStates planned_;
    Queue queue_{states_, planned_};
    EventQueue<audio::AnalyzerCommand> commands_{64};
    EventQueue<SongNews> news_{16};
    ClockMap clock_map_;
    LatestValue<ClockLine> clock_line_;
    std::shared_ptr<MusicFeed> feed_ = std::make_shared<MusicFeed>();
    TimingHistogram callback_times_;
    std::array<std::atomic<SoundTap*>, 2> taps_{};  // by Listener
    std::atomic<std::int64_t> frames_taken_{0};
    std::atomic<float> level_dbfs_{-120.0F};  // at level_at_ns_
    std::atomic<std::int64_t> level_at_ns_{0};
};

}  // namespace raks::engine
