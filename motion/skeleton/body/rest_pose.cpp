#include "motion/skeleton/body/rest_pose.hpp"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <glm/gtc/constants.hpp>
#include <optional>
#include <utility>

#include "base/statistics.hpp"
#include "motion/skeleton/body/bone_aims.hpp"
#include "motion/skeleton/body/bone_twist.hpp"
#include "motion/skeleton/body/t_pose_check.hpp"

namespace raks::motion {
namespace {

constexpr double kDegree = glm::pi<double>() / 180.0;

// A rest pose was drawn, not recorded, where both sides agree that well.
constexpr double kSymmetric = 3.0 * kDegree;
// Single bones of a measured skeleton (CMU) are as crooked as that, though it was drawn.
constexpr double kAside = 10.0 * kDegree;
// A drawn pelvis leans by no more against the mannequin's.
constexpr double kPelvisLean = 35.0 * kDegree;
// A frame that points a bone so is taken for right: skeletons differ by that much.
constexpr double kNear = 20.0 * kDegree;
// The same for thighs and upper arms, whose direction makes the rest pose.
constexpr double kNearForUpper = 2.0 * kDegree;
// What the twists that the motion tells are good for.
constexpr double kTwist = 55.0 * kDegree;
constexpr double kAlongAxis = 8.0 * kDegree;  // a bone that lies along an axis of its joint
constexpr double kMilder = 3.0 * kDegree;     // less is no difference in mildness

double angle_of(const glm::dquat& rotation) {
    return 2.0 * std::acos(std::clamp(std::abs(rotation.w), 0.0, 1.0));
}

double angle_between(const glm::dvec3& a, const glm::dvec3& b) {
    return std::atan2(glm::length(glm::cross(a, b)), glm::dot(a, b));
}

/// The rotation that turns one pair of directions into another: the first exactly, the second as
/// near as it can.
glm::dquat turn_of_pair(const BoneAim& exact, const BoneAim& near) {
    if (glm::length(glm::cross(exact.in_joint, near.in_joint)) < 1e-3) {
        return shortest_turn(exact.in_joint, exact.in_t_pose);  // they say the same
    }
    const auto basis = [](const glm::dvec3& a, const glm::dvec3& b) {
        const glm::dvec3 normal = glm::normalize(glm::cross(a, b));
        return glm::dmat3(a, normal, glm::cross(a, normal));
    };
    return glm::normalize(glm::quat_cast(basis(exact.in_t_pose, near.in_t_pose) *
                                         glm::transpose(basis(exact.in_joint, near.in_joint))));
}

/// The rotation among the 24 of a cube that is nearest to another one.
glm::dquat nearest_cube_turn(const glm::dquat& rotation) {
    // Columns: the largest element, then the largest of what is left.
    const glm::dmat3 full = glm::mat3_cast(rotation);
    glm::dmat3 best(1.0);
    double best_fit = -1e9;
    const std::array<glm::dvec3, 6> axes = {
        {{1, 0, 0}, {-1, 0, 0}, {0, 1, 0}, {0, -1, 0}, {0, 0, 1}, {0, 0, -1}}};
    for (const glm::dvec3& x : axes) {
        for (const glm::dvec3& y : axes) {
            if (glm::dot(x, y) != 0.0) {
                continue;
            }
            const glm::dmat3 cube(x, y, glm::cross(x, y));
            const double fit = glm::dot(cube[0], full[0]) + glm::dot(cube[1], full[1]) +
                               glm::dot(cube[2], full[2]);
            if (fit > best_fit) {
                best_fit = fit;
                best = cube;
            }
        }
    }
    return glm::normalize(glm::quat_cast(best));
}

bool is_along_axis(const glm::dvec3& direction) {
    const glm::dvec3 size = glm::abs(direction);
    return std::max({size.x, size.y, size.z}) > std::cos(kAlongAxis);
}

bool is_upper(Bone bone) {
    return bone == Bone::left_upper_arm || bone == Bone::right_upper_arm ||
           bone == Bone::left_upper_leg || bone == Bone::right_upper_leg;
}

/// The angle between two; the first where they contradict each other.
double middle_of(double first, double second) {
    const double off = std::remainder(second - first, glm::two_pi<double>());
    return std::abs(off) < 2.0 * glm::pi<double>() / 3.0 ? first + 0.5 * off : first;
}

/// Finds the rotations from the hips down; see RestPose.
class RestFinder {
 public:
    RestFinder(const PosedBody& body, const glm::dquat& upright)
        : body_(body), turned_(body, upright) {}

    RestPose find() {
        if (body_.clip().rests_in_t_pose) {
            rest_.bones.fill(figure_);
            describe_t_pose();
            rest_.reason = "its format rests in a T-pose";
            return std::move(rest_);
        }
        find_hips();
        const TPosedLimbs limbs = t_posed_limbs(body_, figure_);
        if (limbs.are_all()) {
            rest_.bones.fill(figure_);
            describe_t_pose();
            return std::move(rest_);
        }
        for (std::size_t b = 1; b < rest_.bones.size(); ++b) {
            const Bone bone = static_cast<Bone>(b);
            if (is_drawn_ && limbs.has(bone)) {
                rest_.bones[b] = figure_;
            } else {
                rest_.bones[b] = body_.has(bone) ? of_bone(bone) : of_parent(bone);
            }
        }
        describe_other();
        return std::move(rest_);
    }

 private:
    const glm::dquat& of_parent(Bone bone) const {
        return rest_.bones[kBoneParents[index_of(bone)]];
    }

    // Pelvis: from both directions; the axes of the file where it lies along them.
    void find_hips() {
        const auto across = lateral_aim(body_, Bone::hips);
        const auto along = bone_aim(body_, Bone::hips);
        glm::dquat& hips = rest_.bones[0];
        hips = across && along ? turn_of_pair(*across, *along) : glm::dquat(1.0, 0.0, 0.0, 0.0);
        figure_ = hips;
        if (!across || !along) {
            is_drawn_ = true;
            return;
        }
        const glm::dquat cube = nearest_cube_turn(hips);
        if (t_posed_limbs(body_, cube).are_all()) {
            figure_ = cube;
            return;
        }
        const glm::dvec3 sockets = cube * across->in_joint;
        const glm::dvec3 trunk = cube * along->in_joint;
        is_drawn_ = angle_between(sockets, {1.0, 0.0, 0.0}) < kSymmetric &&
                    std::abs(trunk.x) < kAside &&
                    angle_of(cube * glm::conjugate(hips)) < kPelvisLean && are_limbs_drawn(cube);
        if (is_drawn_) {
            figure_ = cube;
            // Where the pelvis of the file would lean all the time, it was not drawn upright.
            const double margin = 12.0 * kDegree;
            if (std::abs(turned_.lean(Bone::hips, cube)) <
                std::abs(turned_.lean(Bone::hips, hips)) + margin) {
                hips = cube;
            }
        }
    }

    // Whether all limbs lie as their mirror images, or all along axes: no moment of a motion does.
    bool are_limbs_drawn(const glm::dquat& figure) const {
        bool are_mirrored = true;
        bool are_along_axes = true;
        for (const Bone left : {Bone::left_upper_leg,
                                Bone::left_lower_leg,
                                Bone::left_upper_arm,
                                Bone::left_lower_arm}) {
            const auto one = bone_aim(body_, left);
            const auto other = bone_aim(body_, mirrored(left));
            if (!one || !other) {
                continue;
            }
            are_mirrored = are_mirrored && are_mirror_images(figure, *one, *other, kSymmetric);
            are_along_axes =
                are_along_axes && is_along_axis(one->in_joint) && is_along_axis(other->in_joint);
        }
        return are_mirrored || are_along_axes;
    }

    static bool are_mirror_images(const glm::dquat& figure,
                                  const BoneAim& a,
                                  const BoneAim& b,
                                  double bound) {
        const glm::dvec3 there = figure * b.in_joint;
        return angle_between(figure * a.in_joint, {-there.x, there.y, there.z}) < bound;
    }

    glm::dquat of_bone(Bone bone) {
        const Bone parent = *mapped_parent(body_.mapping(), bone);
        const glm::dquat& above = rest_.bones[index_of(parent)];
        const glm::dquat mean = turned_.mean_against(parent, above, bone);
        auto aim = bone_aim(body_, bone);
        if (!aim) {
            return of_bare_joint(above, mean);
        }
        if (bone == Bone::head && aim->is_tip) {
            level_head(above, *aim);
        }
        const auto lateral = lateral_aim(body_, bone);
        const glm::dquat straight =
            shortest_turn(figure_ * aim->in_joint, aim->in_t_pose) * figure_;
        double twist = 0.0;
        if (lateral) {
            twist =
                twist_of(turn_of_pair(*aim, *lateral) * glm::conjugate(straight), aim->in_t_pose);
        } else {
            twist = twist_of(mean * glm::conjugate(straight), aim->in_t_pose);
            if (const auto hinge = turned_.hinge_twist(bone, straight, aim->in_t_pose)) {
                twist = middle_of(*hinge, twist);
            }
        }
        const glm::dquat rest = chosen(bone, *aim, above, mean, straight, twist);
        // A head does not lie on a shoulder all the time: then its tip is one that a program made
        // up (Rokoko's points aside).
        constexpr double kMostTilt = 60.0 * kDegree;
        if (bone == Bone::head && aim->is_tip &&
            angle_of(mean * glm::conjugate(rest)) > kMostTilt) {
            return of_bare_joint(above, mean);
        }
        return rest;
    }

    // A joint with nothing below: as the whole figure or as the bone above, whichever is milder.
    glm::dquat of_bare_joint(const glm::dquat& above, const glm::dquat& mean) const {
        const double by_figure = angle_of(mean * glm::conjugate(figure_));
        const double by_parent = angle_of(mean * glm::conjugate(above));
        constexpr double kMost = 80.0 * kDegree;
        if (std::min(by_figure, by_parent) > kMost) {
            return mean;
        }
        return is_drawn_ && by_figure < by_parent + kMilder ? figure_ : above;
    }

    // A head's tip goes on as the neck does, or straight up: whichever lets the head look level.
    void level_head(const glm::dquat& above, BoneAim& aim) const {
        const glm::dvec3 up(0.0, 1.0, 0.0);
        const auto lean = [&](const glm::dvec3& tip) {
            const glm::dquat first = shortest_turn(above * aim.in_joint, tip) * above;
            return std::abs(turned_.lean(Bone::head, first));
        };
        constexpr double kClearly = 4.0 * kDegree;
        if (lean(up) + kClearly < lean(aim.in_t_pose)) {
            aim.in_t_pose = up;
        }
    }

    // Whether the bone lies in the file as its mirror image on the other side does.
    bool is_mirrored(Bone bone, const BoneAim& aim) const {
        if (!is_drawn_) {
            return false;
        }
        const glm::dvec3 here = figure_ * aim.in_joint;
        const Bone other = mirrored(bone);
        if (other == bone) {
            return std::abs(here.x) < kAside;
        }
        const auto there = body_.has(other) ? bone_aim(body_, other) : std::nullopt;
        return there && are_mirror_images(figure_, aim, *there, kAside);
    }

    // From where a bone was drawn to the T-pose: about one axis of the figure where that does it
    // (arms are lowered in the frontal plane, thighs lifted in the sagittal one).
    glm::dquat drawn_turn(const BoneAim& aim) const {
        const glm::dvec3 from = figure_ * aim.in_joint;
        constexpr double kExact = 2.0 * kDegree;
        for (const glm::dvec3& axis :
             {glm::dvec3(0, 0, 1), glm::dvec3(1, 0, 0), glm::dvec3(0, 1, 0)}) {
            const glm::dvec3 a = from - glm::dot(from, axis) * axis;
            const glm::dvec3 b = aim.in_t_pose - glm::dot(aim.in_t_pose, axis) * axis;
            const double angle = std::atan2(glm::dot(axis, glm::cross(a, b)), glm::dot(a, b));
            const glm::dquat turn = glm::angleAxis(angle, axis);
            if (angle_between(turn * from, aim.in_t_pose) < kExact) {
                return glm::normalize(shortest_turn(turn * from, aim.in_t_pose) * turn * figure_);
            }
        }
        return shortest_turn(from, aim.in_t_pose) * figure_;
    }

    glm::dquat chosen(Bone bone,
                      const BoneAim& aim,
                      const glm::dquat& above,
                      const glm::dquat& mean,
                      const glm::dquat& straight,
                      double twist) {
        const bool is_canonical = is_mirrored(bone, aim);
        const auto turned = [&](double angle) {
            return glm::normalize(glm::angleAxis(angle, aim.in_t_pose) * straight);
        };
        if (is_canonical) {
            const double near = is_upper(bone) ? kNearForUpper : kNear;
            std::optional<glm::dquat> best;
            double best_angle = 1e9;
            for (const glm::dquat& frame : {above, figure_}) {
                const double off = twist_of(turned(twist) * glm::conjugate(frame), aim.in_t_pose);
                const double mildness = angle_of(mean * glm::conjugate(frame));
                if (angle_between(frame * aim.in_joint, aim.in_t_pose) < near &&
                    std::abs(off) < kTwist && mildness + kMilder < best_angle) {
                    best = frame;
                    best_angle = mildness;
                }
            }
            if (best) {
                return *best;
            }
            if (std::abs(twist) < kTwist) {
                return drawn_turn(aim);
            }
        }
        if (is_drawn_ && is_along_axis(aim.in_joint)) {
            const double quarter = glm::half_pi<double>();
            return std::abs(twist) < 0.5 * quarter ? straight
                                                   : turned(quarter * std::round(twist / quarter));
        }
        ++guessed_twists_;
        return turned(twist);
    }

    void describe_t_pose() {
        const bool is_ours = figure_ == glm::dquat(1.0, 0.0, 0.0, 0.0);
        rest_.kind = is_ours ? RestKind::t_pose : RestKind::turned_t_pose;
        rest_.reason = is_ours ? "its rest pose is a T-pose" : "its rest pose is a turned T-pose";
    }

    void describe_other() {
        rest_.kind = RestKind::other;
        rest_.confidence = guessed_twists_ > 0 ? 0.7 : 0.9;
        rest_.reason = "its rest pose is no T-pose: bones by their directions in the posed frames";
        if (guessed_twists_ > 0) {
            rest_.reason += ", twists by the mildest motion";
        }
    }

    const PosedBody& body_;
    TurnedBody turned_;
    RestPose rest_;
    glm::dquat figure_ = {1.0, 0.0, 0.0, 0.0};  // from the file's axes at rest to ours
    bool is_drawn_ = false;                     // the pelvis lies along the file's axes
    int guessed_twists_ = 0;
};

/// Joints without a bone move with the bone above them; those above the hips with the world.
void fill_joints(const PosedBody& body, const glm::dquat& upright, RestPose& rest) {
    const MotionClip& clip = body.clip();
    rest.joints.assign(clip.joints.size(), upright);
    std::vector<bool> is_below(clip.joints.size(), false);
    std::vector<std::optional<Bone>> bones(clip.joints.size());
    for (std::size_t b = 0; b < rest.bones.size(); ++b) {
        if (const auto joint = body.mapping().joints[b]) {
            bones[*joint] = static_cast<Bone>(b);
        }
    }
    for (std::size_t joint = 0; joint < clip.joints.size(); ++joint) {
        const std::size_t parent = clip.joints[joint].parent;
        if (bones[joint]) {
            is_below[joint] = true;
            rest.joints[joint] = rest.bones[index_of(*bones[joint])];
        } else if (parent != joint && is_below[parent]) {
            is_below[joint] = true;
            // A helper that is turned by the same large angle in all frames has axes of its own.
            const glm::dquat first = clip.rotation(0, joint);
            const glm::dquat last = clip.rotation(clip.frame_count - 1, joint);
            const bool is_fixed = angle_of(first * glm::conjugate(last)) < kDegree;
            rest.joints[joint] = is_fixed && angle_of(first) > 30.0 * kDegree
                                     ? glm::normalize(rest.joints[parent] * first)
                                     : rest.joints[parent];
        }
    }
}

}  // namespace

RestPose find_rest_pose(const PosedBody& body, const glm::dquat& upright) {
    RestPose rest = RestFinder(body, upright).find();
    fill_joints(body, upright, rest);
    return rest;
}

}  // namespace raks::motion
