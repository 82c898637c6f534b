// What there is to say about a solved dance: its doubtful stretches, and the body as a file.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <optional>
#include <string_view>

#include "motion/capture/solving/frame_fit.hpp"
#include "motion/capture/solving/solve.hpp"
#include "motion/choreography/joint_limits.hpp"

#include <glm/geometric.hpp>

namespace raks::capture {
namespace {

constexpr double kFarMarker = 0.05;  // metres
constexpr double kFarTimes = 3.0;    // times what it is usually off: joints that a network saw are
                                     // off by more than markers
constexpr double kFarJoint = 0.15;   // metres; farther is far, however often it is
constexpr double kFarBeyond = 5.0;   // degrees
constexpr double kLeastStretch = 0.1;  // seconds
constexpr std::size_t kLeastOfTrunk = 3;

/// Frames [0, count) in which `how_much` is above 0, as stretches; `say` tells the greatest.
void add_stretches(std::size_t count,
                   std::size_t least,
                   const std::function<double(std::size_t)>& how_much,
                   const std::function<std::string(double)>& say,
                   std::vector<SolveDoubt>& doubts) {
    std::size_t first = 0;
    double most = 0.0;
    for (std::size_t frame = 0; frame <= count; ++frame) {
        const double now = frame < count ? how_much(frame) : 0.0;
        if (now > 0.0) {
            most = std::max(most, now);
            continue;
        }
        if (most > 0.0 && frame - first >= least) {
            doubts.push_back({say(most), first, frame - 1});
        }
        first = frame + 1;
        most = 0.0;
    }
}

/// The pose at each frame of the tracks.
const motion::Pose& pose_at(const SolvedDance& dance, const Tracks& tracks, std::size_t frame) {
    const double at =
        static_cast<double>(frame) * dance.frames_per_second / tracks.frames_per_second;
    return dance.poses[std::min(dance.poses.size() - 1, static_cast<std::size_t>(std::lround(at)))];
}

glm::dvec3 solved_place(const SolvedDance& dance,
                        const BodyShape& shape,
                        const Marker& marker,
                        std::size_t index,
                        const motion::Pose& pose) {
    const motion::WorldPose world = motion::world_pose(dance.skeleton, pose);
    return glm::dvec3(world.point(marker.bone, glm::vec3(shape.marker_places[index])));
}

}  // namespace

std::vector<SolveDoubt> find_doubts(const SolvedDance& dance,
                                    const Tracks& tracks,
                                    const MarkerSet& markers) {
    std::vector<SolveDoubt> doubts;
    const BodyShape shape = shape_of(dance.size, markers);
    const auto least = static_cast<std::size_t>(
        std::max(1.0, std::ceil(kLeastStretch * tracks.frames_per_second)));
    std::vector<std::size_t> of_trunk;
    for (std::size_t i = 0; i < tracks.markers.size(); ++i) {
        const auto index = markers.index_of(tracks.markers[i]);
        if (!index) {
            continue;
        }
        const Marker& marker = markers.markers[*index];
        if (is_of_trunk(marker.bone)) {
            of_trunk.push_back(i);
        }
        const double far =
            std::clamp(kFarTimes * dance.markers[*index].difference, kFarMarker, kFarJoint);
        const auto beyond = [&](std::size_t frame) {
            const MarkerPlace& place = tracks.at(frame, i);
            if (!std::isfinite(place.place.x)) {
                return 0.0;
            }
            const double away = glm::distance(
                place.place,
                solved_place(dance, shape, marker, *index, pose_at(dance, tracks, frame)));
            return away > far ? away : 0.0;
        };
        add_stretches(
            tracks.frame_count,
            least,
            beyond,
            [&](double most) {
                return fmt::format("{} is up to {:.0f} cm off the body", marker.name, 100.0 * most);
            },
            doubts);
    }
    add_stretches(
        tracks.frame_count,
        least,
        [&](std::size_t frame) {
            const auto seen = static_cast<std::size_t>(
                std::count_if(of_trunk.begin(), of_trunk.end(), [&](std::size_t i) {
                    return std::isfinite(tracks.at(frame, i).place.x);
                }));
            return seen < kLeastOfTrunk ? static_cast<double>(kLeastOfTrunk - seen) : 0.0;
        },
        [](double missing) {
            return fmt::format("only {:.0f} markers of the trunk are seen", 3.0 - missing);
        },
        doubts);
    std::string_view joint;
    add_stretches(
        tracks.frame_count,
        least,
        [&](std::size_t frame) {
            const auto worst = motion::worst_joint(pose_at(dance, tracks, frame));
            if (!worst || worst->beyond() < kFarBeyond) {
                return 0.0;
            }
            joint = worst->joint;
            return worst->beyond();
        },
        [&](double most) {
            return fmt::format("{} is up to {:.0f} degrees beyond its limits", joint, most);
        },
        doubts);
    std::stable_sort(doubts.begin(), doubts.end(), [](const SolveDoubt& a, const SolveDoubt& b) {
        return a.first < b.first;
    });
    return doubts;
}

std::string body_text(const SolvedDance& dance, const MarkerSet& markers) {
    const motion::Skeleton& skeleton = dance.skeleton;
    const auto length = [&](motion::Bone bone) {
        return static_cast<double>(glm::length(skeleton.offsets[index_of(bone)]));
    };
    std::string text = fmt::format(
        "format = \"raks-body\"\nversion = 1\nheight = {:.4f}  # metres\n"
        "first_time = {:.6f}  # capture time of the first pose, seconds\n"
        "frames_per_second = {:.6g}\n\n"
        "[lengths]  # metres\nthigh = {:.4f}\nshin = {:.4f}\nupper_arm = {:.4f}\n"
        "forearm = {:.4f}\nhip_width = {:.4f}\nshoulder_width = {:.4f}\nfoot = {:.4f}\n\n"
        "[parts]  # length / that of the mannequin as tall\n",
        kMannequinHeight * dance.size.whole,
        dance.first_time,
        dance.frames_per_second,
        length(motion::Bone::left_lower_leg),
        length(motion::Bone::left_foot),
        length(motion::Bone::left_lower_arm),
        length(motion::Bone::left_hand),
        2.0 * static_cast<double>(skeleton.offsets[index_of(motion::Bone::left_upper_leg)].x),
        2.0 * static_cast<double>(skeleton.offsets[index_of(motion::Bone::left_shoulder)].x +
                                  skeleton.offsets[index_of(motion::Bone::left_upper_arm)].x),
        static_cast<double>(skeleton.toe_tip.z - skeleton.heel.z));
    for (std::size_t i = 0; i < kBodyParts; ++i) {
        text += fmt::format("{} = {:.4f}\n", kBodyPartNames[i], dance.size.parts[i]);
    }
    const BodyShape shape = shape_of(dance.size, markers);
    for (std::size_t i = 0; i < dance.markers.size(); ++i) {
        const MarkerFit& fit = dance.markers[i];
        const glm::dvec3& place = shape.marker_places[i];
        text += fmt::format(
            "\n[[marker]]\nname = \"{}\"\nbone = \"{}\"\nplace = [{:.4f}, {:.4f}, {:.4f}]\n"
            "shift = [{:.4f}, {:.4f}, {:.4f}]  # from the set's place\n"
            "seen = {:.4f}  # share of the frames\ndifference = {:.4f}  # metres, rms\n",
            fit.name,
            motion::kBoneNames[index_of(markers.markers[i].bone)],
            place.x,
            place.y,
            place.z,
            fit.shift.x,
            fit.shift.y,
            fit.shift.z,
            fit.seen,
            fit.difference);
    }
    return text;
}

}  // namespace raks::capture
