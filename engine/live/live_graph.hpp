#pragma once

#include <array>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "audio/io/device_stream.hpp"
#include "audio/io/devices.hpp"
#include "audio/io/file_player.hpp"
#include "base/expected.hpp"
#include "base/time.hpp"
#include "engine/live/analysis_stage.hpp"
#include "engine/live/device_keeper.hpp"
#include "engine/live/live_input.hpp"
#include "engine/live/motion_stage.hpp"
#include "engine/live/paced_clock.hpp"
#include "engine/live/playback.hpp"
#include "engine/live/sleep_watch.hpp"
#include "engine/setup/analyzer_setup.hpp"
#include "engine/setup/dancers.hpp"
#include "engine/setup/device_offsets.hpp"
#include "motion/dancer.hpp"
#include "motion/ensemble.hpp"

namespace raks::engine {

/// What `play` and `live` both need to start.
struct LiveGraphConfig {
    AnalyzerModels models;  ///< beat network, genre model and list of dances
    Cast cast;  ///< the dancers, their repertoires and bodies; listen(): none, and nobody dances
    /// play(): nothing sounds until Playback::let_go(), e.g. as a plan will come soon.
    bool is_held_back = false;
    Nanos latency_offset{};        ///< the user's, added to what the device reports
    DeviceOffsets offsets = {};    ///< the same of each device, as calibrated
    bool is_device_named = false;  ///< the person chose the device: the default is not followed
    double buffer_seconds = 0.0;   ///< of the device, as the person wishes; 0: its own, and growing
    Nanos pose_lead{};             ///< pictures show the pose this much ahead of the sound
    /// Readers of the stage besides the main thread, each on a thread of its own; they must outlive
    /// the graph.
    std::vector<StageChannel*> readers = {};
    EventQueue<DancedHop>* record = nullptr;  ///< gets every danced hop; null: nobody records
};

/// A loudspeaker that runs and is looked after: what one song leaves to the next, so that its
/// buffer stays as long as it has grown, and its sound where a person or the desktop has sent it.
struct OpenLoudspeaker {
    audio::AudioDevice device;                    ///< which one it is now
    std::unique_ptr<audio::DeviceStream> stream;  ///< silent meanwhile
    std::unique_ptr<DeviceKeeper> keeper;         ///< may hold a stream that is to take over
};

/// Counters of lost data, for the overlay and the benchmarks.
struct LiveCounters {
    std::uint64_t dropped_states = 0;  ///< the motion thread was too slow
    std::uint64_t xruns = 0;           ///< blocks that the device flagged
    std::uint64_t underruns = 0;       ///< the decoder was too slow
};

/// The live graph: device -> analyzer -> dancer -> newest stage, each on its thread. It only
/// connects them; it decides nothing about music or motion.
///
/// Threads: main for all methods.
class LiveGraph {
 public:
    /// Plays one file on `output`; without one, paced by our own clock and without sound. `open`:
    /// what the song before left, which is played on instead of opening `output`. Errors: the
    /// device or the resampler refuses, the analyzer refuses the rate, a dancer cannot be prepared;
    /// `open` is closed then.
    [[nodiscard]] static Expected<std::unique_ptr<LiveGraph>> play(
        std::unique_ptr<audio::FilePlayer> player,
        const std::optional<audio::AudioDevice>& output,
        const LiveGraphConfig& config,
        std::optional<OpenLoudspeaker> open = {});

    /// Dances to the sound of `input`. Errors: as play().
    [[nodiscard]] static Expected<std::unique_ptr<LiveGraph>> listen(
        const audio::AudioDevice& input, const LiveGraphConfig& config);

    /// Not copied or moved: its threads and callbacks hold references into it.
    LiveGraph(const LiveGraph&) = delete;
    LiveGraph& operator=(const LiveGraph&) = delete;  ///< likewise

    /// Looks after the device; call it with every picture. Returns lines for the person about what
    /// happened: the default changed and was followed, the server moved the sound, the device went
    /// or came back. While it is gone `play` pauses where it is, and `live` goes on by our own
    /// clock.
    [[nodiscard]] std::vector<std::string> watch(HostTime now);
    /// True while the device is gone.
    [[nodiscard]] bool has_lost_device() const noexcept { return has_lost_device_; }
    /// What is wrong with the device for as long as it lasts, one line of those of watch(): it is
    /// gone, or the JACK client that is listened to has left. Empty when nothing is.
    [[nodiscard]] const std::string& trouble() const noexcept { return trouble_; }
    /// The device that sounds or is listened to now, or did last. Without one: a nameless one.
    [[nodiscard]] const audio::AudioDevice& device() const noexcept { return device_; }
    /// Gives the loudspeaker away for the next song, the last thing to do with this graph: it
    /// stands still. Nothing where none runs.
    [[nodiscard]] std::optional<OpenLoudspeaker> leave_loudspeaker();
    /// Whether all of the file has left the loudspeaker; false in `live`. Calls after the end tell
    /// how long ago that was: call it with every picture.
    [[nodiscard]] bool is_played_out(HostTime now) noexcept;

    /// The host time at which stream time `t` is heard: in `play` when it leaves the loudspeaker;
    /// with a microphone or line-in when it was captured; with a monitor when the loudspeaker that
    /// it belongs to plays it, as the server reports. The offsets of heard_after() are added.
    [[nodiscard]] HostTime heard_at(StreamTime t) noexcept;
    /// The moment of the music that a picture seen at `seen_at` must show: what is heard then (the
    /// inverse of heard_at()), later by the pose lead.
    [[nodiscard]] StreamTime moment_at(HostTime seen_at) noexcept;

    /// The moment of the music that passes the sound server at `host`: what others record there
    /// then. Nobody's offsets count. Without a device: what is heard.
    [[nodiscard]] StreamTime passing_at(HostTime host) noexcept;

    /// What the music says, and when it is heard, for one reader on another thread.
    [[nodiscard]] const std::shared_ptr<MusicFeed>& feed() const noexcept {
        return analysis_->feed();
    }

    /// What the analysis found last; for main, where nobody dances.
    [[nodiscard]] const MusicState& newest_music() noexcept;

    /// The newest stage that the motion thread published; somebody dances. Threads: main only (one
    /// reader).
    [[nodiscard]] const StageState& stage() noexcept { return for_main_->read(); }
    /// How long after its block is handed over, or came in, the sound is heard: as the device
    /// reports it (DeviceStream::heard_after), the offset calibrated for it and the person's.
    [[nodiscard]] Nanos heard_after() const noexcept;
    /// The person's part of it; a change moves the pictures at once. At the start it is the
    /// configuration's where there is a device, else 0.
    [[nodiscard]] Nanos latency_offset() const noexcept { return latency_offset_; }
    /// Sets it, in either direction; nothing is clamped here.
    void set_latency_offset(Nanos offset) noexcept { latency_offset_ = offset; }
    /// What was lost so far, since the start.
    [[nodiscard]] LiveCounters counters() const noexcept;

    /// The device's stream; null while our own clock drives.
    [[nodiscard]] const audio::DeviceStream* stream() const noexcept { return stream_.get(); }
    /// The stage that the audio callback works on.
    [[nodiscard]] AnalysisStage& analysis() noexcept { return *analysis_; }
    /// The thread that dances; somebody does.
    [[nodiscard]] MotionThread& motion() noexcept { return *motion_; }
    /// The file's playback; null in `live`.
    [[nodiscard]] Playback* playback() noexcept { return playback_.get(); }

    /// Queues a command for the analyzer, dated at the moment that was seen at `came`. False: the
    /// queue is full.
    [[nodiscard]] bool command(audio::AnalyzerCommand::Kind kind,
                               double value = 0.0,
                               HostTime came = HostClock::now()) noexcept;
    /// Queues what is known of the song that an input hears. False: the queue is full.
    bool tell(const SongNews& news) noexcept { return analysis_->tell(news); }
    /// Whether an input is heard, and no file is played.
    [[nodiscard]] bool is_input() const noexcept { return live_input_ != nullptr; }
    /// Whether somebody dances.
    [[nodiscard]] bool has_dancers() const noexcept { return motion_ != nullptr; }
    /// The same for the dancers, dated when it is called; false, too, where nobody dances.
    [[nodiscard]] bool command(motion::DancerCommand::Kind kind, double value = 0.0) noexcept;

    /// The plan of the song that plays came to hand: it is followed from now on, where nothing has
    /// sounded yet, or from a bar line on, see PlannedStates. At most once.
    void follow(std::shared_ptr<const audio::SongPlan> plan, PlannedStates::Beginning beginning) {
        analysis_->planned().set_plan(std::move(plan), beginning);
    }

    /// The input hears a song with this plan, whose places are `shift` after the stream's time;
    /// null: it does not any more. False: the queue is full.
    bool follow_song(std::shared_ptr<const audio::SongPlan> plan, Nanos shift);

    /// Other dancers take over at once. Errors: those of Ensemble::prepare; the queue of orders is
    /// full.
    [[nodiscard]] Expected<void> replace_dancers(
        const Cast& cast, MotionStage::Entry entry = MotionStage::Entry::anew);

 private:
    LiveGraph() = default;
    [[nodiscard]] Expected<void> start_motion(const LiveGraphConfig& config);
    [[nodiscard]] Expected<void> open_stream(audio::DeviceStream::Direction direction,
                                             const audio::AudioDevice& device,
                                             const LiveGraphConfig& config);
    void use(OpenLoudspeaker opened, const LiveGraphConfig& config);
    [[nodiscard]] audio::StreamCallback& callback() noexcept;
    [[nodiscard]] std::string about(const audio::AudioDevice& device, const char* how) const;
    void set_device(const audio::AudioDevice& device);
    void take_events(std::vector<std::string>& lines);
    void lose_device(std::vector<std::string>& lines);
    void take_news(std::vector<std::string>& lines);
    void take_over(DeviceKeeper::News& news, std::vector<std::string>& lines);
    void watch_silence(HostTime now);
    void publish_delay() noexcept;

    audio::AudioDevice device_;  // the one that runs, or ran last
    Nanos last_heard_after_{};   // while the device is gone
    DeviceOffsets offsets_;
    Nanos device_offset_{};  // of device_
    Nanos latency_offset_{};
    Nanos pose_lead_{};
    bool has_lost_device_ = false;
    std::string trouble_;
    bool has_said_growth_ = false;
    std::uint64_t xruns_before_ = 0;   // of the stream, in songs before
    bool has_said_elsewhere_ = false;  // since there was sound last
    HostTime heard_last_{};            // `live`: when there was sound, or a look around
    std::optional<HostTime> finished_;
    SleepWatch sleep_watch_;
    // Order matters: what calls is destroyed before what is called.
    std::unique_ptr<Playback> playback_;
    std::unique_ptr<LiveInput> live_input_;
    AnalysisStage* analysis_ = nullptr;  // of playback_ or live_input_
    MusicState newest_music_;            // where nobody dances
    // The last plans of follow_song(): the audio thread may not have taken the newest yet.
    std::array<std::shared_ptr<const audio::SongPlan>, 4> heard_plans_;
    std::unique_ptr<StageChannel> for_main_;
    std::unique_ptr<MotionThread> motion_;  // null: nobody dances
    std::unique_ptr<PacedClock> paced_clock_;
    std::unique_ptr<audio::DeviceStream> stream_;
    std::unique_ptr<DeviceKeeper> keeper_;  // may hold a stream that was connected
};

}  // namespace raks::engine
