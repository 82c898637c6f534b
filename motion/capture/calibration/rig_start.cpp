#include "motion/capture/calibration/rig_start.hpp"

#include <algorithm>
#include <limits>
#include <optional>

namespace raks::capture {

namespace {

// A board that is off by more counts no more: it proposes nothing, but may be seen wrongly.
constexpr double kFarOff = 20.0;  // pixels

// What two cameras saw at one moment, and how the board stood before each.
struct SharedBoard {
    const Sighting* from = nullptr;
    const Sighting* to = nullptr;
    std::vector<BoardPose> before_from;
    std::vector<BoardPose> before_to;
};

std::vector<SharedBoard> shared_boards(const Rig& rig,
                                       const Board& board,
                                       const std::vector<Sighting>& sightings,
                                       const Join& join) {
    std::map<std::size_t, SharedBoard> by_moment;
    for (const Sighting& sighting : sightings) {
        if (sighting.camera == join.from) {
            by_moment[sighting.moment].from = &sighting;
        } else if (sighting.camera == join.to) {
            by_moment[sighting.moment].to = &sighting;
        }
    }
    std::vector<SharedBoard> shared;
    for (auto& [moment, one] : by_moment) {
        if (one.from != nullptr && one.to != nullptr) {
            one.before_from = board_poses(rig.cameras[join.from].lens, board, one.from->corners);
            one.before_to = board_poses(rig.cameras[join.to].lens, board, one.to->corners);
            shared.push_back(std::move(one));
        }
    }
    // Hundreds of boards say no more than some of them, and are compared each with each.
    constexpr std::size_t kEnough = 40;
    std::vector<SharedBoard> some;
    for (std::size_t i = 0; i < std::min(kEnough, shared.size()); ++i) {
        some.push_back(std::move(shared[i * shared.size() / std::min(kEnough, shared.size())]));
    }
    return some;
}

// How badly a relative pose explains what `to` saw, given what `from` saw.
double cost_of(const RigidMotion& to_from,
               const Lens& lens_of_to,
               const Board& board,
               const std::vector<SharedBoard>& shared) {
    double cost = 0.0;
    for (const SharedBoard& one : shared) {
        double best = kFarOff;
        for (const BoardPose& pose : one.before_from) {
            best = std::min(
                best,
                reprojection_rms(
                    lens_of_to, board, to_from.after(pose.camera_from_board), one.to->corners));
        }
        cost += best;
    }
    return cost;
}

RigidMotion relative_pose(const Rig& rig,
                          const Board& board,
                          const std::vector<Sighting>& sightings,
                          const Join& join) {
    const std::vector<SharedBoard> shared = shared_boards(rig, board, sightings, join);
    RigidMotion best;
    double least = std::numeric_limits<double>::infinity();
    for (const SharedBoard& one : shared) {
        for (const BoardPose& from : one.before_from) {
            for (const BoardPose& to : one.before_to) {
                const RigidMotion proposal =
                    to.camera_from_board.after(from.camera_from_board.inverse());
                const double cost = cost_of(proposal, rig.cameras[join.to].lens, board, shared);
                if (cost < least) {
                    least = cost;
                    best = proposal;
                }
            }
        }
    }
    return best;
}

// How badly a place of the board explains what all cameras saw of it.
double cost_of(const RigidMotion& world_from_board,
               const Rig& rig,
               const Board& board,
               const std::vector<const Sighting*>& seen) {
    double cost = 0.0;
    for (const Sighting* const sighting : seen) {
        const Camera& camera = rig.cameras[sighting->camera];
        cost += std::min(
            kFarOff,
            reprojection_rms(
                camera.lens, board, pose_of(camera).after(world_from_board), sighting->corners));
    }
    return cost;
}

}  // namespace

void place_cameras(Rig& rig,
                   const Board& board,
                   const std::vector<Sighting>& sightings,
                   const std::vector<Join>& joins) {
    set_pose(rig.cameras.front(), {});
    for (const Join& join : joins) {
        set_pose(rig.cameras[join.to],
                 relative_pose(rig, board, sightings, join).after(pose_of(rig.cameras[join.from])));
    }
}

BoardPlaces place_boards(const Rig& rig,
                         const Board& board,
                         const std::vector<Sighting>& sightings) {
    std::map<std::size_t, std::vector<const Sighting*>> by_moment;
    for (const Sighting& sighting : sightings) {
        by_moment[sighting.moment].push_back(&sighting);
    }
    BoardPlaces places;
    for (const auto& [moment, seen] : by_moment) {
        std::optional<RigidMotion> best;
        double least = std::numeric_limits<double>::infinity();
        for (const Sighting* const sighting : seen) {
            const Camera& camera = rig.cameras[sighting->camera];
            for (const BoardPose& pose : board_poses(camera.lens, board, sighting->corners)) {
                const RigidMotion place = pose_of(camera).inverse().after(pose.camera_from_board);
                const double cost = cost_of(place, rig, board, seen);
                if (cost < least) {
                    least = cost;
                    best = place;
                }
            }
        }
        if (best) {
            places[moment] = *best;
        }
    }
    return places;
}

}  // namespace raks::capture
