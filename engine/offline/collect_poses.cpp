#include "engine/offline/collect_poses.hpp"

#include <cmath>
#include <cstddef>

namespace raks::engine {

void CollectPoses::on_hop(const PerformedHop& hop) {
    dancers.resize(hop.tracks.size());
    last_.resize(hop.tracks.size());
    // A track is final up to its newest final hop only: later poses may still change.
    for (; next_time() <= time_of_hop(hop.track.newest_final()); ++next_) {
        for (std::size_t i = 0; i < dancers.size(); ++i) {
            dancers[i].push_back(hop.tracks[i].at(next_time()));
        }
    }
    // Kept for finish(): the tracks end a little before the music does.
    for (std::size_t i = 0; i < dancers.size(); ++i) {
        last_[i] = hop.tracks[i].at_hop(hop.track.newest_final());
    }
}

void CollectPoses::finish(Nanos duration) {
    // Rounded up: the last picture of a film begins before the music ends.
    const auto count = static_cast<std::size_t>(std::ceil(to_seconds(duration) * fps_));
    for (std::size_t i = 0; i < dancers.size(); ++i) {
        dancers[i].resize(count, last_[i]);
    }
}

StreamTime CollectPoses::next_time() const {
    // Computed from the index, not accumulated: no drift over a long film.
    return stream_time_from_seconds(static_cast<double>(next_) / fps_);
}

}  // namespace raks::engine
