// Posed skeleton: the joints of a clip in some of its frames, for questions about its shape.
#pragma once

#include <cstddef>
#include <vector>

#include "motion/skeleton/body/parent_tree.hpp"
#include "motion/skeleton/motion_clip.hpp"

#include <glm/vec3.hpp>

namespace raks::motion {

/// Where the joints of a clip are in frames that are spread evenly over it, and what follows from
/// that alone: the rest pose is not looked at, because many files have a useless one. Lengths are
/// in units of the file.
class PosedSkeleton {
 public:
    static constexpr std::size_t kMostFrames = 64;  ///< that are looked at

    /// Cost: joints x frames that are looked at.
    explicit PosedSkeleton(const MotionClip& clip);

    [[nodiscard]] const ParentTree& tree() const noexcept { return tree_; }
    /// Number of frames that are looked at.
    [[nodiscard]] std::size_t frames() const noexcept { return places_.size(); }
    /// Place of a joint in the world.
    [[nodiscard]] const glm::dvec3& place(std::size_t frame, int joint) const {
        return places_[frame][static_cast<std::size_t>(joint)];
    }
    /// Where a joint's end site is; the joint itself where it has none.
    [[nodiscard]] const glm::dvec3& tip(std::size_t frame, int joint) const {
        return tips_[frame][static_cast<std::size_t>(joint)];
    }
    /// Mean distance of two joints.
    [[nodiscard]] double distance(int a, int b) const;
    /// How much the distance of two joints changes: its standard deviation divided by its mean.
    [[nodiscard]] double looseness(int a, int b) const;
    /// Mean distance of a joint from its parent; 0 of a root.
    [[nodiscard]] double length(int joint) const {
        return lengths_[static_cast<std::size_t>(joint)];
    }
    /// How far a joint turns against its parent: mean angle from its first frame, radians.
    [[nodiscard]] double turning(int joint) const {
        return turning_[static_cast<std::size_t>(joint)];
    }
    /// Whether a joint turns at all.
    [[nodiscard]] bool turns(int joint) const {
        constexpr double kStill = 1e-3;  // radians: rounding of a file
        return turning(joint) > kStill;
    }
    /// Length of the longest way from a joint to an end below it.
    [[nodiscard]] double reach(int joint) const { return reach_[static_cast<std::size_t>(joint)]; }
    /// Length of the way from a joint up to one above it.
    [[nodiscard]] double way_up(int joint, int above) const;
    static constexpr std::size_t kLongestWay = 16;  ///< joints; no limb has more
    /// The joints of the longest way down from a joint, itself first; at most kLongestWay.
    [[nodiscard]] std::vector<int> longest_way(int joint) const;
    /// Length of the longest way between two ends: the size of the whole.
    [[nodiscard]] double size() const noexcept { return size_; }

 private:
    ParentTree tree_;
    std::vector<std::vector<glm::dvec3>> places_;  // frames x joints
    std::vector<std::vector<glm::dvec3>> tips_;    // frames x joints
    std::vector<double> lengths_;
    std::vector<double> reach_;
    std::vector<double> turning_;
    double size_ = 0.0;
};

/// The parent of each joint, -1 of a root.
[[nodiscard]] std::vector<int> joint_parents(const MotionClip& clip);

}  // namespace raks::motion
