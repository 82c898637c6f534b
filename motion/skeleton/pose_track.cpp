#include "motion/skeleton/pose_track.hpp"

#include <algorithm>
#include <cmath>

#include "base/assert.hpp"

namespace raks::motion {

void PoseTrack::append_final(HopIndex hop,
                             const Pose& pose,
                             const Feeling& feeling) noexcept RAKS_NONBLOCKING {
    RAKS_ASSERT(hop >= 0 && (is_empty() || hop == newest_final_ + 1));
    if (is_empty()) {
        first_ = hop;
    }
    poses_[static_cast<std::size_t>(hop) % kSlots] = pose;
    feelings_[static_cast<std::size_t>(hop) % kFinalPoses] = feeling;
    newest_final_ = hop;
    predicted_ = 0;
}

void PoseTrack::set_predicted(int ahead, const Pose& pose) noexcept RAKS_NONBLOCKING {
    // In order: a gap would leave old poses between the new ones.
    RAKS_ASSERT(!is_empty() && ahead >= 1 && ahead <= kPredictedPoses && ahead <= predicted_ + 1);
    poses_[static_cast<std::size_t>(newest_final_ + ahead) % kSlots] = pose;
    predicted_ = std::max(predicted_, ahead);
}

void PoseTrack::replace(HopIndex hop, const Pose& pose) noexcept RAKS_NONBLOCKING {
    RAKS_ASSERT(!is_empty() && hop >= oldest_final() && hop <= newest());
    poses_[static_cast<std::size_t>(hop) % kSlots] = pose;
}

HopIndex PoseTrack::oldest_final() const noexcept RAKS_NONBLOCKING {
    return std::max(first_, newest_final_ - kFinalPoses + 1);
}

const Pose& PoseTrack::at_hop(HopIndex hop) const noexcept RAKS_NONBLOCKING {
    if (is_empty()) {
        return poses_[0];
    }
    const HopIndex inside = std::clamp(hop, oldest_final(), newest());
    return poses_[static_cast<std::size_t>(inside) % kSlots];
}

Pose PoseTrack::at(StreamTime time) const noexcept {
    const Nanos past_oldest = time - time_of_hop(oldest_final());
    if (is_empty() || past_oldest.count() <= 0) {
        return at_hop(oldest_final());
    }
    // The hop before the moment, and the share of the way to the next one.
    const HopIndex hop = oldest_final() + past_oldest / kHop;
    const float t =
        static_cast<float>((past_oldest % kHop).count()) / static_cast<float>(kHop.count());
    return hop >= newest() ? at_hop(hop) : interpolate(at_hop(hop), at_hop(hop + 1), t);
}

Feeling PoseTrack::feeling_at(StreamTime time) const noexcept {
    if (is_empty()) {
        return {};
    }
    const auto of_hop = [this](HopIndex hop) {
        const HopIndex inside = std::clamp(hop, oldest_final(), newest_final_);
        return feelings_[static_cast<std::size_t>(inside) % kFinalPoses];
    };
    const Nanos past_oldest = std::max(time - time_of_hop(oldest_final()), Nanos(0));
    const HopIndex hop = oldest_final() + past_oldest / kHop;
    const float t =
        static_cast<float>((past_oldest % kHop).count()) / static_cast<float>(kHop.count());
    return interpolate(of_hop(hop), of_hop(hop + 1), t);
}

}  // namespace raks::motion
