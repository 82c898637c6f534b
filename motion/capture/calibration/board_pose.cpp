#include "motion/capture/calibration/board_pose.hpp"

#include <algorithm>
#include <cmath>

#include <opencv2/calib3d.hpp>

#include "motion/capture/calibration/one_thread.hpp"
#include "motion/capture/camera/rotation.hpp"

#include <glm/geometric.hpp>
#include <glm/matrix.hpp>

namespace raks::capture {

namespace {

// Whether the corners of a board lie in one row or column, or on another line.
bool are_in_line(const Board& board, const std::vector<BoardCorner>& corners) {
    const glm::dvec2 first = corner_place(board, corners.front().corner) / board.square;
    glm::dvec2 along{};
    for (const BoardCorner& corner : corners) {
        const glm::dvec2 way = corner_place(board, corner.corner) / board.square - first;
        if (along == glm::dvec2{}) {
            along = way;
        } else if (std::abs(along.x * way.y - along.y * way.x) > 1e-6) {
            return false;
        }
    }
    return true;
}

glm::dvec3 vector_of(const cv::Mat& m) {
    return {m.at<double>(0), m.at<double>(1), m.at<double>(2)};
}

}  // namespace

RigidMotion RigidMotion::after(const RigidMotion& before) const noexcept {
    return {rotation * before.rotation, rotation * before.translation + translation};
}

RigidMotion RigidMotion::inverse() const noexcept {
    const glm::dmat3 back = glm::transpose(rotation);
    return {back, -(back * translation)};
}

RigidMotion pose_of(const Camera& camera) noexcept { return {camera.rotation, camera.translation}; }

void set_pose(Camera& camera, const RigidMotion& camera_from_world) noexcept {
    camera.rotation = camera_from_world.rotation;
    camera.translation = camera_from_world.translation;
}

std::vector<BoardPose> board_poses(const Lens& lens,
                                   const Board& board,
                                   const std::vector<BoardCorner>& corners) {
    if (corners.size() < kFewestBoardCorners || are_in_line(board, corners)) {
        return {};
    }
    use_one_thread();
    std::vector<cv::Point3d> places;
    std::vector<cv::Point2d> directions;
    for (const BoardCorner& corner : corners) {
        const glm::dvec2 place = corner_place(board, corner.corner);
        const glm::dvec2 direction = direction_of(lens, corner.pixel);
        places.emplace_back(place.x, place.y, 0.0);
        directions.emplace_back(direction.x, direction.y);
    }
    std::vector<cv::Mat> turns;
    std::vector<cv::Mat> shifts;
    const cv::Mat straight = cv::Mat::eye(3, 3, CV_64F);
    const int found = cv::solvePnPGeneric(
        places, directions, straight, cv::noArray(), turns, shifts, false, cv::SOLVEPNP_IPPE);
    std::vector<BoardPose> poses;
    for (std::size_t i = 0; i < static_cast<std::size_t>(std::max(found, 0)); ++i) {
        cv::solvePnPRefineLM(places, directions, straight, cv::noArray(), turns[i], shifts[i]);
        BoardPose pose;
        pose.camera_from_board = {rotation_of(vector_of(turns[i])), vector_of(shifts[i])};
        pose.rms = reprojection_rms(lens, board, pose.camera_from_board, corners);
        if (std::isfinite(pose.rms)) {
            poses.push_back(pose);
        }
    }
    std::stable_sort(poses.begin(), poses.end(), [](const BoardPose& a, const BoardPose& b) {
        return a.rms < b.rms;
    });
    return poses;
}

double reprojection_rms(const Lens& lens,
                        const Board& board,
                        const RigidMotion& camera_from_board,
                        const std::vector<BoardCorner>& corners) {
    constexpr double kBehind = 1000.0;  // pixels
    const Camera camera{{}, lens, camera_from_board.rotation, camera_from_board.translation};
    double sum = 0.0;
    for (const BoardCorner& corner : corners) {
        const auto pixel = project(camera, glm::dvec3(corner_place(board, corner.corner), 0.0));
        const double miss = pixel ? glm::distance(*pixel, corner.pixel) : kBehind;
        sum += miss * miss;
    }
    return corners.empty() ? 0.0 : std::sqrt(sum / static_cast<double>(corners.size()));
}

}  // namespace raks::capture
