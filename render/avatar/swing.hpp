// Swinging in stream time: the same tails at any rate of pictures.
#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "base/time.hpp"
#include "render/avatar/joint_tree.hpp"
#include "render/avatar/spring_rig.hpp"

namespace raks::render {

/// Number of a step of 1/60 s of stream time; step 0 is at stream time 0.
using SpringStep = std::int64_t;

/// Time of a step.
[[nodiscard]] constexpr StreamTime time_of_step(SpringStep step) noexcept {
    constexpr std::int64_t kSecond = 1'000'000'000;
    const std::int64_t whole = step / 60;
    const std::int64_t rest = step % 60;
    return StreamTime(Nanos(whole * kSecond + (rest * kSecond + (rest > 0 ? 59 : 0)) / 60));
}

/// The last step at or before a time.
[[nodiscard]] constexpr SpringStep step_at(StreamTime time) noexcept {
    SpringStep step = static_cast<SpringStep>(to_seconds(time) * 60.0);
    while (time_of_step(step) > time) {
        --step;
    }
    while (time_of_step(step + 1) <= time) {
        ++step;
    }
    return step;
}

/// The swinging of one dancer. Steps lie on a grid of stream time and see poses of their own times
/// alone, so how often pictures are drawn does not show.
///
///     swing.advance(rig, joints, state, time, [&](StreamTime t) { pose_joints(t, state); });
///     pose_joints(time, state);
///     swing.show(rig, state);
///     update_world(joints, state);
///
/// Threads: one at a time. Real-time: yes, after the constructor.
class Swing {
 public:
    /// Steps with the first pose held, so that hair hangs before the first picture.
    static constexpr int kWarmUpSteps = 60;
    /// A later time than that after the last one begins anew, as after an earlier one.
    static constexpr Nanos kLongestGap = std::chrono::milliseconds(250);

    explicit Swing(const SpringRig& rig);

    /// Begins anew at the next time: after a seek, a leap of the pose, another avatar.
    void reset() noexcept { newest_.reset(); }

    /// Does the steps up to the first one at or after `time`. `pose_joints(StreamTime)` writes the
    /// pose of that time into `state`, with `world`; it is asked at most 1/60 s beyond `time`.
    template <typename PoseJoints>
    void advance(const SpringRig& rig,
                 std::span<const Joint> joints,
                 JointState& state,
                 StreamTime time,
                 PoseJoints&& pose_joints) {
        const SpringStep last = step_at(time);
        if (is_new_start(last)) {
            pose_joints(time_of_step(last));
            start(rig, joints, state, last);
        }
        const SpringStep end = time_of_step(last) == time ? last : last + 1;
        while (*newest_ < end) {
            pose_joints(time_of_step(*newest_ + 1));
            step(rig, joints, state);
        }
        show_from(time);
    }

    /// Writes the rotations of the swinging joints at the time of the last `advance`, between the
    /// two steps around it; at rest before the first. `world` is not computed.
    void show(const SpringRig& rig, JointState& state) const noexcept;

    [[nodiscard]] const SpringTails& tails() const noexcept { return tails_; }

 private:
    [[nodiscard]] bool is_new_start(SpringStep last) const noexcept;
    void start(const SpringRig& rig,
               std::span<const Joint> joints,
               JointState& state,
               SpringStep at) noexcept;
    void step(const SpringRig& rig, std::span<const Joint> joints, JointState& state) noexcept;
    void keep_rotations(const SpringRig& rig, const JointState& state) noexcept;
    void show_from(StreamTime time) noexcept;

    SpringTails tails_;
    std::vector<glm::quat> before_;  // by swing: after the last step but one
    std::vector<glm::quat> after_;   // after the last step
    std::optional<SpringStep> newest_;
    float part_ = 1.0F;  // where between the two the picture is
};

}  // namespace raks::render
