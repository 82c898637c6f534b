#include "motion/capture/calibration/edge_errors.hpp"

#include <algorithm>
#include <cmath>
#include <map>

#include "motion/capture/triangulation/triangulation.hpp"

#include <glm/geometric.hpp>

namespace raks::capture {

namespace {

// The corners of one moment in space.
using Corners = std::map<std::size_t, glm::dvec3>;

// Adds up what single views are off.
struct Misses {
    double sum = 0.0;
    std::size_t count = 0;
};

Corners corners_in_space(const Rig& rig, const std::vector<const Sighting*>& seen, Misses& misses) {
    struct Views {
        std::vector<PointView> views;
        std::vector<glm::dvec2> pixels;
    };
    std::map<std::size_t, Views> by_corner;
    for (const Sighting* const sighting : seen) {
        const Lens& lens = rig.cameras[sighting->camera].lens;
        for (const BoardCorner& corner : sighting->corners) {
            Views& views = by_corner[corner.corner];
            views.views.push_back(
                {.camera = sighting->camera, .direction = direction_of(lens, corner.pixel)});
            views.pixels.push_back(corner.pixel);
        }
    }
    Corners corners;
    for (const auto& [corner, views] : by_corner) {
        const auto place = triangulate_linear(rig, views.views);
        if (!place) {
            continue;
        }
        corners[corner] = *place;
        for (std::size_t i = 0; i < views.views.size(); ++i) {
            if (const auto pixel = project(rig.cameras[views.views[i].camera], *place)) {
                misses.sum += glm::distance(*pixel, views.pixels[i]);
                ++misses.count;
            }
        }
    }
    return corners;
}

}  // namespace

EdgeErrors edge_errors(const Rig& rig, const Board& board, const std::vector<Sighting>& sightings) {
    std::map<std::size_t, std::vector<const Sighting*>> by_moment;
    for (const Sighting& sighting : sightings) {
        by_moment[sighting.moment].push_back(&sighting);
    }
    const auto edges = board_edges(board);
    EdgeErrors errors;
    Misses misses;
    double squares = 0.0;
    for (const auto& [moment, seen] : by_moment) {
        const Corners corners = corners_in_space(rig, seen, misses);
        errors.points += corners.size();
        for (const auto& [from, to] : edges) {
            const auto a = corners.find(from);
            const auto b = corners.find(to);
            if (a == corners.end() || b == corners.end()) {
                continue;
            }
            const double error = glm::distance(a->second, b->second) - board.square;
            ++errors.edges;
            errors.mean += std::abs(error);
            errors.bias += error;
            errors.worst = std::max(errors.worst, std::abs(error));
            squares += error * error;
        }
    }
    if (errors.edges > 0) {
        const auto count = static_cast<double>(errors.edges);
        errors.mean /= count;
        errors.bias /= count;
        errors.rms = std::sqrt(squares / count);
    }
    errors.reprojection = misses.count > 0 ? misses.sum / static_cast<double>(misses.count) : 0.0;
    return errors;
}

}  // namespace raks::capture
