#include "motion/skeleton/body/posed_skeleton.hpp"

#include <algorithm>
#include <cmath>

#include <glm/geometric.hpp>

namespace raks::motion {

PosedSkeleton::PosedSkeleton(const MotionClip& clip)
    : tree_(joint_parents(clip)),
      lengths_(clip.joints.size(), 0.0),
      reach_(clip.joints.size(), 0.0) {
    const std::size_t frames = std::min(clip.frame_count, kMostFrames);
    for (std::size_t i = 0; i < frames; ++i) {
        const ClipWorldPose world = world_pose(clip, i * clip.frame_count / frames);
        places_.push_back(world.positions);
        std::vector<glm::dvec3>& tips = tips_.emplace_back(world.positions);
        for (std::size_t joint = 0; joint < clip.joints.size(); ++joint) {
            if (const auto& end = clip.joints[joint].end_site) {
                tips[joint] += world.rotations[joint] * *end;
            }
        }
    }
    turning_.assign(clip.joints.size(), 0.0);
    for (std::size_t i = 1; i < frames; ++i) {
        const std::size_t frame = i * clip.frame_count / frames;
        for (std::size_t joint = 0; joint < clip.joints.size(); ++joint) {
            const double alike = glm::dot(clip.rotation(0, joint), clip.rotation(frame, joint));
            turning_[joint] +=
                2.0 * std::acos(std::min(1.0, std::abs(alike))) / static_cast<double>(frames);
        }
    }
    for (auto joint = tree_.order().rbegin(); joint != tree_.order().rend(); ++joint) {
        const auto at = static_cast<std::size_t>(*joint);
        const int parent = tree_.parent(*joint);
        lengths_[at] = parent < 0 ? 0.0 : distance(*joint, parent);
        double second = 0.0;
        if (const auto& end = clip.joints[at].end_site) {
            reach_[at] = std::max(reach_[at], glm::length(*end));
        }
        for (const int child : tree_.children(*joint)) {
            // What travels about the world below a fixed root is on no bone.
            constexpr double kTravels = 0.1;
            const bool is_bone = looseness(child, *joint) < kTravels;
            const double way = (is_bone ? length(child) : 0.0) + reach(child);
            second = std::max(second, std::min(way, reach_[at]));
            reach_[at] = std::max(reach_[at], way);
        }
        if (second > 0.0) {
            size_ = std::max(size_, reach_[at] + second);
        }
    }
}

double PosedSkeleton::distance(int a, int b) const {
    double sum = 0.0;
    for (std::size_t frame = 0; frame < frames(); ++frame) {
        sum += glm::length(place(frame, a) - place(frame, b));
    }
    return frames() > 0 ? sum / static_cast<double>(frames()) : 0.0;
}

double PosedSkeleton::looseness(int a, int b) const {
    const double mean = distance(a, b);
    double squares = 0.0;
    for (std::size_t frame = 0; frame < frames(); ++frame) {
        const double away = glm::length(place(frame, a) - place(frame, b)) - mean;
        squares += away * away;
    }
    return mean > 0.0 ? std::sqrt(squares / static_cast<double>(frames())) / mean : 0.0;
}

double PosedSkeleton::way_up(int joint, int above) const {
    double way = 0.0;
    for (int at = joint; at >= 0 && at != above; at = tree_.parent(at)) {
        way += length(at);
    }
    return way;
}

std::vector<int> PosedSkeleton::longest_way(int joint) const {
    std::vector<int> way = {joint};
    while (way.size() < kLongestWay && !tree_.children(way.back()).empty()) {
        const std::vector<int>& next = tree_.children(way.back());
        way.push_back(*std::max_element(next.begin(), next.end(), [this](int a, int b) {
            return length(a) + reach(a) < length(b) + reach(b);
        }));
    }
    return way;
}

std::vector<int> joint_parents(const MotionClip& clip) {
    std::vector<int> parents;
    for (std::size_t joint = 0; joint < clip.joints.size(); ++joint) {
        const std::size_t parent = clip.joints[joint].parent;
        parents.push_back(parent == joint ? -1 : static_cast<int>(parent));
    }
    return parents;
}

}  // namespace raks::motion
