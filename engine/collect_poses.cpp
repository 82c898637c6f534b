#include "engine/collect_poses.hpp"

#include <cmath>
#include <cstddef>

namespace raks::engine {

void CollectPoses::on_hop(const PerformedHop& hop) {
    for (; next_time() <= time_of_hop(hop.track.newest_final()); ++next_) {
        poses.push_back(hop.track.at(next_time()));
    }
    last_ = hop.track.at_hop(hop.track.newest_final());
}

void CollectPoses::finish(Nanos duration) {
    const auto count = static_cast<std::size_t>(std::ceil(to_seconds(duration) * fps_));
    poses.resize(count, last_);
}

StreamTime CollectPoses::next_time() const {
    return stream_time_from_seconds(static_cast<double>(next_) / fps_);
}

}  // namespace raks::engine
