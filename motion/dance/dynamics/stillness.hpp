// Stillness: the dance comes to rest in one of its own postures, and waits there.
#pragma once

#include <optional>

#include "base/beats.hpp"
#include "base/realtime.hpp"
#include "base/time.hpp"
#include "motion/skeleton/pose.hpp"

namespace raks::motion {

/// Stops the dance in a posture that it would have come through: its clock slows down and stands
/// still there. The dance itself goes on unseen, so that it is in time when it is shown
/// again. Threads: one. Real-time: yes.
class Stillness {
 public:
    /// Begins to slow down at `now`, when the dance shows `phase` and goes on by `rate` beats a
    /// second; it stands at `key`, which is later.
    void begin(StreamTime now, Beats phase, double rate, Beats key) noexcept RAKS_NONBLOCKING;
    /// The same, to stand at a moment that is given: the clock slows down smoothly. `key` is
    /// farther than a third of what would be danced until then, and not so far as that.
    void begin(StreamTime now, Beats phase, double rate, Beats key, StreamTime stands) noexcept
        RAKS_NONBLOCKING;
    /// The dance is shown again.
    void end() noexcept { is_on_ = false; }
    /// Forgets everything.
    void reset() noexcept { *this = Stillness(); }

    /// From begin() to end().
    [[nodiscard]] bool is_on() const noexcept { return is_on_; }
    /// Seconds since begin().
    [[nodiscard]] double seconds_on(StreamTime time) const noexcept {
        return to_seconds(time - began_);
    }
    /// Whether it has come to rest.
    [[nodiscard]] bool is_at_rest(StreamTime time) const noexcept RAKS_NONBLOCKING;
    /// Seconds since it has come to rest; negative: before.
    [[nodiscard]] double seconds_at_rest(StreamTime time) const noexcept RAKS_NONBLOCKING;
    /// The phase shown.
    [[nodiscard]] Beats phase(StreamTime time) const noexcept RAKS_NONBLOCKING;

    /// The posture at rest, once it is kept.
    [[nodiscard]] const std::optional<Pose>& posture() const noexcept { return posture_; }
    /// Keeps the posture at rest: the dance forgets figures that are over.
    void keep(const Pose& posture) noexcept { posture_ = posture; }

 private:
    bool is_on_ = false;
    StreamTime began_{};
    Beats from_{};
    Beats key_{};
    double rate_ = 2.0;     // beats a second
    double seconds_ = 0.0;  // that it slows down
    std::optional<Pose> posture_;
};

}  // namespace raks::motion
