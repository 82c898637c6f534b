#include "motion/capture/markerless/dancer_floor.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>
#include <string>
#include <vector>

#include "motion/capture/keypoints/keypoints.hpp"
#include "motion/capture/markerless/keypoint_markers.hpp"
#include "motion/capture/markerless/keypoint_tracks.hpp"
#include "motion/capture/solving/body_size.hpp"
#include "motion/skeleton/skeleton.hpp"

#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <glm/matrix.hpp>

namespace raks::capture {
namespace {

// Measured on rendered dancers: ankles that stand then move at 0.13 m/s (nine in ten below 0.22),
// those that step at 0.58 (one in ten) or more.
constexpr double kSmoothing = 0.08;      // seconds
constexpr double kPlantedSpeed = 0.3;    // m/s
constexpr double kShortestStand = 0.12;  // seconds
constexpr std::size_t kFewestSteps = 6;
// Metres of standing toes' height.
constexpr double kStepDeviation = 0.1;
// A network sees toes higher or lower the same way each time they stand in one place, so that many
// steps tell no more than so many.
constexpr double kMostStepsTold = 20.0;
constexpr double kLeanDeviation = 0.05;  // radians of the body's mean lean
// Radians by which the pictures of a phone on a shelf or tripod are turned, and beyond which they
// are turned on purpose and count a quarter and less.
constexpr double kRollDeviation = 0.05;
constexpr double kMostRoll = 0.15;
constexpr double kMostLean = 0.6;  // radians of a body that stands

constexpr std::array<BodyPoint, 6> kFeet = {BodyPoint::left_ankle,
                                            BodyPoint::right_ankle,
                                            BodyPoint::left_heel,
                                            BodyPoint::right_heel,
                                            BodyPoint::left_foot_index,
                                            BodyPoint::right_foot_index};

// A point of a foot while it stood.
constexpr std::size_t kToesKind = 2;
struct Step {
    glm::dvec3 place{};
    std::size_t kind = 0;  // ankle, heel, toes
};

// How far along `up` the steps of one kind are.
std::vector<double> heights_of(const std::vector<Step>& steps,
                               std::size_t kind,
                               const glm::dvec3& up) {
    std::vector<double> heights;
    for (const Step& step : steps) {
        if (step.kind == kind) {
            heights.push_back(glm::dot(step.place, up));
        }
    }
    return heights;
}

class DancerSights {
 public:
    explicit DancerSights(const Tracks& tracks) : tracks_(tracks) {
        const auto points = followed_points();
        for (std::size_t i = 0; i < points.size(); ++i) {
            marker_of_[static_cast<std::size_t>(points[i])] = i;
        }
    }
    [[nodiscard]] std::size_t frames() const { return tracks_.frame_count; }
    [[nodiscard]] double rate() const { return tracks_.frames_per_second; }
    [[nodiscard]] std::optional<glm::dvec3> at(std::size_t frame, BodyPoint point) const {
        const MarkerPlace& place = tracks_.at(frame, marker_of_[static_cast<std::size_t>(point)]);
        return place.source == PlaceSource::lost ? std::nullopt : std::optional(place.place);
    }
    // The middle of several; none: one is not seen.
    [[nodiscard]] std::optional<glm::dvec3> middle(std::size_t frame,
                                                   std::span<const BodyPoint> points) const {
        glm::dvec3 sum{};
        for (const BodyPoint point : points) {
            const auto place = at(frame, point);
            if (!place) {
                return std::nullopt;
            }
            sum += *place;
        }
        return sum / static_cast<double>(points.size());
    }

 private:
    const Tracks& tracks_;
    std::array<std::size_t, kBodyPoints> marker_of_{};
};

double middle_of(std::vector<double> values) {
    const auto middle = values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2);
    std::nth_element(values.begin(), middle, values.end());
    return *middle;
}

std::vector<Step> steps_of(const DancerSights& sights) {
    std::vector<Step> steps;
    for (std::size_t i = 0; i < kFeet.size(); ++i) {
        glm::dvec3 sum{};
        std::size_t count = 0;
        for (std::size_t frame = 1; frame <= sights.frames(); ++frame) {
            const bool is_inside = frame + 1 < sights.frames();
            const auto before = is_inside ? sights.at(frame - 1, kFeet[i]) : std::nullopt;
            const auto here = is_inside ? sights.at(frame, kFeet[i]) : std::nullopt;
            const auto after = is_inside ? sights.at(frame + 1, kFeet[i]) : std::nullopt;
            const bool stands =
                before && here && after &&
                glm::distance(*before, *after) * 0.5 * sights.rate() < kPlantedSpeed;
            if (stands) {
                sum += *here;
                ++count;
                continue;
            }
            if (static_cast<double>(count) >= kShortestStand * sights.rate()) {
                steps.push_back({sum / static_cast<double>(count), i / 2});
            }
            sum = {};
            count = 0;
        }
    }
    return steps;
}

// A part of the body: its share of the mass, and how far along it its centre lies; rounded from
// Winter, Biomechanics and Motor Control of Human Movement, table 4.1. The right side is alike.
struct BodyPart {
    BodyPoint from;
    BodyPoint to;
    double mass;
    double centre;
};
constexpr std::array<BodyPart, 13> kParts = {{
    {BodyPoint::left_ear, BodyPoint::right_ear, 0.08, 0.5},
    {BodyPoint::left_shoulder, BodyPoint::left_hip, 0.25, 0.5},
    {BodyPoint::right_shoulder, BodyPoint::right_hip, 0.25, 0.5},
    {BodyPoint::left_shoulder, BodyPoint::left_elbow, 0.027, 0.44},
    {BodyPoint::right_shoulder, BodyPoint::right_elbow, 0.027, 0.44},
    {BodyPoint::left_elbow, BodyPoint::left_wrist, 0.023, 0.6},
    {BodyPoint::right_elbow, BodyPoint::right_wrist, 0.023, 0.6},
    {BodyPoint::left_hip, BodyPoint::left_knee, 0.1, 0.43},
    {BodyPoint::right_hip, BodyPoint::right_knee, 0.1, 0.43},
    {BodyPoint::left_knee, BodyPoint::left_ankle, 0.046, 0.43},
    {BodyPoint::right_knee, BodyPoint::right_ankle, 0.046, 0.43},
    {BodyPoint::left_ankle, BodyPoint::left_foot_index, 0.014, 0.5},
    {BodyPoint::right_ankle, BodyPoint::right_foot_index, 0.014, 0.5},
}};

// The body's centre of mass; none: less than nine tenths of it are seen, arms but for one.
std::optional<glm::dvec3> centre_of_mass(const DancerSights& sights, std::size_t frame) {
    constexpr double kEnough = 0.9;
    glm::dvec3 sum{};
    double mass = 0.0;
    for (const BodyPart& part : kParts) {
        const auto from = sights.at(frame, part.from);
        const auto to = sights.at(frame, part.to);
        if (from && to) {
            sum += part.mass * glm::mix(*from, *to, part.centre);
            mass += part.mass;
        }
    }
    return mass >= kEnough ? std::optional(sum / mass) : std::nullopt;
}

// From the ground to the centre of mass, on average over the take: who does not fall carries it
// over the feet, however the trunk is held. Weight rests a quarter of the way from ankles to toes.
// None: never seen whole.
std::optional<glm::dvec3> mean_lean(const DancerSights& sights) {
    constexpr std::array<BodyPoint, 2> kAnkles = {BodyPoint::left_ankle, BodyPoint::right_ankle};
    constexpr std::array<BodyPoint, 2> kToes = {BodyPoint::left_foot_index,
                                                BodyPoint::right_foot_index};
    constexpr double kTowardsToes = 0.25;
    std::array<std::vector<double>, 3> axes;
    for (std::size_t frame = 0; frame < sights.frames(); ++frame) {
        const auto ankles = sights.middle(frame, kAnkles);
        const auto toes = sights.middle(frame, kToes);
        const auto centre = centre_of_mass(sights, frame);
        const auto ground =
            ankles && toes ? std::optional(glm::mix(*ankles, *toes, kTowardsToes)) : std::nullopt;
        if (ground && centre && glm::distance(*ground, *centre) > 0.1) {
            const glm::dvec3 up = glm::normalize(*centre - *ground);
            for (glm::length_t axis = 0; axis < 3; ++axis) {
                axes[static_cast<std::size_t>(axis)].push_back(up[axis]);
            }
        }
    }
    if (axes[0].empty()) {
        return std::nullopt;
    }
    const glm::dvec3 lean(middle_of(axes[0]), middle_of(axes[1]), middle_of(axes[2]));
    return glm::length(lean) > 0.5 ? std::optional(glm::normalize(lean)) : std::nullopt;
}

// Up by the toes that stood, by the lean, and by the cameras, whose rows are mostly level. All toes
// that stand are at one height. Ankles and heels are not: who steps ahead and back lifts the heel
// that is behind, always on the same side.
glm::dvec3 vertical_of(const std::vector<Step>& steps, const glm::dvec3& lean, const Rig& rig) {
    const glm::dvec3 side = glm::normalize(
        glm::cross(lean, std::abs(lean.x) < 0.7 ? glm::dvec3(1, 0, 0) : glm::dvec3(0, 1, 0)));
    const glm::dvec3 ahead = glm::cross(lean, side);
    std::vector<glm::dvec3> toes;
    for (const Step& step : steps) {
        if (step.kind == kToesKind) {
            toes.push_back(step.place);
        }
    }
    const double share =
        std::min(1.0, kMostStepsTold / static_cast<double>(std::max<std::size_t>(1, toes.size())));
    // Up is lean + a side + b ahead.
    glm::dvec2 tilt{};
    for (int round = 0; round < 8; ++round) {
        const glm::dvec3 up = lean + tilt.x * side + tilt.y * ahead;
        glm::dmat2 matrix(1.0 / (kLeanDeviation * kLeanDeviation));
        glm::dvec2 vector{};
        for (const Camera& camera : rig.cameras) {
            const glm::dvec3 row = glm::transpose(camera.rotation) * glm::dvec3(1.0, 0.0, 0.0);
            const double roll = glm::dot(row, up);
            const double trust = 1.0 / (1.0 + roll * roll / (kMostRoll * kMostRoll));
            const double weight = trust * trust / (kRollDeviation * kRollDeviation);
            const glm::dvec2 at(glm::dot(row, side), glm::dot(row, ahead));
            matrix += weight * glm::outerProduct(at, at);
            vector -= weight * glm::dot(row, lean) * at;
        }
        const double usual = toes.empty() ? 0.0 : middle_of(heights_of(steps, kToesKind, up));
        const auto weight_of = [&](const glm::dvec3& place) {
            const double off = glm::dot(place, up) - usual;
            return share / (kStepDeviation * kStepDeviation + off * off);
        };
        double weights = 0.0;
        glm::dvec3 mean{};
        for (const glm::dvec3& place : toes) {
            weights += weight_of(place);
            mean += weight_of(place) * place;
        }
        mean = weights > 0.0 ? mean / weights : mean;
        for (const glm::dvec3& place : toes) {
            const double weight = weight_of(place);
            const glm::dvec3 off = place - mean;
            const glm::dvec2 at(glm::dot(off, side), glm::dot(off, ahead));
            matrix += weight * glm::outerProduct(at, at);
            vector -= weight * glm::dot(off, lean) * at;
        }
        tilt = glm::inverse(matrix) * vector;
    }
    return glm::normalize(lean + tilt.x * side + tilt.y * ahead);
}

// Height of the floor along `up`: where standing ankles, heels and toes are lowest, less their
// heights over the sole.
double floor_height(const std::vector<Step>& steps,
                    const glm::dvec3& up,
                    double height,
                    double& spread) {
    const motion::Skeleton& body = motion::mannequin_skeleton();
    const double whole = height / kMannequinHeight;
    // The sole lies as far below the ankle as the ball of the foot.
    const double ankle = -static_cast<double>(body.ball.y) * whole;
    const std::array<double, 3> over = {ankle, 0.02 * whole, 0.02 * whole};
    std::vector<double> floors;
    std::vector<double> misses;
    for (std::size_t kind = 0; kind < 3; ++kind) {
        std::vector<double> heights = heights_of(steps, kind, up);
        if (heights.empty()) {
            continue;
        }
        // Raised heels are common, lowered floors are not.
        std::sort(heights.begin(), heights.end());
        const double usual = heights[heights.size() * 2 / 5];
        floors.push_back(usual - over[kind]);
        for (const double at : heights) {
            misses.push_back(std::abs(at - usual));
        }
    }
    spread = middle_of(misses);
    return middle_of(floors);
}

}  // namespace

Expected<DancerFloor> put_on_dancers_floor(Rig& rig, const Tracks& tracks, double height) {
    const Tracks smooth = smoothed_tracks(tracks, kSmoothing);
    const DancerSights sights(smooth);
    const auto lean = mean_lean(sights);
    if (!lean) {
        return fail(
            "the dancer's feet and trunk are never seen at once by two cameras, so nobody can tell "
            "where the floor is: the whole body must be in view");
    }
    const std::vector<Step> steps = steps_of(sights);
    if (steps.size() < kFewestSteps) {
        return fail(
            "the dancer's feet are hardly seen standing, so nobody can tell where the floor is: "
            "both feet must be in view of two cameras");
    }
    const glm::dvec3 up = vertical_of(steps, *lean, rig);
    DancerFloor floor;
    floor.steps = steps.size();
    floor.disagreement = std::acos(std::clamp(glm::dot(up, *lean), -1.0, 1.0)) * 180.0 / M_PI;
    if (floor.disagreement > kMostLean * 180.0 / M_PI) {
        return fail("the dancer does not stand upright: lying dances need a board on the floor");
    }
    const double ground = floor_height(steps, up, height, floor.spread);
    // The dancer's mean place on the floor, and the first camera ahead of it.
    glm::dvec3 mean{};
    for (const Step& step : steps) {
        mean += step.place / static_cast<double>(steps.size());
    }
    const glm::dvec3 origin = mean + (ground - glm::dot(mean, up)) * up;
    const glm::dvec3 to_camera = rig.cameras.front().centre() - origin;
    const glm::dvec3 z = glm::normalize(to_camera - glm::dot(to_camera, up) * up);
    const glm::dvec3 x = glm::cross(up, z);
    const glm::dmat3 old_from_new(x, up, z);
    for (Camera& camera : rig.cameras) {
        camera.translation += camera.rotation * origin;
        camera.rotation = camera.rotation * old_from_new;
    }
    return floor;
}

}  // namespace raks::capture
