#include "engine/live/planned_states.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

namespace raks::engine {
namespace {

// Smaller changes of the place are rounding of frames to time.
constexpr Nanos kLeastSeek = std::chrono::milliseconds(1);

}  // namespace

void PlannedStates::set_plan(std::shared_ptr<const audio::SongPlan> plan, Beginning beginning) {
    plan_ = std::move(plan);
    beginning_ = beginning;
    active_.store(plan_.get(), std::memory_order_release);  // pairs with the acquire in at()
}

// Of the audio thread's own: nobody else stores here then.
void PlannedStates::follow(const audio::SongPlan& plan,
                           StreamTime stream,
                           Nanos shift) noexcept RAKS_NONBLOCKING {
    set_place(stream, stream + shift);
    if (active_.exchange(&plan, std::memory_order_relaxed) != &plan) {
        is_following_.store(false, std::memory_order_relaxed);  // its beats are numbered anew
    }
}

void PlannedStates::set_place(StreamTime stream, StreamTime place) noexcept RAKS_NONBLOCKING {
    const Nanos shift = place - stream;
    if (std::chrono::abs(shift - shift_) >= kLeastSeek) {
        shift_before_ = std::exchange(shift_, shift);
        shifted_at_ = stream;
    }
}

// Whether the song has come to a bar line at which the plan may begin, since it was there.
bool PlannedStates::begins(const audio::SongPlan& plan, StreamTime place) noexcept {
    if (beginning_ == Beginning::now) {
        return true;
    }
    if (!was_waiting_) {
        was_waiting_ = true;
        waits_from_ = place;
    }
    const auto join = std::upper_bound(plan.joins.begin(), plan.joins.end(), waits_from_);
    return join != plan.joins.end() && *join <= place;
}

// Numbers the plan's beats so that they go on from the last grid's, and that one of its downbeats
// stays one.
void PlannedStates::join(const BeatGrid& next, StreamTime time) noexcept {
    const double apart = (last_.beats_at(time) - next.beats_at(time)).count();
    const double bars_apart = (last_.bar_origin - next.bar_origin).count();
    // The number that is nearest to `apart` of those that lead downbeat to downbeat.
    const double bar = next.beats_per_bar;
    renumbered_ = Beats(bars_apart + bar * std::round((apart - bars_apart) / bar));
}

MusicState PlannedStates::at(const MusicState& found) noexcept RAKS_NONBLOCKING {
    const audio::SongPlan* const plan = active_.load(std::memory_order_acquire);
    // Hops come out some time after their samples went in: the last ones before a seek, too.
    const Nanos shift = found.time < shifted_at_ ? shift_before_ : shift_;
    const StreamTime place = found.time + shift;
    const bool goes_on = is_following() && shift == last_shift_;
    last_shift_ = shift;
    const bool follows = plan != nullptr && !is_led_ && (is_following() || begins(*plan, place));
    is_following_.store(follows, std::memory_order_relaxed);
    if (!follows) {
        last_ = found.grid;
        return found;
    }
    MusicState state = plan->at(place, found.hop);
    if (!goes_on && found.hop > 0) {
        join(state.grid, state.time);
    }
    state.grid.anchor_beat = state.grid.anchor_beat + renumbered_;
    state.grid.bar_origin = state.grid.bar_origin + renumbered_;
    state.is_discontinuity = found.is_discontinuity;
    last_ = state.grid;
    return state;
}

}  // namespace raks::engine
