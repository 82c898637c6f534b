#include "motion/capture/tracking/track_errors.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <string>
#include <vector>

#include "base/printable.hpp"

#include <glm/common.hpp>
#include <glm/geometric.hpp>

namespace raks::capture {
namespace {

constexpr double kFarOff = 0.1;  // metres

bool is_flagged(const Tracks& tracks, std::size_t frame, std::size_t marker) {
    return std::any_of(tracks.flags.begin(), tracks.flags.end(), [&](const Flag& flag) {
        return flag.marker == marker && frame >= flag.first && frame <= flag.last;
    });
}

}  // namespace

Expected<std::vector<double>> distances_from(const Tracks& tracks, const Tracks& truth) {
    std::vector<std::size_t> true_markers;
    for (const std::string& name : tracks.markers) {
        const auto found = std::find(truth.markers.begin(), truth.markers.end(), name);
        if (found == truth.markers.end()) {
            return fail(fmt::format("marker \"{}\" is not in the truth", printable(name)));
        }
        true_markers.push_back(static_cast<std::size_t>(found - truth.markers.begin()));
    }
    std::vector<double> distances(tracks.places.size(), std::numeric_limits<double>::quiet_NaN());
    for (std::size_t frame = 0; frame < tracks.frame_count; ++frame) {
        const double index = (tracks.time_of(frame) - truth.first_time) * truth.frames_per_second;
        if (!(index > -1e-6 && index < static_cast<double>(truth.frame_count) - 1.0 + 1e-6)) {
            continue;
        }
        const auto before = static_cast<std::size_t>(std::max(0.0, std::floor(index)));
        const std::size_t after = std::min(before + 1, truth.frame_count - 1);
        const double part = std::clamp(index - static_cast<double>(before), 0.0, 1.0);
        for (std::size_t marker = 0; marker < true_markers.size(); ++marker) {
            const glm::dvec3 place = glm::mix(truth.at(before, true_markers[marker]).place,
                                              truth.at(after, true_markers[marker]).place,
                                              part);
            const double off = glm::distance(tracks.at(frame, marker).place, place);
            distances[frame * true_markers.size() + marker] =
                std::isfinite(off) ? off : std::numeric_limits<double>::infinity();
        }
    }
    return distances;
}

Expected<TrackErrors> track_errors(const Tracks& tracks, const Tracks& truth) {
    const auto distances = distances_from(tracks, truth);
    if (!distances) {
        return fail(distances.error());
    }
    TrackErrors errors;
    double sum = 0.0;
    for (std::size_t i = 0; i < distances->size(); ++i) {
        const double off = (*distances)[i];
        if (std::isnan(off)) {
            continue;
        }
        ++errors.places;
        if (off <= kFarOff) {
            sum += off;
            continue;
        }
        ++errors.wrong;
        const std::size_t count = tracks.markers.size();
        errors.unflagged += is_flagged(tracks, i / count, i % count) ? 0U : 1U;
    }
    const std::size_t near = errors.places - errors.wrong;
    errors.mean = near > 0 ? sum / static_cast<double>(near) : 0.0;
    return errors;
}

}  // namespace raks::capture
