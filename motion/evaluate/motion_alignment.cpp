#include "motion/evaluate/motion_alignment.hpp"

#include <Eigen/Dense>

#include <algorithm>
#include <cmath>
#include <vector>

#include <glm/common.hpp>

namespace raks::motion {
namespace {

// Joints of both motions at the same moments, a column each.
struct JointPairs {
    std::vector<double> one;
    std::vector<double> other;

    void add(const glm::dvec3& a, const glm::dvec3& b) {
        one.insert(one.end(), {a.x, a.y, a.z});
        other.insert(other.end(), {b.x, b.y, b.z});
    }
};

JointPairs pairs_of(const BodyTrack& one, const BodyTrack& other, double shift) {
    JointPairs pairs;
    for (std::size_t frame = 0; frame < one.frames(); ++frame) {
        const double at =
            (static_cast<double>(frame) / one.frames_per_second - shift) * other.frames_per_second;
        if (at < 0.0 || at > static_cast<double>(other.frames()) - 1.0) {
            continue;
        }
        const auto before = static_cast<std::size_t>(at);
        const std::size_t after = std::min(before + 1, other.frames() - 1);
        const double share = at - static_cast<double>(before);
        for (std::size_t joint = 0; joint < kBodyBones.size(); ++joint) {
            pairs.add(one.joints[frame][joint],
                      glm::mix(other.joints[before][joint], other.joints[after][joint], share));
        }
    }
    return pairs;
}

}  // namespace

Expected<MotionAlignment> align_motion(const BodyTrack& one, BodyTrack& other, double shift) {
    const JointPairs pairs = pairs_of(one, other, shift);
    if (pairs.one.empty()) {
        return fail("the two motions have no moment in common; is the shift right?");
    }
    const auto columns = static_cast<Eigen::Index>(pairs.one.size() / 3);
    const Eigen::Map<const Eigen::Matrix3Xd> to(pairs.one.data(), 3, columns);
    const Eigen::Map<const Eigen::Matrix3Xd> from(pairs.other.data(), 3, columns);
    MotionAlignment found;
    // What would fit best if vertical and size were free (Umeyama 1991).
    const Eigen::Matrix4d free = Eigen::umeyama(from, to, true);
    const double growth = std::cbrt(free.topLeftCorner<3, 3>().determinant());
    found.scale = 1.0 / growth;
    found.tilt = std::acos(std::clamp(free(1, 1) / growth, -1.0, 1.0)) * 180.0 / M_PI;
    // Turned about y by `angle`, (x, z) is (x cos + z sin, z cos - x sin): the angle of the sums.
    const Eigen::Vector3d middle_to = to.rowwise().mean();
    const Eigen::Vector3d middle_from = from.rowwise().mean();
    const Eigen::Matrix3d sums =
        (to.colwise() - middle_to) * (from.colwise() - middle_from).transpose();
    const double angle = std::atan2(sums(0, 2) - sums(2, 0), sums(0, 0) + sums(2, 2));
    const double cosine = std::cos(angle);
    const double sine = std::sin(angle);
    const auto turned = [&](const glm::dvec3& v) {
        return glm::dvec3(v.x * cosine + v.z * sine, v.y, v.z * cosine - v.x * sine);
    };
    found.turn = angle * 180.0 / M_PI;
    found.move = glm::dvec3(middle_to.x(), middle_to.y(), middle_to.z()) -
                 turned({middle_from.x(), middle_from.y(), middle_from.z()});
    const auto place = [&](glm::dvec3& v) { v = turned(v) + found.move; };
    for (std::size_t frame = 0; frame < other.frames(); ++frame) {
        std::for_each(other.joints[frame].begin(), other.joints[frame].end(), place);
        for (SourceFoot& foot : other.feet[frame]) {
            place(foot.ankle);
            place(foot.toe_tip);
        }
    }
    return found;
}

}  // namespace raks::motion
