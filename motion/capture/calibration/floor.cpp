#include "motion/capture/calibration/floor.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>

#include <Eigen/Dense>

#include "base/printable.hpp"
#include "motion/capture/camera/rotation.hpp"

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

// By how much what all cameras saw of the board lies off a pose of it; pixels, x and y of each
// corner in turn.
Eigen::VectorXd misses(const Rig& rig,
                       const Board& board,
                       const RigidMotion& world_from_board,
                       const std::vector<Sighting>& seen) {
    std::vector<double> all;
    for (const Sighting& sighting : seen) {
        for (const BoardCorner& corner : sighting.corners) {
            const glm::dvec3 place =
                world_from_board(glm::dvec3(corner_place(board, corner.corner), 0.0));
            const auto pixel = project(rig.cameras[sighting.camera], place);
            // A corner behind its camera says nothing.
            const glm::dvec2 miss = pixel ? *pixel - corner.pixel : glm::dvec2(0.0);
            all.insert(all.end(), {miss.x, miss.y});
        }
    }
    return Eigen::Map<const Eigen::VectorXd>(all.data(), static_cast<Eigen::Index>(all.size()));
}

// Turned and shifted by six small numbers.
RigidMotion nudged(const RigidMotion& place, const Eigen::Matrix<double, 6, 1>& by) {
    return {rotation_of({by[0], by[1], by[2]}) * place.rotation,
            place.translation + glm::dvec3(by[3], by[4], by[5])};
}

// The pose near `place` that explains best what all cameras saw (Gauss-Newton). One camera's own
// proposal is off by what the rig does not know exactly of that camera.
RigidMotion by_all_cameras(const Rig& rig,
                           const Board& board,
                           RigidMotion place,
                           const std::vector<Sighting>& seen) {
    constexpr int kMostSteps = 10;
    constexpr double kTry = 1e-6;  // radians and metres
    Eigen::VectorXd off = misses(rig, board, place, seen);
    for (int step = 0; step < kMostSteps; ++step) {
        Eigen::Matrix<double, Eigen::Dynamic, 6> slopes(off.size(), 6);
        for (int i = 0; i < 6; ++i) {
            const auto tried = nudged(place, kTry * Eigen::Matrix<double, 6, 1>::Unit(i));
            slopes.col(i) = (misses(rig, board, tried, seen) - off) / kTry;
        }
        const Eigen::Matrix<double, 6, 1> by = slopes.colPivHouseholderQr().solve(-off);
        const RigidMotion next = nudged(place, by);
        Eigen::VectorXd next_off = misses(rig, board, next, seen);
        if (!(next_off.squaredNorm() < off.squaredNorm())) {
            break;
        }
        place = next;
        off = std::move(next_off);
    }
    return place;
}

// Where the lines of sight of all cameras come nearest to one another.
glm::dvec3 middle_of_sights(const Rig& rig) {
    constexpr double kLeaning = 1e-3;  // towards the cameras, for lines that are nearly parallel
    glm::dmat3 across(0.0);
    glm::dvec3 sum{};
    for (const Camera& camera : rig.cameras) {
        const glm::dvec3 sight = glm::transpose(camera.rotation)[2];
        const glm::dmat3 beside = glm::dmat3(1.0 + kLeaning) - glm::outerProduct(sight, sight);
        across += beside;
        sum += beside * camera.centre();
    }
    return glm::inverse(across) * sum;
}

}  // namespace

std::string lying_board_size(const Rig& rig, const Board& board) {
    // find_lying_board reads the markers of squares that are so high in the picture, not of those
    // that are a quarter lower (docs/measurements/capture.md).
    constexpr double kHighEnough = 8.0;    // pixels
    constexpr double kLowestCamera = 1.4;  // metres
    constexpr double kMillimetres = 1000.0;
    const glm::dvec3 middle = middle_of_sights(rig);
    double lowest = std::numeric_limits<double>::infinity();
    for (const Camera& camera : rig.cameras) {
        lowest = std::min(lowest, camera.centre().y);
    }
    std::string sizes;
    double highest = 1e-6;  // pixels
    for (const Camera& camera : rig.cameras) {
        const glm::dvec3 centre = camera.centre();
        const double height = centre.y - lowest + kLowestCamera;
        const double distance = std::hypot(centre.x - middle.x, centre.z - middle.z, height);
        const double across = camera.lens.fx * board.square / distance;
        const double down = across * height / distance;
        sizes += fmt::format("{}{:.0f} x {:.0f} pixels in \"{}\"",
                             sizes.empty() ? "" : ", ",
                             across,
                             down,
                             printable(camera.name));
        highest = std::max(highest, down);
    }
    return fmt::format(
        "a square of {:.0f} mm that lies in the middle is about {}; {:.0f} high are "
        "needed in one of them: squares of {:.0f} mm or more, sharp and in light",
        kMillimetres * board.square,
        sizes,
        kHighEnough,
        std::ceil(kMillimetres * board.square * std::max(1.0, kHighEnough / highest)));
}

Expected<void> put_on_floor(Rig& rig, const Board& board, const std::vector<Sighting>& seen) {
    std::optional<RigidMotion> best;
    double least = std::numeric_limits<double>::infinity();
    double least_refused = least;
    std::vector<std::string> refused;
    for (const Sighting& sighting : seen) {
        const Camera& camera = rig.cameras[sighting.camera];
        for (const BoardPose& pose : board_poses(camera.lens, board, sighting.corners)) {
            const RigidMotion place = by_all_cameras(
                rig, board, pose_of(camera).inverse().after(pose.camera_from_board), seen);
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
