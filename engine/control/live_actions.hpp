#pragma once

#include <optional>

#include "base/beats.hpp"
#include "base/time.hpp"
#include "engine/control/action_dispatcher.hpp"
#include "engine/control/live_target.hpp"

namespace raks::engine {

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
    /// Registers these actions with `actions`. This object must not be moved afterwards.
    void bind(ActionDispatcher& actions);
    /// Tells dancers who have just replaced others what was asked of those (the lock of the
    /// figure).
    void brief_dancers();

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
    void change_tempo(double bpm);
    void hold_tempo(double);
    void release_tempo(double);
    void nudge_beats(double milliseconds);
    void resync_bar(double);
    void next_figure(double);
    void select_figure(double number);
    void keep_figure(double);

    template <typename Kind>
    bool command(Kind kind, double value = 0.0);

    SayLine say_;
    LiveTarget* target_ = nullptr;
    float volume_;
    std::optional<Nanos> latency_offset_;  // as last set by an action
    std::optional<Bpm> wished_tempo_;      // on its way to the tracker, or held there
    double nudged_milliseconds_ = 0.0;     // of this target, in all
    bool keeps_figure_ = false;
};

}  // namespace raks::engine
