#pragma once

#include <optional>
#include <string>
#include <string_view>

#include "audio/beat/analyzer_command.hpp"
#include "base/beats.hpp"
#include "base/time.hpp"
#include "engine/control/action_dispatcher.hpp"
#include "engine/live/live_graph.hpp"
#include "motion/dancer.hpp"

namespace raks::engine {

/// What the actions of playing, tempo and dance act upon. The interface exists for tests, which
/// record what was asked instead of running a graph. Threads: main.
class LiveTarget {
 public:
    virtual ~LiveTarget() = default;  ///< a target may be owned by its interface

    /// Queues a command for the beat tracker, dated at the moment of music that leaves the
    /// loudspeaker at `came`. `value`: as its kind says. False: the queue is full.
    virtual bool command(audio::AnalyzerCommand::Kind kind, double value, HostTime came) = 0;
    /// Whether somebody dances.
    [[nodiscard]] virtual bool has_dancers() const = 0;
    /// Queues a command for the dancers, dated when it is called. False: the queue is full, or
    /// nobody dances.
    virtual bool command(motion::DancerCommand::Kind kind, double value) = 0;
    /// The tempo that is danced to.
    [[nodiscard]] virtual Bpm tempo() = 0;

    /// The person's part of the latency between picture and sound; positive: the pictures come
    /// later.
    [[nodiscard]] virtual Nanos latency_offset() = 0;
    /// Sets it; the next picture uses it. The caller keeps it within +-500 ms.
    virtual void set_latency_offset(Nanos offset) = 0;

    /// Whether a file plays; with an input there is nothing to pause, to seek or to make louder.
    [[nodiscard]] virtual bool plays_file() const = 0;
    /// Pauses the file or goes on with it; does nothing when the input is a microphone.
    virtual void toggle_pause() = 0;
    /// Moves the place in the file by so many seconds; does nothing with a microphone.
    virtual void seek_by(double seconds) = 0;
    virtual void set_volume(float volume) = 0;  ///< [0, 2]
};

/// The live graph as a target: every call is passed on to it.
class GraphTarget final : public LiveTarget {
 public:
    /// `graph` must outlive this.
    explicit GraphTarget(LiveGraph& graph) : graph_(graph) {}

    /// To the analyzer's queue.
    bool command(audio::AnalyzerCommand::Kind kind, double value, HostTime came) override;
    [[nodiscard]] bool has_dancers() const override;  ///< of the graph
    /// To the motion thread's queue.
    bool command(motion::DancerCommand::Kind kind, double value) override;
    [[nodiscard]] Bpm tempo() override;              ///< of the newest beat grid
    [[nodiscard]] Nanos latency_offset() override;   ///< of the graph
    void set_latency_offset(Nanos offset) override;  ///< of the graph
    [[nodiscard]] bool plays_file() const override;  ///< whether the graph has a playback
    void toggle_pause() override;                    ///< of the graph's playback, if any
    void seek_by(double seconds) override;           ///< of the graph's playback, if any
    void set_volume(float volume) override;          ///< of the graph's playback, if any

 private:
    LiveGraph& graph_;
};

/// Carries out the actions of playing, tempo and figures: each becomes a command of the live graph
/// or a call to the file that plays. Keeps what outlives a file: volume, latency offset, lock of
/// the figure. Threads: main.
class LiveActions {
 public:
    /// `volume`: [0, 2]. `say` gets a line for what a person cannot see in the picture at once.
    LiveActions(float volume, SayLine say) : say_(std::move(say)), volume_(volume) {}

    /// Actions act upon `target` from here on. It gets the volume and, if an action has changed it,
    /// the latency offset. It must outlive the next attach() or the last dispatch.
    void attach(LiveTarget& target);
    /// The target is gone: until the next one nobody is asked for anything.
    void detach() noexcept { target_ = nullptr; }
    /// Registers these actions with `actions`, those of a file where the target plays one, those of
    /// dancers where it has some: attach() comes before. This object must not be moved afterwards.
    void bind(ActionDispatcher& actions);
    /// Tells dancers who have just replaced others what was asked of those (the lock of the
    /// figure).
    void brief_dancers();

    /// Asks the dancers of the target, if there is one; says so where too much was asked at once.
    void ask(motion::DancerCommand::Kind kind, double value);

    /// Whether the dancers are to keep to their figure.
    [[nodiscard]] bool keeps_figure() const noexcept { return keeps_figure_; }
    /// The volume that is set, [0, 2].
    [[nodiscard]] float volume() const noexcept { return volume_; }

 private:
    struct Entry;
    static std::span<const Entry> entries() noexcept;

    void pause(double);
    void seek(double seconds);
    void change_volume(double by);
    void change_latency(double milliseconds);
    void tap_tempo(double);
    void half_tempo(double);
    void double_tempo(double);
    void three_two(double);
    void change_tempo(double bpm);
    void set_tempo(double bpm);
    void hold_at(Bpm tempo);
    void hold_tempo(double);
    void release_tempo(double);
    void nudge_beats(double milliseconds);
    void resync_bar(double);
    void next_figure(double);
    void select_figure(double number);
    void keep_figure(double);

    bool command(audio::AnalyzerCommand::Kind kind, double value = 0.0);
    bool command(motion::DancerCommand::Kind kind, double value = 0.0);
    bool said_unless(bool is_queued);

    SayLine say_;
    LiveTarget* target_ = nullptr;
    HostTime came_{};  // the request that is carried out
    float volume_;
    std::optional<Nanos> latency_offset_;  // as last set by an action
    std::optional<Bpm> wished_tempo_;      // on its way to the tracker, or held there
    double nudged_milliseconds_ = 0.0;     // of this target, in all
    bool keeps_figure_ = false;
};

/// What is said of the dance that a person chose, which dances already or comes next; of an empty
/// name: the one that is heard. Threads: any.
[[nodiscard]] std::string chosen_dance_line(std::string_view dance, bool is_danced_already);

}  // namespace raks::engine
