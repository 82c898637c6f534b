#include "apps/raks_capture/body_facts.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <string_view>

#include <glm/geometric.hpp>
#include <glm/vec2.hpp>

namespace raks::apps {
namespace {

/// A bone's name, and that of the joint at its far end, without their side.
constexpr std::array<std::array<std::string_view, 2>, 5> kPairedBones = {{
    {"upper arm", "LowerArm"},
    {"forearm", "Hand"},
    {"thigh", "LowerLeg"},
    {"shin", "Foot"},
    {"foot", "Toes"},
}};

std::optional<std::size_t> joint_named(const motion::MotionClip& clip, const std::string& name) {
    for (std::size_t joint = 0; joint < clip.joints.size(); ++joint) {
        if (clip.joints[joint].name == name) {
            return joint;
        }
    }
    return std::nullopt;
}

std::optional<double> bone_length(const motion::MotionClip& clip, const std::string& far_joint) {
    const auto joint = joint_named(clip, far_joint);
    return joint ? std::optional(glm::length(clip.joints[*joint].offset)) : std::nullopt;
}

/// The value that a share of the values does not exceed; 0 of none.
double percentile(std::vector<double> values, double share) {
    if (values.empty()) {
        return 0.0;
    }
    const auto at = std::min(values.size() - 1,
                             static_cast<std::size_t>(share * static_cast<double>(values.size())));
    const auto middle = values.begin() + static_cast<std::ptrdiff_t>(at);
    std::nth_element(values.begin(), middle, values.end());
    return *middle;
}

FootFacts foot_facts(const std::vector<glm::dvec3>& balls,
                     const std::vector<double>& lowest,
                     double frames_per_second) {
    constexpr double kPlantedWithin = 0.02;  // metres
    std::vector<double> heights;
    heights.reserve(balls.size());
    for (const glm::dvec3& ball : balls) {
        heights.push_back(ball.y);
    }
    const double limit = percentile(heights, 0.05) + kPlantedWithin;
    std::vector<double> speeds;
    std::size_t planted = 0;
    for (std::size_t frame = 0; frame < balls.size(); ++frame) {
        if (balls[frame].y > limit) {
            continue;
        }
        ++planted;
        // The speed between two frames, both of which it stands in.
        if (frame > 0 && balls[frame - 1].y <= limit) {
            const glm::dvec2 step(balls[frame].x - balls[frame - 1].x,
                                  balls[frame].z - balls[frame - 1].z);
            speeds.push_back(glm::length(step) * frames_per_second);
        }
    }
    return {static_cast<double>(planted) / static_cast<double>(balls.size()),
            percentile(speeds, 0.5),
            percentile(speeds, 0.9),
            *std::min_element(lowest.begin(), lowest.end())};
}

/// Fingers are too small to be drawn.
bool is_drawn(std::string_view name) {
    constexpr std::array<std::string_view, 5> kFingers = {
        "Thumb", "Index", "Middle", "Ring", "Little"};
    return std::none_of(kFingers.begin(), kFingers.end(), [name](std::string_view finger) {
        return name.find(finger) != std::string_view::npos;
    });
}

StickPicture stick_picture(const motion::MotionClip& clip,
                           const motion::ClipWorldPose& pose,
                           double time) {
    StickPicture picture{time, {}};
    const double middle = pose.positions.front().x;
    for (std::size_t joint = 1; joint < clip.joints.size(); ++joint) {
        const motion::ClipJoint& drawn = clip.joints[joint];
        if (!is_drawn(drawn.name)) {
            continue;
        }
        const glm::dvec3& from = pose.positions[drawn.parent];
        const glm::dvec3& to = pose.positions[joint];
        picture.lines.push_back({from.x - middle, from.y, to.x - middle, to.y});
        if (drawn.end_site) {
            const glm::dvec3 end = to + pose.rotations[joint] * *drawn.end_site;
            picture.lines.push_back({to.x - middle, to.y, end.x - middle, end.y});
        }
    }
    return picture;
}

/// Where the ball of a foot is, and the lowest of ball and toes, frame by frame.
struct FootPath {
    std::size_t joint = 0;
    std::vector<glm::dvec3> balls;
    std::vector<double> lowest;

    void add(const motion::MotionClip& clip, const motion::ClipWorldPose& pose) {
        const glm::dvec3& ball = pose.positions[joint];
        const auto& end = clip.joints[joint].end_site;
        const double tip = end ? (ball + pose.rotations[joint] * *end).y : ball.y;
        balls.push_back(ball);
        lowest.push_back(std::min(ball.y, tip));
    }
};

}  // namespace

std::optional<BodyFacts> body_facts(const motion::MotionClip& clip, std::size_t pictures) {
    const auto left_toes = joint_named(clip, "leftToes");
    const auto right_toes = joint_named(clip, "rightToes");
    if (!left_toes || !right_toes || clip.frame_count == 0) {
        return std::nullopt;
    }
    BodyFacts facts;
    facts.seconds = static_cast<double>(clip.frame_count) / clip.frames_per_second;
    for (const auto& [name, joint] : kPairedBones) {
        const auto left = bone_length(clip, "left" + std::string(joint));
        const auto right = bone_length(clip, "right" + std::string(joint));
        if (left && right) {
            facts.lengths.push_back({std::string(name), *left, *right});
        }
    }
    FootPath left{*left_toes, {}, {}};
    FootPath right{*right_toes, {}, {}};
    const std::size_t step =
        std::max<std::size_t>(1, clip.frame_count / std::max<std::size_t>(1, pictures));
    for (std::size_t frame = 0; frame < clip.frame_count; ++frame) {
        const motion::ClipWorldPose pose = motion::world_pose(clip, frame);
        left.add(clip, pose);
        right.add(clip, pose);
        if (frame % step == step / 2 && facts.strip.size() < pictures) {
            facts.strip.push_back(
                stick_picture(clip, pose, static_cast<double>(frame) / clip.frames_per_second));
        }
    }
    facts.left = foot_facts(left.balls, left.lowest, clip.frames_per_second);
    facts.right = foot_facts(right.balls, right.lowest, clip.frames_per_second);
    return facts;
}

}  // namespace raks::apps
