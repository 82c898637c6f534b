#include "motion/capture/dancer_rig/dancer_sights.hpp"

#include <algorithm>
#include <cmath>

#include <opencv2/calib3d.hpp>

#include "motion/capture/calibration/one_thread.hpp"
#include "motion/capture/triangulation/triangulation.hpp"

#include <glm/geometric.hpp>
#include <glm/gtc/quaternion.hpp>
#include <glm/gtx/quaternion.hpp>
#include <glm/matrix.hpp>

namespace raks::capture {
namespace {

constexpr std::size_t kFewestJoints = 60;  // that two cameras both see
constexpr double kSurest = 0.999;          // of having drawn five good joints once

// Joints that both cameras see, as lists of the same length.
struct SharedJoints {
    std::vector<cv::Point2d> from;
    std::vector<cv::Point2d> to;
    std::vector<std::pair<std::size_t, std::size_t>> which;  // moment, joint
};

SharedJoints shared_joints(const std::vector<DancerMoment>& moments,
                           std::size_t from,
                           std::size_t to) {
    SharedJoints shared;
    for (std::size_t moment = 0; moment < moments.size(); ++moment) {
        for (std::size_t joint = 0; joint < kMainPoints.size(); ++joint) {
            const JointSight& one = moments[moment][from][joint];
            const JointSight& other = moments[moment][to][joint];
            if (one.weight > 0.0 && other.weight > 0.0) {
                shared.from.emplace_back(one.direction.x, one.direction.y);
                shared.to.emplace_back(other.direction.x, other.direction.y);
                shared.which.emplace_back(moment, joint);
            }
        }
    }
    return shared;
}

glm::dmat3 matrix_of(const cv::Mat& matrix) {
    glm::dmat3 result;
    for (int row = 0; row < 3; ++row) {
        for (int column = 0; column < 3; ++column) {
            result[column][row] = matrix.at<double>(row, column);
        }
    }
    return result;
}

double middle_of(std::vector<double> values) {
    const auto middle = values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2);
    std::nth_element(values.begin(), middle, values.end());
    return *middle;
}

// The two cameras alone, the first at the origin, one apart.
Rig rig_of(const CameraPair& pair) {
    const Lens unit{1, 1, 1.0, 1.0, 0.0, 0.0, {}};
    return {{Camera{"from", unit, glm::dmat3(1.0), {}},
             Camera{"to", unit, pair.rotation, pair.translation}}};
}

std::array<PointView, 2> views_of(const SharedJoints& shared, std::size_t joint) {
    return {PointView{0, {shared.from[joint].x, shared.from[joint].y}},
            PointView{1, {shared.to[joint].x, shared.to[joint].y}}};
}

// How many metres one unit of the pair is, by the limbs. None: no limb is seen whole.
std::optional<double> size_of(const SharedJoints& shared,
                              const cv::Mat& agrees,
                              double height,
                              std::size_t moments,
                              const CameraPair& pair) {
    const Rig rig = rig_of(pair);
    std::vector<std::optional<glm::dvec3>> places(moments * kMainPoints.size());
    for (std::size_t i = 0; i < shared.from.size(); ++i) {
        if (agrees.at<unsigned char>(static_cast<int>(i)) != 0) {
            places[shared.which[i].first * kMainPoints.size() + shared.which[i].second] =
                triangulate_linear(rig, views_of(shared, i));
        }
    }
    std::vector<double> sizes;
    for (std::size_t moment = 0; moment < moments; ++moment) {
        for (const DancerLimb& limb : dancer_limbs()) {
            const auto& one = places[moment * kMainPoints.size() + limb.from];
            const auto& other = places[moment * kMainPoints.size() + limb.to];
            if (one && other && glm::distance(*one, *other) > 0.0) {
                sizes.push_back(height * limb_lengths()[limb.length].of_height /
                                glm::distance(*one, *other));
            }
        }
    }
    return sizes.empty() ? std::nullopt : std::optional(middle_of(std::move(sizes)));
}

// Where a camera sees the dancer on average.
glm::dvec3 mean_ray(const std::vector<DancerMoment>& moments, std::size_t camera) {
    glm::dvec3 sum{};
    for (const DancerMoment& moment : moments) {
        for (const JointSight& sight : moment[camera]) {
            sum += sight.weight * glm::dvec3(sight.direction, 1.0);
        }
    }
    return sum.z > 0.0 ? glm::normalize(sum) : glm::dvec3(0.0, 0.0, 1.0);
}

// An upright camera that sees the dancer, who stands at the origin, where it does.
Camera upright_camera(const glm::dvec3& ray, double angle, double distance) {
    const double turn = angle * M_PI / 180.0;
    Camera camera =
        looking_at("", Lens{}, {distance * std::sin(turn), 0.0, distance * std::cos(turn)}, {});
    const glm::dmat3 aside = glm::mat3_cast(glm::rotation(glm::dvec3(0.0, 0.0, 1.0), ray));
    camera.rotation = aside * camera.rotation;
    camera.translation = aside * camera.translation;
    return camera;
}

std::size_t seen_joints(const KeypointTake& take, std::size_t frame, std::size_t camera) {
    return static_cast<std::size_t>(
        std::count_if(kMainPoints.begin(), kMainPoints.end(), [&](BodyPoint point) {
            return take.point(frame, camera, point).visibility >= kSureVisibility;
        }));
}

}  // namespace

std::vector<DancerMoment> dancer_moments(const KeypointTake& take,
                                         const std::vector<Lens>& lenses,
                                         std::size_t most) {
    std::vector<std::size_t> good;
    for (std::size_t frame = 0; frame < take.frame_count; ++frame) {
        std::size_t cameras = 0;
        for (std::size_t camera = 0; camera < take.cameras; ++camera) {
            cameras += seen_joints(take, frame, camera) * 2 >= kMainPoints.size() ? 1U : 0U;
        }
        if (cameras >= 2) {
            good.push_back(frame);
        }
    }
    std::vector<DancerMoment> moments;
    const std::size_t count = std::min(most, good.size());
    for (std::size_t i = 0; i < count; ++i) {
        const std::size_t frame = good[i * good.size() / count];
        DancerMoment moment(take.cameras);
        for (std::size_t camera = 0; camera < take.cameras; ++camera) {
            for (std::size_t joint = 0; joint < kMainPoints.size(); ++joint) {
                const Keypoint& point = take.point(frame, camera, kMainPoints[joint]);
                if (point.visibility >= kSureVisibility) {
                    moment[camera][joint] = {direction_of(lenses[camera], point.pixel),
                                             point.visibility};
                }
            }
        }
        moments.push_back(std::move(moment));
    }
    return moments;
}

std::optional<CameraPair> find_pair(const std::vector<DancerMoment>& moments,
                                    std::size_t from,
                                    std::size_t to,
                                    double error,
                                    double height) {
    use_one_thread();
    const SharedJoints shared = shared_joints(moments, from, to);
    if (shared.from.size() < kFewestJoints) {
        return std::nullopt;
    }
    // OpenCV draws from a generator of its own that starts anew each time: the same joints give the
    // same matrix.
    const cv::Mat identity = cv::Mat::eye(3, 3, CV_64F);
    cv::Mat agrees;
    const cv::Mat essential = cv::findEssentialMat(
        shared.from, shared.to, identity, cv::RANSAC, kSurest, 0.7 * error, agrees);
    if (essential.rows != 3) {
        return std::nullopt;
    }
    cv::Mat rotation;
    cv::Mat translation;
    const int in_front =
        cv::recoverPose(essential, shared.from, shared.to, identity, rotation, translation, agrees);
    CameraPair pair;
    pair.from = from;
    pair.to = to;
    pair.rotation = matrix_of(rotation);
    pair.translation = {
        translation.at<double>(0), translation.at<double>(1), translation.at<double>(2)};
    const auto size =
        in_front > 0 ? size_of(shared, agrees, height, moments.size(), pair) : std::nullopt;
    if (!size) {
        return std::nullopt;
    }
    pair.translation *= *size;
    return pair;
}

CameraPair guess_pair(const std::vector<DancerMoment>& moments,
                      std::size_t from,
                      std::size_t to,
                      double angle,
                      const std::vector<double>& sizes,
                      double height) {
    const Camera one = upright_camera(mean_ray(moments, from), 0.0, height / sizes[from]);
    const Camera other = upright_camera(mean_ray(moments, to), angle, height / sizes[to]);
    CameraPair pair;
    pair.from = from;
    pair.to = to;
    pair.rotation = other.rotation * glm::transpose(one.rotation);
    pair.translation = other.translation - pair.rotation * one.translation;
    return pair;
}

void measure_pair(const std::vector<DancerMoment>& moments, double error, CameraPair& pair) {
    constexpr double kAgrees = 3.0;  // errors
    const SharedJoints shared = shared_joints(moments, pair.from, pair.to);
    const Rig rig = rig_of(pair);
    std::vector<double> angles;
    std::size_t agreeing = 0;
    for (std::size_t i = 0; i < shared.from.size(); ++i) {
        const auto views = views_of(shared, i);
        const double off =
            std::max(epipolar_distance(
                         rig.cameras[0], views[0].direction, rig.cameras[1], views[1].direction),
                     epipolar_distance(
                         rig.cameras[1], views[1].direction, rig.cameras[0], views[0].direction));
        const auto place = triangulate_linear(rig, views);
        const bool is_ahead = place && rig.cameras[0].in_camera(*place).z > 0.0 &&
                              rig.cameras[1].in_camera(*place).z > 0.0;
        if (is_ahead && off < kAgrees * error) {
            ++agreeing;
            angles.push_back(angle_at(rig.cameras[0], rig.cameras[1], *place));
        }
    }
    pair.shared = shared.from.size();
    pair.agreeing = static_cast<double>(agreeing) /
                    static_cast<double>(std::max<std::size_t>(1, shared.from.size()));
    pair.angle = angles.empty() ? 0.0 : middle_of(std::move(angles));
}

double angle_at(const Camera& one, const Camera& other, const glm::dvec3& place) {
    const glm::dvec3 a = one.centre() - place;
    const glm::dvec3 b = other.centre() - place;
    return std::atan2(glm::length(glm::cross(a, b)), glm::dot(a, b)) * 180.0 / M_PI;
}

}  // namespace raks::capture
