#include "apps/reports/body_lines.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>

#include "motion/skeleton/humanoid.hpp"
#include "motion/skeleton/skeleton.hpp"

namespace raks::apps {
namespace {

constexpr double kBodyMetres = 2.2;  // with raised arms

/// A bone that is drawn from its parent's joint, and its colour.
struct Stroke {
    motion::Bone from;
    motion::Bone to;
    std::string_view colour;
};
using motion::Bone;
constexpr std::array<Stroke, 14> kStrokes = {
    {{Bone::hips, Bone::neck, kTrunkColour},
     {Bone::neck, Bone::head, kTrunkColour},
     {Bone::hips, Bone::right_upper_leg, kRightColour},
     {Bone::right_upper_leg, Bone::right_lower_leg, kRightColour},
     {Bone::right_lower_leg, Bone::right_foot, kRightColour},
     {Bone::right_foot, Bone::right_toes, kRightColour},
     {Bone::neck, Bone::right_upper_arm, kRightColour},
     {Bone::right_upper_arm, Bone::right_lower_arm, kRightColour},
     {Bone::hips, Bone::left_upper_leg, kLeftColour},
     {Bone::left_upper_leg, Bone::left_lower_leg, kLeftColour},
     {Bone::left_lower_leg, Bone::left_foot, kLeftColour},
     {Bone::left_foot, Bone::left_toes, kLeftColour},
     {Bone::neck, Bone::left_upper_arm, kLeftColour},
     {Bone::left_upper_arm, Bone::left_lower_arm, kLeftColour}}};
constexpr std::array<Stroke, 2> kForearms = {
    {{Bone::right_lower_arm, Bone::right_hand, kRightColour},
     {Bone::left_lower_arm, Bone::left_hand, kLeftColour}}};

}  // namespace

std::string body_lines(const motion::Pose& pose, double heading, double x, double ground) {
    const motion::WorldPose world = world_pose(motion::mannequin_skeleton(), pose);
    const double scale = kBodyPixels / kBodyMetres;
    const auto place = [&](Bone bone) {
        const glm::vec3 d = world.position(bone) - pose.hips_position;
        const double across = std::cos(heading) * static_cast<double>(d.x) -
                              std::sin(heading) * static_cast<double>(d.z);
        return std::pair{x + scale * across,
                         ground - scale * static_cast<double>(world.position(bone).y)};
    };
    std::string lines;
    const auto draw = [&](const Stroke& stroke) {
        const auto [x1, y1] = place(stroke.from);
        const auto [x2, y2] = place(stroke.to);
        lines += fmt::format("<path d=\"M{:.1f} {:.1f}L{:.1f} {:.1f}\" stroke=\"{}\"/>",
                             x1,
                             y1,
                             x2,
                             y2,
                             stroke.colour);
    };
    std::for_each(kStrokes.begin(), kStrokes.end(), draw);
    std::for_each(kForearms.begin(), kForearms.end(), draw);
    const auto [hx, hy] = place(Bone::head);
    return lines + fmt::format("<circle cx=\"{:.1f}\" cy=\"{:.1f}\" r=\"4\" fill=\"{}\"/>\n",
                               hx,
                               hy - 3.0,
                               kTrunkColour);
}

}  // namespace raks::apps
