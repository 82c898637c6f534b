#include "motion/capture/calibration/floor.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <limits>
#include <optional>

#include "base/printable.hpp"

#include <glm/geometric.hpp>
#include <glm/matrix.hpp>

namespace raks::capture {

namespace {

// The world in which a board lies on the floor with its cameras above: new world from old. The
// names of the cameras that would be under it, if any, come into `below`.
RigidMotion floor_from(const Rig& rig,
                       const Board& board,
                       const RigidMotion& world_from_board,
                       std::vector<std::string>& below) {
    const glm::dvec3 middle = world_from_board(
        {0.5 * board.square * board.columns, 0.5 * board.square * board.rows, 0.0});
    const glm::dvec3 normal = world_from_board.rotation[2];
    const auto height = [&](const Camera& camera) {
        return glm::dot(camera.centre() - middle, normal);
    };
    const auto above = std::count_if(rig.cameras.begin(),
                                     rig.cameras.end(),
                                     [&](const Camera& camera) { return height(camera) > 0.0; });
    const bool is_up = 2 * above > static_cast<std::ptrdiff_t>(rig.cameras.size());
    for (const Camera& camera : rig.cameras) {
        if ((height(camera) > 0.0) != is_up) {
            below.push_back(printable(camera.name));
        }
    }
    const glm::dvec3 up = is_up ? normal : -normal;
    const glm::dvec3 x = world_from_board.rotation[0];
    // Rows of a rotation are the new axes in the old ones.
    const glm::dmat3 rotation = glm::transpose(glm::dmat3(x, up, glm::cross(x, up)));
    return {rotation, -(rotation * middle)};
}

double cost_of(const Rig& rig,
               const Board& board,
               const RigidMotion& world_from_board,
               const std::vector<Sighting>& seen) {
    double cost = 0.0;
    for (const Sighting& sighting : seen) {
        const Camera& camera = rig.cameras[sighting.camera];
        cost += reprojection_rms(
            camera.lens, board, pose_of(camera).after(world_from_board), sighting.corners);
    }
    return cost;
}

}  // namespace

Expected<void> put_on_floor(Rig& rig, const Board& board, const std::vector<Sighting>& seen) {
    std::optional<RigidMotion> best;
    double least = std::numeric_limits<double>::infinity();
    double least_refused = least;
    std::vector<std::string> refused;
    for (const Sighting& sighting : seen) {
        const Camera& camera = rig.cameras[sighting.camera];
        for (const BoardPose& pose : board_poses(camera.lens, board, sighting.corners)) {
            const RigidMotion place = pose_of(camera).inverse().after(pose.camera_from_board);
            std::vector<std::string> below;
            const RigidMotion floor = floor_from(rig, board, place, below);
            const double cost = cost_of(rig, board, place, seen);
            if (below.empty() && cost < least) {
                least = cost;
                best = floor;
            } else if (!below.empty() && cost < least_refused) {
                least_refused = cost;
                refused = below;
            }
        }
    }
    if (!best) {
        return seen.empty()
                   ? fail("no camera saw the board on the floor: lay it where one or more see it")
                   : fail(fmt::format(
                         "camera \"{}\" would be under the floor: did the board lie flat on it?",
                         refused.empty() ? "?" : refused.front()));
    }
    for (Camera& camera : rig.cameras) {
        set_pose(camera, pose_of(camera).after(best->inverse()));
    }
    return {};
}

}  // namespace raks::capture
