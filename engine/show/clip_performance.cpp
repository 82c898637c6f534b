#include "engine/show/clip_performance.hpp"

#include <algorithm>
#include <cmath>

namespace raks::engine {

// A moment before the beginning is as good as one at the clip's end.
double ClipPerformance::time_in_clip(StreamTime moment) const {
    const double length = clip_.duration();
    if (!(length > 0.0)) {
        return 0.0;
    }
    const double seconds = std::fmod(to_seconds(moment - *begins_), length);
    return seconds < 0.0 ? seconds + length : seconds;
}

// Tracks as a dancer makes them, since springs look back; every dancer at its own place.
void ClipPerformance::perform_until(HopIndex hop, const DancedMoment& danced) {
    const bool is_near = tracks_.size() == danced.tracks.size() && !tracks_.empty() &&
                         hop >= tracks_.front().oldest_final() &&
                         hop <= tracks_.front().newest_final() + motion::PoseTrack::kFinalPoses;
    if (!is_near) {
        tracks_.assign(danced.tracks.size(), {});
    }
    for (std::size_t i = 0; i < tracks_.size(); ++i) {
        const glm::vec2 place = i < danced.places.size() ? danced.places[i] : glm::vec2(0.0F);
        HopIndex next = tracks_[i].is_empty() ? hop : tracks_[i].newest_final() + 1;
        for (; next <= hop + 1; ++next) {
            motion::Pose pose = clip_.pose_at(time_in_clip(time_of_hop(next)));
            pose.hips_position += glm::vec3(place.x, 0.0F, place.y);
            tracks_[i].append_final(next, pose);
        }
    }
}

ShownMoment ClipPerformance::at(const ShownMoment& shown) {
    const StreamTime moment = shown.danced.moment;
    begins_ = begins_.value_or(moment);
    perform_until(std::max<HopIndex>((moment - StreamTime{}) / kHop, 0), shown.danced);
    DancedMoment danced = shown.danced;
    danced.tracks = tracks_;
    danced.lead = Nanos(0);
    danced.face = clip_.face_at(time_in_clip(moment));
    return {shown.music, shown.dancer, danced};
}

}  // namespace raks::engine
