// Body model: which joints of a body may turn, and how marker places change with them.
#pragma once

#include <array>
#include <cstddef>
#include <string>
#include <string_view>
#include <vector>

#include "motion/capture/markers/marker_set.hpp"
#include "motion/skeleton/humanoid.hpp"
#include "motion/skeleton/pose.hpp"

#include <glm/gtc/quaternion.hpp>
#include <glm/mat3x3.hpp>
#include <glm/vec3.hpp>

namespace raks::capture {

/// Which joints move.
enum class BodyKind : std::uint8_t {
    paper,  ///< 22 degrees of freedom: hips, shoulders, elbows, hips' joints, knees
    dance,  ///< and spine, neck, collarbones, wrists, ankles, turns of the forearms, toes
};

/// A joint that turns, or several in a row that turn alike. Its variables are a small turn of it in
/// the frame that it has, so a dancer may spin as often as wanted.
struct TurningJoint {
    std::string name{};                    ///< differs from the others'; "leftLowerArm"
    std::array<motion::Bone, 3> bones{};   ///< the first `count`, each turned by an equal share
    std::size_t count = 1;                 ///< 1 to 3
    bool is_hinge = false;                 ///< turns about `axis` alone
    glm::dvec3 axis{};                     ///< of a hinge
    glm::dquat usual{1.0, 0.0, 0.0, 0.0};  ///< of all bones together, where nothing is measured
    double usual_angle = 0.0;              ///< of a hinge, likewise; radians
    /// Standard deviation from the usual turn by axis (a hinge's: x); radians.
    glm::dvec3 deviation{};
    double lowest = 0.0;   ///< of a hinge's angle; radians
    double highest = 0.0;  ///< of a hinge's angle, or of the whole turn from `usual`; radians
    /// Standard deviation of the angular acceleration at 60 frames a second; radians / s^2.
    double acceleration = 0.0;
    std::size_t first = 0;  ///< its first variable

    /// Number of variables.
    [[nodiscard]] std::size_t size() const noexcept { return is_hinge ? 1 : 3; }
};

inline constexpr std::size_t kMostJoints = 24;     ///< of a model
inline constexpr std::size_t kMostVariables = 64;  ///< of a model
inline constexpr std::size_t kHipsPlace =
    0;  ///< the first three variables: the hips' place, metres

/// A posture of a model.
struct BodyState {
    glm::dvec3 hips{};  ///< their place, metres
    /// By joint: the turn of each of its bones; of hinges unused.
    std::array<glm::dquat, kMostJoints> turns{};
    std::array<double, kMostJoints> angles{};  ///< by joint: of hinges; radians
};

/// Points of a sole that stand on the floor.
enum class SolePoint : std::uint8_t { toe_tip, ball, heel };
inline constexpr std::size_t kSolePoints = 3;  ///< of a foot

/// Lengths of a body in double precision, and where its markers are.
struct BodyShape {
    std::array<glm::dvec3, motion::kBoneCount> offsets{};  ///< as Skeleton's; metres
    /// By SolePoint, on the left: in the frame of the foot, the tip's in that of the toes.
    std::array<glm::dvec3, kSolePoints> sole{};
    std::vector<glm::dvec3> marker_places;  ///< by marker, in their bones' frames

    /// A sole's point of one side, in its bone's frame.
    [[nodiscard]] glm::dvec3 sole_point(motion::Side side, SolePoint point) const noexcept {
        glm::dvec3 place = sole[static_cast<std::size_t>(point)];
        place.x = side == motion::Side::left ? place.x : -place.x;
        return place;
    }
};

/// The bone that a point of a sole is fixed to.
[[nodiscard]] constexpr motion::Bone sole_bone(motion::Side side, SolePoint point) noexcept {
    return motion::on_side(
        point == SolePoint::toe_tip ? motion::Bone::left_toes : motion::Bone::left_foot, side);
}

/// Places of all bones in one state.
struct PlacedBody {
    std::array<glm::dvec3, motion::kBoneCount> places{};  ///< of the joints; metres
    std::array<glm::dmat3, motion::kBoneCount> frames{};  ///< by bone
    /// By part (a joint's bone): the frame in which it turns.
    std::array<glm::dmat3, 2 * kMostJoints> part_frames{};

    /// World place of a point fixed to a bone.
    [[nodiscard]] glm::dvec3 point(motion::Bone bone, const glm::dvec3& local) const noexcept {
        return places[motion::index_of(bone)] + frames[motion::index_of(bone)] * local;
    }
};

/// How a point moves with the variables: those that it depends on, and its derivatives.
struct PointMotion {
    std::size_t count = 0;                                ///< entries below
    std::array<std::size_t, kMostVariables> variables{};  ///< which
    std::array<glm::dvec3, kMostVariables> moves{};       ///< metres a unit of the variable
};

/// The joints of a body and their order. Threads: any, once made.
class BodyModel {
 public:
    /// One bone of a joint. Parts of one bone turn one after the other.
    struct Part {
        std::size_t joint = 0;
        motion::Bone bone = motion::Bone::hips;
    };

    /// The model of a kind.
    explicit BodyModel(BodyKind kind);
    /// A model of these joints: that of the hips first, parents before what hangs on them (of one
    /// bone, too), each but for its variables. read_body_model checks that they are a body.
    explicit BodyModel(std::vector<TurningJoint> joints);

    /// Its joints, the hips' turn first.
    [[nodiscard]] const std::vector<TurningJoint>& joints() const noexcept { return joints_; }
    /// Number of variables.
    [[nodiscard]] std::size_t variables() const noexcept { return variables_; }
    /// Its parts, the hips first; those of a bone in the order in which they turn.
    [[nodiscard]] const std::vector<Part>& parts() const noexcept { return parts_; }

    /// The joint that a joint hangs on; of the first itself.
    [[nodiscard]] std::size_t parent_of(std::size_t joint) const noexcept;

    /// Standing, facing +z, each joint as usual.
    [[nodiscard]] BodyState usual_state(const BodyShape& shape) const;
    /// The state after a change of the variables (`variables()` numbers).
    [[nodiscard]] BodyState moved(const BodyState& state, const double* change) const;
    /// Where the bones are.
    [[nodiscard]] PlacedBody place(const BodyShape& shape, const BodyState& state) const;
    /// How a point of a bone, which is at `point` in the world, moves with the variables.
    [[nodiscard]] PointMotion motion_of(const PlacedBody& body,
                                        motion::Bone bone,
                                        const glm::dvec3& point) const;
    /// The turn of all bones of a joint together, as a vector (a hinge's: x); radians.
    [[nodiscard]] glm::dvec3 turn_of(const BodyState& state, std::size_t joint) const;
    /// How far a joint is turned: a hinge's angle, of others the whole turn from the usual one;
    /// radians.
    [[nodiscard]] double from_usual(const BodyState& state, std::size_t joint) const;
    /// The same joints without limits.
    [[nodiscard]] BodyModel without_limits() const;
    /// The turn of one bone of a joint.
    [[nodiscard]] glm::dquat local_turn(const BodyState& state, std::size_t joint) const;
    /// The state as a pose of the humanoid.
    [[nodiscard]] motion::Pose pose_of(const BodyState& state) const;
    /// The state `share` of the way between two; [0, 1].
    [[nodiscard]] BodyState between(const BodyState& from, const BodyState& to, double share) const;

 private:
    void add(TurningJoint joint);
    void find_parts_of_bones();
    [[nodiscard]] bool has_joint(std::string_view name) const noexcept;
    void add_trunk(BodyKind kind);
    void add_side(BodyKind kind, motion::Side side);

    std::vector<TurningJoint> joints_;
    std::vector<Part> parts_;
    // By bone: the parts that turn it itself, and those that move it, in order.
    std::array<std::vector<std::size_t>, motion::kBoneCount> own_parts_;
    std::array<std::vector<std::size_t>, motion::kBoneCount> moving_parts_;
    std::size_t variables_ = 3;
};

// Rotations as vectors: their axis times their angle in radians.

/// The rotation of a vector.
[[nodiscard]] glm::dquat turned_by(const glm::dvec3& turn) noexcept;
/// The vector of a rotation, the shorter way round.
[[nodiscard]] glm::dvec3 turn_vector(const glm::dquat& rotation) noexcept;
/// How the vector of a rotation changes with a small turn of it in its own frame (the inverse of
/// the right Jacobian of SO(3)).
[[nodiscard]] glm::dmat3 turn_vector_change(const glm::dvec3& turn) noexcept;

}  // namespace raks::capture
