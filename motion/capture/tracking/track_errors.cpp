#include "motion/capture/tracking/track_errors.hpp"

#include <fmt/format.h>

#include <Eigen/Geometry>

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

constexpr double kNone = std::numeric_limits<double>::quiet_NaN();

// Where each place truly is, at the moments of the tracks; NaN where the truth has not the moment.
Expected<std::vector<glm::dvec3>> true_places(const Tracks& tracks, const Tracks& truth) {
    std::vector<std::size_t> true_markers;
    for (const std::string& name : tracks.markers) {
        const auto found = std::find(truth.markers.begin(), truth.markers.end(), name);
        if (found == truth.markers.end()) {
            return fail(fmt::format("marker \"{}\" is not in the truth", printable(name)));
        }
        true_markers.push_back(static_cast<std::size_t>(found - truth.markers.begin()));
    }
    std::vector<glm::dvec3> places(tracks.places.size(), glm::dvec3(kNone));
    for (std::size_t frame = 0; frame < tracks.frame_count; ++frame) {
        const double index = (tracks.time_of(frame) - truth.first_time) * truth.frames_per_second;
        if (!(index > -1e-6 && index < static_cast<double>(truth.frame_count) - 1.0 + 1e-6)) {
            continue;
        }
        const auto before = static_cast<std::size_t>(std::max(0.0, std::floor(index)));
        const std::size_t after = std::min(before + 1, truth.frame_count - 1);
        const double part = std::clamp(index - static_cast<double>(before), 0.0, 1.0);
        for (std::size_t marker = 0; marker < true_markers.size(); ++marker) {
            places[frame * true_markers.size() + marker] =
                glm::mix(truth.at(before, true_markers[marker]).place,
                         truth.at(after, true_markers[marker]).place,
                         part);
        }
    }
    return places;
}

// How far places are off on average, once they were turned and moved onto the true ones.
double aligned_mean(const Eigen::Matrix3Xd& places, const Eigen::Matrix3Xd& truth) {
    constexpr Eigen::Index kFewest = 3;
    if (places.cols() < kFewest) {
        return 0.0;
    }
    const Eigen::Matrix4d onto = Eigen::umeyama(places, truth, false);
    const Eigen::Matrix3Xd moved =
        (onto.topLeftCorner<3, 3>() * places).colwise() + onto.topRightCorner<3, 1>();
    return (moved - truth).colwise().norm().mean();
}

}  // namespace

Expected<std::vector<double>> distances_from(const Tracks& tracks, const Tracks& truth) {
    const auto places = true_places(tracks, truth);
    if (!places) {
        return fail(places.error());
    }
    std::vector<double> distances(tracks.places.size(), kNone);
    for (std::size_t i = 0; i < distances.size(); ++i) {
        if (!std::isnan((*places)[i].x)) {
            const double off = glm::distance(tracks.places[i].place, (*places)[i]);
            distances[i] = std::isfinite(off) ? off : std::numeric_limits<double>::infinity();
        }
    }
    return distances;
}

Expected<TrackErrors> track_errors(const Tracks& tracks, const Tracks& truth) {
    const auto distances = distances_from(tracks, truth);
    if (!distances) {
        return fail(distances.error());
    }
    const std::vector<glm::dvec3> true_ones = *true_places(tracks, truth);
    TrackErrors errors;
    double sum = 0.0;
    std::vector<Eigen::Vector3d> seen;
    std::vector<Eigen::Vector3d> meant;
    for (std::size_t i = 0; i < distances->size(); ++i) {
        const double off = (*distances)[i];
        if (std::isnan(off)) {
            continue;
        }
        ++errors.places;
        if (off <= kFarOff) {
            sum += off;
            const glm::dvec3& place = tracks.places[i].place;
            seen.emplace_back(place.x, place.y, place.z);
            meant.emplace_back(true_ones[i].x, true_ones[i].y, true_ones[i].z);
            continue;
        }
        ++errors.wrong;
        const std::size_t count = tracks.markers.size();
        errors.unflagged += is_flagged(tracks, i / count, i % count) ? 0U : 1U;
    }
    if (!seen.empty()) {
        errors.mean = sum / static_cast<double>(seen.size());
        const auto columns = static_cast<Eigen::Index>(seen.size());
        errors.aligned_mean =
            aligned_mean(Eigen::Map<const Eigen::Matrix3Xd>(seen.front().data(), 3, columns),
                         Eigen::Map<const Eigen::Matrix3Xd>(meant.front().data(), 3, columns));
    }
    return errors;
}

}  // namespace raks::capture
