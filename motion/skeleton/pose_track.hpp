// Pose track: the poses that the dancer publishes.
#pragma once

#include <array>
#include <type_traits>

#include "base/realtime.hpp"
#include "base/time.hpp"
#include "motion/skeleton/feeling.hpp"
#include "motion/skeleton/pose.hpp"

namespace raks::motion {

/// The dancer's output: one pose every 10 ms, of which the last 0.6 s are final and the next 0.2 s
/// predicted (renewed every hop). Rendering reads it at the moment when a frame will be seen: in
/// the past in `play`, now or a little ahead with a microphone.
///
/// A trivially copyable value (about 70 kB), so it passes through LatestValue<PoseTrack>. Threads:
/// one at a time. Real-time: yes.
class PoseTrack {
 public:
    static constexpr int kFinalPoses = 60;      ///< hops that are kept
    static constexpr int kPredictedPoses = 20;  ///< hops ahead

    /// Empties the track.
    void clear() noexcept {
        newest_final_ = -1;
        predicted_ = 0;
    }

    /// Appends the final pose of the hop after the newest one (or of any hop when empty) and drops
    /// all predicted ones. `feeling`: of the dancer at that hop. Real-time: yes.
    void append_final(HopIndex hop,
                      const Pose& pose,
                      const Feeling& feeling = {}) noexcept RAKS_NONBLOCKING;

    /// Sets the predicted pose of hop newest_final() + ahead, ahead = 1..kPredictedPoses, in
    /// order. Real-time: yes.
    void set_predicted(int ahead, const Pose& pose) noexcept RAKS_NONBLOCKING;

    /// Replaces a pose of the track, final or predicted. Real-time: yes.
    void replace(HopIndex hop, const Pose& pose) noexcept RAKS_NONBLOCKING;

    /// Whether there is no pose.
    [[nodiscard]] bool is_empty() const noexcept { return newest_final_ < 0; }
    /// Hop of the newest final pose; -1 when empty.
    [[nodiscard]] HopIndex newest_final() const noexcept { return newest_final_; }
    /// Hop of the oldest final pose; the track must not be empty.
    [[nodiscard]] HopIndex oldest_final() const noexcept RAKS_NONBLOCKING;
    /// Hop of the last pose, final or predicted.
    [[nodiscard]] HopIndex newest() const noexcept { return newest_final_ + predicted_; }

    /// The pose of one hop; hops outside the track give its nearest end. A T-pose when empty.
    [[nodiscard]] const Pose& at_hop(HopIndex hop) const noexcept RAKS_NONBLOCKING;

    /// The pose at a moment, interpolated between two hops; clamped to the track's ends.
    [[nodiscard]] Pose at(StreamTime time) const noexcept;

    /// The feeling at a moment, interpolated between two hops; beyond the newest final pose that of
    /// the newest one. None when empty.
    [[nodiscard]] Feeling feeling_at(StreamTime time) const noexcept;

 private:
    static constexpr std::size_t kSlots = kFinalPoses + kPredictedPoses;

    std::array<Pose, kSlots> poses_{};             // pose of hop h in slot h % kSlots
    std::array<Feeling, kFinalPoses> feelings_{};  // of hop h in slot h % kFinalPoses
    HopIndex first_ = 0;                           // first hop since clear()
    HopIndex newest_final_ = -1;
    int predicted_ = 0;
};
static_assert(std::is_trivially_copyable_v<PoseTrack>);

}  // namespace raks::motion
