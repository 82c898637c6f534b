#pragma once

#include <atomic>
#include <memory>
#include <optional>
#include <string>
#include <thread>
#include <vector>

#include "audio/io/device_stream.hpp"
#include "audio/io/devices.hpp"
#include "audio/io/file_player.hpp"
#include "base/expected.hpp"
#include "base/time.hpp"
#include "engine/live/analysis_stage.hpp"
#include "engine/live/motion_stage.hpp"
#include "engine/live/playback.hpp"
#include "engine/setup/analyzer_setup.hpp"
#include "engine/setup/dance_files.hpp"
#include "motion/dancer.hpp"
#include "motion/ensemble.hpp"

namespace raks::engine {

/// Our own clock in place of a device: calls a stream callback every 256 frames' time by
/// CLOCK_MONOTONIC. Drives `--no-sound`, and the rest of a show whose device has died. An input
/// gets silence; what an output fills is thrown away. Threads: create and destroy on main; the
/// callback runs on the clock's own thread.
class PacedClock {
 public:
    /// Which of the callback's two functions is called.
    enum class Direction { input, output };

    /// Starts calling `callback`, which must outlive this, with blocks of `channels` at `rate`.
    PacedClock(Direction direction, SampleRate rate, int channels, audio::StreamCallback& callback);
    ~PacedClock();  ///< stops the calls and joins the thread
    /// Not copied: the thread holds a reference to it.
    PacedClock(const PacedClock&) = delete;
    PacedClock& operator=(const PacedClock&) = delete;  ///< likewise

 private:
    void run(Direction direction, SampleRate rate, int channels) noexcept;

    audio::StreamCallback& callback_;
    std::atomic<bool> is_stopping_{false};
    std::thread thread_;
};

/// What `play` and `live` both need to start.
struct LiveGraphConfig {
    AnalyzerModels models;  ///< beat network, genre model and list of dances
    Cast cast;              ///< the dancers, their repertoires and skeleton
    /// The song that play() plays, where it is known already; null: it is analyzed as it comes.
    std::shared_ptr<const audio::SongPlan> plan = nullptr;
    /// play(): nothing sounds until Playback::let_go(), e.g. as a plan will come soon.
    bool is_held_back = false;
    Nanos latency_offset{};  ///< the user's, added to what the device reports
    Nanos pose_lead{};       ///< pictures show the pose this much ahead of the sound
    /// Readers of the stage besides the main thread, each on a thread of its own; they must outlive
    /// the graph.
    std::vector<StageChannel*> readers = {};
    EventQueue<DancedHop>* record = nullptr;  ///< gets every danced hop; null: nobody records
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
    /// Plays one file on `output`; without one, paced by our own clock and without sound. Errors:
    /// the device or the resampler refuses, the analyzer refuses the rate, a dancer cannot be
    /// prepared.
    [[nodiscard]] static Expected<std::unique_ptr<LiveGraph>> play(
        std::unique_ptr<audio::FilePlayer> player,
        const std::optional<audio::AudioDevice>& output,
        const LiveGraphConfig& config);

    /// Dances to the sound of `input`. Errors: as play().
    [[nodiscard]] static Expected<std::unique_ptr<LiveGraph>> listen(
        const audio::AudioDevice& input, const LiveGraphConfig& config);

    /// Not copied or moved: its threads and callbacks hold references into it.
    LiveGraph(const LiveGraph&) = delete;
    LiveGraph& operator=(const LiveGraph&) = delete;  ///< likewise

    /// Checks the device; call it with every picture. When the device has died, the graph goes on
    /// by its own clock, and the one line for the person is returned, once.
    [[nodiscard]] std::optional<std::string> watch(HostTime now);
    /// True from the moment that watch() found the device dead.
    [[nodiscard]] bool has_lost_device() const noexcept { return has_lost_device_; }

    /// The moment of the music that a picture seen at `seen_at` must show: what leaves the
    /// loudspeaker then, or with an input what sounds then; later by the pose lead.
    [[nodiscard]] StreamTime moment_at(HostTime seen_at) noexcept;

    /// The newest stage that the motion thread published. Threads: main only (one reader).
    [[nodiscard]] const StageState& stage() noexcept { return for_main_->read(); }
    /// Latency between our block and the loudspeaker, the user's offset included.
    [[nodiscard]] Nanos output_latency() const noexcept {
        return reported_latency_ + latency_offset_;
    }
    /// The person's part of it; a change moves the pictures at once. At the start it is the
    /// configuration's where a device plays, else 0; it is 0 again when the device has died.
    [[nodiscard]] Nanos latency_offset() const noexcept { return latency_offset_; }
    /// Sets it, in either direction; nothing is clamped here.
    void set_latency_offset(Nanos offset) noexcept { latency_offset_ = offset; }
    /// What was lost so far, since the start.
    [[nodiscard]] LiveCounters counters() const noexcept;

    /// The device's stream; null while our own clock drives.
    [[nodiscard]] const audio::DeviceStream* stream() const noexcept { return stream_.get(); }
    /// The stage that the audio callback works on.
    [[nodiscard]] AnalysisStage& analysis() noexcept { return *analysis_; }
    /// The thread that dances.
    [[nodiscard]] MotionThread& motion() noexcept { return *motion_; }
    /// The file's playback; null in `live`.
    [[nodiscard]] Playback* playback() noexcept { return playback_.get(); }

    /// Queues a command for the analyzer, dated at the moment that is seen when it is called.
    /// False: the queue is full.
    bool command(audio::AnalyzerCommand::Kind kind, double value = 0.0) noexcept;
    /// The same for the dancers.
    bool command(motion::DancerCommand::Kind kind, double value = 0.0) noexcept;

    /// The plan of the song that plays came to hand: it is followed from now on, where nothing has
    /// sounded yet, or from a bar line on, see PlannedStates. At most once, and not where play()
    /// was given one.
    void follow(std::shared_ptr<const audio::SongPlan> plan, PlannedStates::Beginning beginning) {
        analysis_->planned().set_plan(std::move(plan), beginning);
    }

    /// Other dancers take over at once, from standing. Errors: those of Ensemble::prepare; the
    /// queue of orders is full.
    [[nodiscard]] Expected<void> replace_dancers(const Cast& cast);

 private:
    LiveGraph() = default;
    [[nodiscard]] Expected<void> start_motion(const LiveGraphConfig& config);
    [[nodiscard]] audio::StreamCallback& callback() noexcept;
    void go_on_without_device();

    std::string device_name_;
    Nanos reported_latency_{};
    Nanos latency_offset_{};
    Nanos pose_lead_{};
    bool has_lost_device_ = false;
    // Order matters: what calls is destroyed before what is called.
    std::unique_ptr<Playback> playback_;
    std::unique_ptr<LiveInput> live_input_;
    AnalysisStage* analysis_ = nullptr;  // of playback_ or live_input_
    std::unique_ptr<StageChannel> for_main_;
    std::unique_ptr<MotionThread> motion_;
    std::unique_ptr<PacedClock> paced_clock_;
    std::unique_ptr<audio::DeviceStream> stream_;
};

}  // namespace raks::engine
