#include "motion/figures/motion_features.hpp"

#include <Eigen/Core>
#include <Eigen/Eigenvalues>
#include <cmath>

#include "base/assert.hpp"

namespace raks::motion {
namespace {

// Column of a root feature.
constexpr std::size_t column(RootFeature feature) noexcept {
    return static_cast<std::size_t>(feature);
}

glm::dquat turn_about_y(double angle) noexcept {
    return {std::cos(angle / 2), 0.0, std::sin(angle / 2), 0.0};
}

/// Floor coordinates (x, z) turned from the heading's frame into the world's.
glm::dvec2 turned(const glm::dvec2& local, double heading) noexcept {
    const double c = std::cos(heading);
    const double s = std::sin(heading);
    return {c * local.x + s * local.y, c * local.y - s * local.x};
}

/// The same angle in (-pi, pi].
double wrapped(double angle) noexcept { return std::remainder(angle, 2.0 * M_PI); }

// Place and heading of the hips on the floor.
RootPlace place_of(const Pose& pose) noexcept {
    return {{static_cast<double>(pose.hips_position.x), static_cast<double>(pose.hips_position.z)},
            heading_of(glm::dquat(pose.rotation(Bone::hips)))};
}

void write(const glm::dvec3& value, std::span<double> row, std::size_t at) noexcept {
    row[at] = value.x;
    row[at + 1] = value.y;
    row[at + 2] = value.z;
}

/// Writes the first three root features: velocities and yaw rate from pose i to the next, a beat.
void write_travel(std::span<const Pose> poses,
                  std::size_t i,
                  double samples_per_beat,
                  std::span<double> row) {
    // The last pose has no next one: it repeats the step before.
    const std::size_t from = i + 1 < poses.size() ? i : i - 1;
    const RootPlace a = place_of(poses[from]);
    const RootPlace b = place_of(poses[from + 1]);
    // The shorter way round: between two samples nobody turns half a turn.
    const double turn = wrapped(b.heading - a.heading);
    // In the heading halfway through the turn, so that a circle has a constant velocity.
    const glm::dvec2 step = turned(b.position - a.position, -(a.heading + turn / 2));
    row[column(RootFeature::velocity_left)] = step.x * samples_per_beat;
    row[column(RootFeature::velocity_forward)] = step.y * samples_per_beat;
    row[column(RootFeature::yaw_rate)] = turn * samples_per_beat;
}

/// Writes the other three root features: height and tilts.
void write_stance(const Pose& pose, std::span<double> row) {
    row[column(RootFeature::height)] = static_cast<double>(pose.hips_position.y);
    const glm::dquat hips(pose.rotation(Bone::hips));
    const glm::dvec3 tilt = exponential_map(turn_about_y(-heading_of(hips)) * hips);
    row[column(RootFeature::tilt_x)] = tilt.x;
    row[column(RootFeature::tilt_z)] = tilt.z;
}

// Rotations relative to each joint's mean, where the exponential map is nearly linear.
void write_angles(const Pose& pose, const PartModel& part, std::span<double> row) {
    std::size_t at = 0;
    for (const JointFeature& joint : part.joints) {
        const glm::dquat local(pose.rotation(joint.bone));
        write(exponential_map(glm::conjugate(joint.mean) * local), row, at);
        at += 3;
    }
}

// Places seen from the point on the floor under the hips, in their heading.
void write_places(const Pose& pose,
                  const PartModel& part,
                  const Skeleton& body,
                  std::span<double> row) {
    const WorldPose world = world_pose(body, pose);
    const RootPlace place = place_of(pose);
    std::size_t at = 0;
    for (const JointFeature& joint : part.joints) {
        const glm::dvec3 joint_place(world.position(joint.bone));
        const glm::dvec2 away = turned(
            {joint_place.x - place.position.x, joint_place.z - place.position.y}, -place.heading);
        write({away.x, joint_place.y, away.y}, row, at);
        at += 3;
    }
}

}  // namespace

glm::dvec3 exponential_map(const glm::dquat& rotation) noexcept {
    // Of q and -q the one with the smaller angle.
    const glm::dquat q = rotation.w < 0.0 ? -rotation : rotation;
    const glm::dvec3 v(q.x, q.y, q.z);
    const double sine = std::sqrt(glm::dot(v, v));
    constexpr double kTiny = 1e-12;  // below it angle / sine is 2 to double precision
    return v * (sine < kTiny ? 2.0 : 2.0 * std::atan2(sine, q.w) / sine);
}

glm::dquat rotation_from(const glm::dvec3& exponential_map) noexcept {
    const double angle = std::sqrt(glm::dot(exponential_map, exponential_map));
    constexpr double kTiny = 1e-12;
    const double factor = angle < kTiny ? 0.5 : std::sin(angle / 2) / angle;
    const glm::dvec3 v = exponential_map * factor;
    return {std::cos(angle / 2), v.x, v.y, v.z};
}

double heading_of(const glm::dquat& rotation) noexcept {
    // Swing-twist decomposition about y.
    return wrapped(2.0 * std::atan2(rotation.y, rotation.w));
}

glm::dquat mean_rotation(std::span<const glm::dquat> rotations, std::span<const double> weights) {
    RAKS_ASSERT(rotations.size() == weights.size());
    Eigen::Matrix4d sum = Eigen::Matrix4d::Zero();
    for (std::size_t i = 0; i < rotations.size(); ++i) {
        // The outer product does not change with the sign of q.
        const Eigen::Vector4d q(rotations[i].w, rotations[i].x, rotations[i].y, rotations[i].z);
        sum += weights[i] * q * q.transpose();
    }
    // No weight at all: no rotation.
    if (sum.isZero(0.0)) {
        return {1.0, 0.0, 0.0, 0.0};
    }
    const Eigen::SelfAdjointEigenSolver<Eigen::Matrix4d> solver(sum);
    const Eigen::Vector4d q = solver.eigenvectors().col(3);  // of the largest eigenvalue
    const double sign = q[0] < 0.0 ? -1.0 : 1.0;
    return {sign * q[0], sign * q[1], sign * q[2], sign * q[3]};
}

FeatureTrack features_of(std::span<const Pose> poses,
                         const PartModel& part,
                         int samples_per_beat,
                         const Skeleton& body) {
    const std::size_t root = part.root_features();
    RAKS_ASSERT(root == 0 || poses.size() >= 2);
    FeatureTrack track{part.dimension(), {}};
    track.values.resize(poses.size() * track.columns);
    for (std::size_t i = 0; i < poses.size(); ++i) {
        const std::span<double> row = track.row(i);
        if (root > 0) {
            write_travel(poses, i, samples_per_beat, row);
        }
        if (root == kRootFeatures) {
            write_stance(poses[i], row);
        }
        if (part.features == FigureFeatures::positions) {
            write_places(poses[i], part, body, row.subspan(root));
        } else {
            write_angles(poses[i], part, row.subspan(root));
        }
    }
    return track;
}

std::vector<RootPlace> integrate_root(const FeatureTrack& root,
                                      int samples_per_beat,
                                      const RootPlace& start,
                                      double scale) {
    std::vector<RootPlace> places(root.rows() + 1, start);
    for (std::size_t i = 0; i < root.rows(); ++i) {
        const std::span<const double> row = root.row(i);
        const double turn = row[column(RootFeature::yaw_rate)] / samples_per_beat;
        const glm::dvec2 step(row[column(RootFeature::velocity_left)],
                              row[column(RootFeature::velocity_forward)]);
        // Midpoint rule: the inverse of write_travel().
        places[i + 1].heading = places[i].heading + turn;
        places[i + 1].position = places[i].position + turned(step * (scale / samples_per_beat),
                                                             places[i].heading + turn / 2);
    }
    return places;
}

std::vector<RootPlace> integrate_root(const FeatureTrack& root,
                                      int samples_per_beat,
                                      const RootPlace& start,
                                      double scale,
                                      const NetMotion& net) {
    const std::size_t rows = root.rows();
    if (rows == 0) {
        return {start};
    }
    const double n = static_cast<double>(rows);
    // The turn is corrected before the steps are integrated, as it changes their directions.
    double turn = 0.0;
    for (std::size_t i = 0; i < rows; ++i) {
        turn += root.row(i)[column(RootFeature::yaw_rate)] / samples_per_beat;
    }
    // Each row turns a little more or less, so that all together turn by net.turn.
    FeatureTrack steered = root;
    for (std::size_t i = 0; i < rows; ++i) {
        steered.row(i)[column(RootFeature::yaw_rate)] += (net.turn - turn) / n * samples_per_beat;
    }
    std::vector<RootPlace> places = integrate_root(steered, samples_per_beat, start, scale);
    const glm::dvec2 end = start.position + turned(net.displacement * scale, start.heading);
    // What is still missing in place grows linearly over the figure.
    const glm::dvec2 missing = end - places[rows].position;
    for (std::size_t i = 0; i <= rows; ++i) {
        places[i].position += missing * (static_cast<double>(i) / n);
    }
    return places;
}

void apply_features(std::span<const double> row,
                    const PartModel& part,
                    const RootPlace& place,
                    double scale,
                    Pose& pose) noexcept {
    std::size_t at = 0;
    if (part.part == Part::torso) {
        const glm::dvec3 tilt(
            row[column(RootFeature::tilt_x)], 0.0, row[column(RootFeature::tilt_z)]);
        // Heading from the integrated place, tilt from the row.
        pose.rotation(Bone::hips) = glm::quat(turn_about_y(place.heading) * rotation_from(tilt));
        pose.hips_position = glm::vec3(glm::dvec3(
            place.position.x, row[column(RootFeature::height)] * scale, place.position.y));
        at = kRootFeatures;
    }
    for (const JointFeature& joint : part.joints) {
        const glm::dvec3 value(row[at], row[at + 1], row[at + 2]);
        pose.rotation(joint.bone) = glm::quat(joint.mean * rotation_from(value));
        at += 3;
    }
}

glm::dvec3 world_place(std::span<const double> local,
                       const RootPlace& place,
                       double scale) noexcept {
    const glm::dvec2 away = turned({local[0] * scale, local[2] * scale}, place.heading);
    return {place.position.x + away.x, local[1] * scale, place.position.y + away.y};
}

Skeleton source_body(const FigureModel& model) noexcept {
    // Scaled by the hips' height alone: proportions are the built-in ones.
    const Skeleton& built_in = mannequin_skeleton();
    return scaled(built_in, static_cast<float>(model.source_hips_height) / built_in.hips_height());
}

}  // namespace raks::motion
