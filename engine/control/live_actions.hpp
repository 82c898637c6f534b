#pragma once

#include <optional>

#include "base/beats.hpp"
#include "base/time.hpp"
#include "engine/control/action_dispatcher.hpp"
#include "engine/control/live_target.hpp"

namespace raks::engine {

/// Does the actions of playing, tempo and figures: each becomes a command of the graph or a word to
/// the file that plays. Keeps what outlives a file: the volume, the latency offset.
/// Threads: main.
class LiveActions {
 public:
    /// `volume`: [0, 2]. `say` gets a line where a picture does not show at once what was done.
    LiveActions(float volume, SayLine say) : say_(std::move(say)), volume_(volume) {}

    /// From here on `target` is what is acted upon. It gets the volume and, once it was changed by
    /// an action, the latency offset. It must outlive the next attach(), or the last dispatch.
    void attach(LiveTarget& target);
    /// Makes these actions part of what `actions` does. This must then stay where it is.
    void bind(ActionDispatcher& actions);
    /// To dancers who have just taken over: what was asked of those before them.
    void brief_dancers();

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
