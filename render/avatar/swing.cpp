#include "render/avatar/swing.hpp"

#include <algorithm>

#include "motion/skeleton/pose.hpp"

namespace raks::render {

Swing::Swing(const SpringRig& rig) : tails_(rig.make_tails()) {
    for (std::size_t i = 0; i < rig.size(); ++i) {
        before_.push_back(rig.rest_rotation(i));
        after_.push_back(rig.rest_rotation(i));
    }
}

bool Swing::is_new_start(SpringStep last) const noexcept {
    // The newest step may be the one after the last picture's time.
    return !newest_ || last + 1 < *newest_ ||
           time_of_step(last) - time_of_step(*newest_) > kLongestGap;
}

void Swing::start(const SpringRig& rig,
                  std::span<const Joint> joints,
                  JointState& state,
                  SpringStep at) noexcept {
    rig.rest(joints, state, tails_);
    for (int i = 0; i < kWarmUpSteps; ++i) {
        rig.step(joints, state, tails_);
    }
    keep_rotations(rig, state);
    keep_rotations(rig, state);
    newest_ = at;
}

void Swing::step(const SpringRig& rig, std::span<const Joint> joints, JointState& state) noexcept {
    rig.step(joints, state, tails_);
    keep_rotations(rig, state);
    ++*newest_;
}

void Swing::keep_rotations(const SpringRig& rig, const JointState& state) noexcept {
    before_.swap(after_);
    for (std::size_t i = 0; i < rig.size(); ++i) {
        after_[i] = state.rotations[rig.joint(i)];
    }
}

void Swing::show_from(StreamTime time) noexcept {
    const double after = to_seconds(time - time_of_step(*newest_ - 1)) * 60.0;
    part_ = std::clamp(static_cast<float>(after), 0.0F, 1.0F);
}

void Swing::show(const SpringRig& rig, JointState& state) const noexcept {
    for (std::size_t i = 0; i < rig.size(); ++i) {
        state.rotations[rig.joint(i)] = motion::interpolate(before_[i], after_[i], part_);
    }
}

}  // namespace raks::render
