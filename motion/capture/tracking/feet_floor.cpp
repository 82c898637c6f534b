#include "motion/capture/tracking/feet_floor.hpp"

#include <algorithm>
#include <cmath>
#include <map>
#include <string>
#include <tuple>
#include <vector>

#include <Eigen/Dense>

#include "motion/skeleton/skeleton.hpp"

#include <glm/geometric.hpp>
#include <glm/matrix.hpp>

namespace raks::capture {
namespace {

// What is known of each marker of the tracks.
struct TrackedKind {
    bool is_foot = false;    // near the floor when the dancer stands
    bool is_above = false;   // of head or chest
    double over_sole = 0.0;  // when the dancer stands; metres
};

std::vector<TrackedKind> kinds_of(const Tracks& tracks, const MarkerSet& set, double height) {
    using motion::Bone;
    constexpr double kMannequin = 1.714;  // metres
    constexpr double kHighestFoot = 0.2;  // metres
    const motion::Skeleton& body = motion::mannequin_skeleton();
    motion::Pose pose;
    pose.hips_position = {0.0F, body.hips_height(), 0.0F};
    const motion::WorldPose world = motion::world_pose(body, pose);
    const double scale = height > 0.0 ? height / kMannequin : 1.0;
    std::vector<TrackedKind> kinds;
    for (const std::string& name : tracks.markers) {
        TrackedKind& kind = kinds.emplace_back();
        if (const auto index = set.index_of(name)) {
            const Bone bone = set.markers[*index].bone;
            const auto standing =
                static_cast<double>(world.point(bone, glm::vec3(set.markers[*index].place)).y);
            kind.is_above = bone == Bone::head || bone == Bone::neck || bone == Bone::upper_chest ||
                            bone == Bone::chest;
            kind.is_foot = standing < kHighestFoot;
            kind.over_sole = scale * standing;
        }
    }
    return kinds;
}

// The middle of the markers of a frame that are of one part of the body.
std::optional<glm::dvec3> part_middle(const Tracks& tracks,
                                      const std::vector<TrackedKind>& kinds,
                                      std::size_t frame,
                                      bool TrackedKind::*is_part) {
    glm::dvec3 sum(0.0);
    double count = 0.0;
    for (std::size_t i = 0; i < kinds.size(); ++i) {
        const MarkerPlace& place = tracks.at(frame, i);
        if (kinds[i].*is_part && place.source != PlaceSource::lost) {
            sum += place.place;
            count += 1.0;
        }
    }
    return count > 0.0 ? std::optional(sum / count) : std::nullopt;
}

// How the dancer stands on the average: its up, and where its feet are.
struct Standing {
    glm::dvec3 up;
    glm::dvec3 feet;
};

std::optional<Standing> standing_of(const Tracks& tracks, const std::vector<TrackedKind>& kinds) {
    glm::dvec3 up(0.0);
    glm::dvec3 feet(0.0);
    double count = 0.0;
    for (std::size_t frame = 0; frame < tracks.frame_count; ++frame) {
        const auto low = part_middle(tracks, kinds, frame, &TrackedKind::is_foot);
        const auto high = part_middle(tracks, kinds, frame, &TrackedKind::is_above);
        if (low && high && glm::distance(*low, *high) > 0.0) {
            up += glm::normalize(*high - *low);
            feet += *low;
            count += 1.0;
        }
    }
    if (count == 0.0 || !(glm::length(up) > 0.0)) {
        return std::nullopt;
    }
    return Standing{glm::normalize(up), feet / count};
}

// A place where a marker stood, in axes of which y is about up.
struct Stood {
    glm::dvec3 place;
    double over_sole = 0.0;  // of the marker; metres
};

// Markers of the feet that hardly move, once for each spot of the floor.
std::vector<Stood> places_stood(const Tracks& tracks,
                                const std::vector<TrackedKind>& kinds,
                                const glm::dmat3& rotation) {
    constexpr double kSlow = 0.12;        // metres a second
    constexpr double kStandReach = 0.05;  // seconds to both sides, over which speed is taken
    constexpr double kSpot = 0.1;         // metres
    const auto reach =
        static_cast<std::size_t>(std::max(1.0, std::round(kStandReach * tracks.frames_per_second)));
    std::map<std::tuple<std::size_t, int, int>, std::vector<glm::dvec3>> spots;
    for (std::size_t i = 0; i < tracks.markers.size(); ++i) {
        if (!kinds[i].is_foot) {
            continue;
        }
        for (std::size_t frame = reach; frame + reach < tracks.frame_count; ++frame) {
            const MarkerPlace& before = tracks.at(frame - reach, i);
            const MarkerPlace& after = tracks.at(frame + reach, i);
            const MarkerPlace& now = tracks.at(frame, i);
            const double seconds = 2.0 * static_cast<double>(reach) / tracks.frames_per_second;
            // Comparisons with a lost place, which is not a number, do not hold.
            if (now.source == PlaceSource::seen &&
                glm::distance(before.place, after.place) < kSlow * seconds) {
                const glm::dvec3 place = rotation * now.place;
                spots[{i,
                       static_cast<int>(std::floor(place.x / kSpot)),
                       static_cast<int>(std::floor(place.z / kSpot))}]
                    .push_back(place);
            }
        }
    }
    std::vector<Stood> stood;
    for (auto& [spot, places] : spots) {
        const auto middle = places.begin() + static_cast<std::ptrdiff_t>(places.size() / 2);
        std::nth_element(places.begin(), middle, places.end(), [](const auto& a, const auto& b) {
            return a.y < b.y;
        });
        stood.push_back({*middle, kinds[std::get<0>(spot)].over_sole});
    }
    return stood;
}

// The floor y = a + b x + c z under the places stood, about `middle`; feet held in the air weigh
// little, and slopes are small unless the places say otherwise.
Eigen::Vector3d floor_under(const std::vector<Stood>& stood, const glm::dvec3& middle) {
    constexpr int kFloorRounds = 20;
    constexpr double kNoise = 0.015;  // metres
    constexpr double kSlope = 0.05;   // 3 degrees
    std::vector<double> floors;
    floors.reserve(stood.size());
    for (const Stood& one : stood) {
        floors.push_back(one.place.y - one.over_sole);
    }
    // Most of the places are on the floor; those above it are feet in the air.
    const auto third = floors.begin() + static_cast<std::ptrdiff_t>(floors.size() / 3);
    std::nth_element(floors.begin(), third, floors.end());
    Eigen::Vector3d floor(*third, 0.0, 0.0);
    for (int round = 0; round < kFloorRounds; ++round) {
        Eigen::Matrix3d normal = Eigen::Matrix3d::Zero();
        Eigen::Vector3d right = Eigen::Vector3d::Zero();
        normal(1, 1) = normal(2, 2) = 1.0 / (kSlope * kSlope);
        for (const Stood& one : stood) {
            const Eigen::Vector3d row(1.0, one.place.x - middle.x, one.place.z - middle.z);
            const double target = one.place.y - one.over_sole;
            const double off = (target - row.dot(floor)) / kNoise;
            const double weight = 1.0 / ((1.0 + off * off) * (1.0 + off * off) * kNoise * kNoise);
            normal += weight * row * row.transpose();
            right += weight * target * row;
        }
        floor = normal.ldlt().solve(right);
    }
    return floor;
}

// The rotation after which `up` is y, and x about where it was.
glm::dmat3 rotation_to_upright(const glm::dvec3& up) {
    const glm::dvec3 aside =
        std::abs(up.x) < 0.9 ? glm::dvec3(1.0, 0.0, 0.0) : glm::dvec3(0.0, 0.0, 1.0);
    const glm::dvec3 x = glm::normalize(aside - glm::dot(aside, up) * up);
    return glm::transpose(glm::dmat3(x, up, glm::cross(x, up)));
}

}  // namespace

std::optional<Levelling> level_by_feet(const Tracks& tracks,
                                       const MarkerSet& markers,
                                       double height) {
    const std::vector<TrackedKind> kinds = kinds_of(tracks, markers, height);
    const auto standing = standing_of(tracks, kinds);
    if (!standing) {
        return std::nullopt;
    }
    glm::dmat3 rotation = rotation_to_upright(standing->up);
    const glm::dvec3 feet = rotation * standing->feet;
    const std::vector<Stood> stood = places_stood(tracks, kinds, rotation);
    double floor_height = feet.y;
    if (!stood.empty()) {
        const Eigen::Vector3d floor = floor_under(stood, feet);
        const glm::dmat3 tilt =
            rotation_to_upright(glm::normalize(glm::dvec3(-floor[1], 1.0, -floor[2])));
        floor_height = (tilt * glm::dvec3(feet.x, floor[0], feet.z)).y;
        rotation = tilt * rotation;
    }
    const glm::dvec3 origin = rotation * standing->feet;
    return Levelling{rotation, {-origin.x, -floor_height, -origin.z}};
}

void level(Rig& rig, const Levelling& levelling) {
    for (Camera& camera : rig.cameras) {
        camera.rotation = camera.rotation * glm::transpose(levelling.rotation);
        camera.translation -= camera.rotation * levelling.translation;
    }
    rig.floor = FloorOrigin::feet;
}

}  // namespace raks::capture
