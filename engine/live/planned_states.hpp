#pragma once

#include <atomic>
#include <memory>

#include "audio/song/song_plan.hpp"
#include "base/music_state.hpp"
#include "base/realtime.hpp"
#include "base/time.hpp"

namespace raks::engine {

/// Puts the states of a song's plan in the place of those that the stream's analysis finds, from
/// the first hop on or, where the plan comes later, from the next of SongPlan::joins. Beat numbers
/// go on, and downbeats stay downbeats, where the plan begins and after a seek.
///
/// An input hears one song after the other: whoever knows which one, and where in it, says so by
/// follow() and leave().
///
/// Threads: set_plan from main; what is marked *audio* from the audio callback.
class PlannedStates {
 public:
    /// When a plan is followed.
    enum class Beginning {
        now,          ///< at the next hop
        on_bar_line,  ///< when the song comes to one of SongPlan::joins
    };

    /// Follows this plan, not null, from here on. At most once in the life of this object.
    void set_plan(std::shared_ptr<const audio::SongPlan> plan, Beginning beginning);

    /// *audio* The stream is a song with this plan, whose places are `shift` after the stream's
    /// time. It must outlive this, or the next follow() or leave(). Not together with set_plan().
    /// Real-time: yes.
    void follow(const audio::SongPlan& plan,
                StreamTime stream,
                Nanos shift) noexcept RAKS_NONBLOCKING;
    /// *audio* It is not any more: what is found counts again. Real-time: yes.
    void leave() noexcept RAKS_NONBLOCKING { active_.store(nullptr, std::memory_order_relaxed); }

    /// *audio* The next sample, at stream time `stream`, is that at `place` of the song.
    /// Real-time: yes.
    void set_place(StreamTime stream, StreamTime place) noexcept RAKS_NONBLOCKING;

    /// *audio* The state for the dancers at this hop: the plan's, or `found` itself while none is
    /// followed. Real-time: yes.
    [[nodiscard]] MusicState at(const MusicState& found) noexcept RAKS_NONBLOCKING;

    /// *audio* A person leads the beats: the analysis is followed, which has heard the command;
    /// false: the plan again. Real-time: yes.
    void let_person_lead(bool leads) noexcept RAKS_NONBLOCKING { is_led_ = leads; }

    /// Whether the last state was the plan's. Threads: any.
    [[nodiscard]] bool is_following() const noexcept {
        return is_following_.load(std::memory_order_relaxed);  // relaxed: for display
    }

 private:
    [[nodiscard]] bool begins(const audio::SongPlan& plan, StreamTime place) noexcept;
    void join(const BeatGrid& next, StreamTime time) noexcept;

    std::shared_ptr<const audio::SongPlan> plan_;  // keeps alive what active_ points to
    std::atomic<const audio::SongPlan*> active_{nullptr};
    Beginning beginning_ = Beginning::now;

    // Of the audio thread.
    Nanos shift_{};             // place minus stream time
    Nanos shift_before_{};      // the same before the last seek
    StreamTime shifted_at_{};   // stream time of the last seek
    bool is_led_ = false;       // by a person
    bool was_waiting_ = false;  // for a bar line
    StreamTime waits_from_{};   // place at which that began
    Nanos last_shift_{};        // at the last hop
    Beats renumbered_{};        // added to the plan's beat numbers
    BeatGrid last_;             // the grid of the last hop
    std::atomic<bool> is_following_{false};
};

}  // namespace raks::engine
