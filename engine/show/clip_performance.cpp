#include "engine/show/clip_performance.hpp"

#include <algorithm>
#include <cmath>

namespace raks::engine {

void ClipPerformance::follow_song(double song_start) noexcept {
    constexpr double kNoSeek = 0.3;  // seconds: what is buffered
    if (!song_start_ || std::abs(song_start - *song_start_) > kNoSeek) {
        song_start_ = song_start;
        performer_.set_song_start(song_start);
    }
}

// Tracks as a dancer makes them, since springs look back; every dancer at its own place. Two that
// draw may ask for moments a little apart, and get the same poses.
void ClipPerformance::perform_until(HopIndex hop, const ShownMoment& shown) {
    const DancedMoment& danced = shown.danced;
    const bool is_near = tracks_.size() == danced.tracks.size() && !tracks_.empty() &&
                         hop >= tracks_.front().oldest_final() &&
                         hop <= tracks_.front().newest_final() + motion::PoseTrack::kFinalPoses;
    if (!is_near) {
        tracks_.assign(danced.tracks.size(), {});
        performer_.leap();
    }
    if (tracks_.empty()) {
        return;
    }
    HopIndex next = tracks_.front().is_empty() ? hop : tracks_.front().newest_final() + 1;
    for (; next <= hop + 1; ++next) {
        const motion::Pose pose = performer_.next(time_of_hop(next), shown.music);
        for (std::size_t i = 0; i < tracks_.size(); ++i) {
            const glm::vec2 place = i < danced.places.size() ? danced.places[i] : glm::vec2(0.0F);
            motion::Pose placed = pose;
            placed.hips_position += glm::vec3(place.x, 0.0F, place.y);
            tracks_[i].append_final(next, placed);
        }
    }
}

std::optional<render::Camera> ClipPerformance::camera(float size) const {
    const std::optional<double> seconds = performer_.file_seconds();
    return camera_ && seconds ? std::optional(camera_->at(std::max(0.0, *seconds - ahead_), size))
                              : std::nullopt;
}

ShownMoment ClipPerformance::at(const ShownMoment& shown) {
    const StreamTime moment = shown.danced.moment;
    perform_until(std::max<HopIndex>((moment - StreamTime{}) / kHop, 0), shown);
    DancedMoment danced = shown.danced;
    danced.tracks = tracks_;
    danced.lead = Nanos(0);
    danced.face = performer_.face();
    if (!tracks_.empty()) {
        ahead_ = to_seconds(time_of_hop(tracks_.front().newest_final()) - moment);
    }
    return {shown.music, shown.dancer, danced};
}

}  // namespace raks::engine
