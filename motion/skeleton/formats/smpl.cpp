#include "motion/skeleton/formats/smpl.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <initializer_list>
#include <string>
#include <utility>

#include "base/printable.hpp"
#include "motion/skeleton/formats/motion_limits.hpp"

#include <glm/geometric.hpp>
#include <glm/gtc/quaternion.hpp>

namespace raks::motion {
namespace {

constexpr std::size_t kBodyJoints = 22;  // that SMPL-H and SMPL-X have of the body
constexpr double kLargestScaling = 1e6;
constexpr double kLargestTurn = 1e3;     // radians; beyond it a file is damaged
constexpr std::size_t kNamesShown = 12;  // arrays of a file in a message

// Tips that SMPL has no joints for: estimates. The crown over the head, the toes before the foot.
constexpr std::size_t kHeadJoint = 15;
constexpr std::size_t kLeftToes = 10;
constexpr std::size_t kRightToes = 11;
const glm::dvec3 kCrown(0.0, 0.17, 0.02);
const glm::dvec3 kToeTip(0.0, -0.01, 0.07);

// The first of these arrays that is there, by name. Null: none is.
struct FoundArray {
    std::string_view name;
    const NumberArray* array = nullptr;
};
FoundArray first_of(const NumberArrays& arrays, std::initializer_list<std::string_view> names) {
    for (const std::string_view name : names) {
        if (const auto found = arrays.find(std::string(name)); found != arrays.end()) {
            return {name, &found->second};
        }
    }
    return {};
}

// Frames and joints of an array of turns, whether their axes are an index of their own or not.
struct TurnShape {
    std::size_t frames = 0;
    std::size_t joints = 0;
};
Expected<TurnShape> turn_shape(const FoundArray& found) {
    const std::vector<std::size_t>& shape = found.array->shape;
    if (shape.size() == 3 && shape[2] == 3) {
        return TurnShape{shape[0], shape[1]};
    }
    if (shape.size() == 2 && shape[1] % 3 == 0) {
        return TurnShape{shape[0], shape[1] / 3};
    }
    return fail(
        fmt::format("{} has the shape {}; SMPL has (frames, 72), (frames, 24, 3) or "
                    "(frames, 156): axis times angle",
                    found.name,
                    shape_text(shape)));
}

// One number, alone or in an array of one.
Expected<double> single(const FoundArray& found, double least, double largest) {
    if (found.array->values.size() != 1) {
        return fail(fmt::format("{} has the shape {}; it must be one number",
                                found.name,
                                shape_text(found.array->shape)));
    }
    const double value = found.array->values[0];
    if (!(value >= least && value <= largest)) {
        return fail(fmt::format("{} is {}, which is impossible", found.name, value));
    }
    return value;
}

// From axis times angle.
glm::dquat rotation_of(const glm::dvec3& turn) {
    const double angle = glm::length(turn);
    if (angle < 1e-12) {
        return {1.0, 0.0, 0.0, 0.0};
    }
    return glm::angleAxis(angle, turn / angle);
}

class SmplReader {
 public:
    SmplReader(const NpzContent& content, std::optional<double> rate)
        : content_(content), arrays_(content.arrays), rate_(rate) {}

    Expected<MotionClip> read() {
        for (const auto step : {&SmplReader::find_turns,
                                &SmplReader::find_rate,
                                &SmplReader::find_way,
                                &SmplReader::check_numbers}) {
            if (auto done = (this->*step)(); !done) {
                return fail(std::move(done.error()));
            }
        }
        build_skeleton();
        fill_frames();
        add_warnings();
        return std::move(clip_);
    }

 private:
    // The arrays of turns: of all joints, or of the body and the root apart.
    Expected<void> find_turns() {
        body_ = first_of(arrays_, {"poses", "smpl_poses", "pose"});
        if (body_.array == nullptr) {
            body_ = first_of(arrays_, {"body_pose", "pose_body"});
            root_ = first_of(arrays_, {"global_orient", "root_orient"});
            if (body_.array == nullptr || root_.array == nullptr) {
                return fail(no_poses());
            }
        }
        const auto shape = turn_shape(body_);
        if (!shape) {
            return fail(shape.error());
        }
        if (root_.array != nullptr) {
            const auto root = turn_shape(root_);
            if (!root || root->joints != 1 || root->frames != shape->frames) {
                return fail(
                    fmt::format("{} has the shape {} beside {} with {}; it must be one turn "
                                "a frame",
                                root_.name,
                                shape_text(root_.array->shape),
                                body_.name,
                                shape_text(body_.array->shape)));
            }
        }
        in_file_ = shape->joints + (root_.array != nullptr ? 1 : 0);
        const bool is_body = in_file_ >= kBodyJoints && in_file_ <= smpl_joints().size();
        if (!is_body && in_file_ != 52 && in_file_ != 55) {
            return fail(
                fmt::format("{} has the shape {}: {} joints; SMPL has 22 to 24, with hands "
                            "52 or 55",
                            body_.name,
                            shape_text(body_.array->shape),
                            in_file_));
        }
        joints_ = is_body ? in_file_ : kBodyJoints;
        if (shape->frames == 0) {
            return fail("has no frames");
        }
        if (shape->frames > kMostJointFrames / joints_) {
            return fail(fmt::format("has {} frames, which are too many", shape->frames));
        }
        clip_.frame_count = shape->frames;
        return {};
    }

    std::string no_poses() const {
        std::string names;
        for (std::size_t i = 0; i < std::min(content_.names.size(), kNamesShown); ++i) {
            names += (i == 0 ? "" : ", ") + printable(content_.names[i], 40);
        }
        return "holds no SMPL poses (poses, smpl_poses, or body_pose and global_orient); it "
               "holds " +
               (names.empty() ? "no arrays" : names) +
               (content_.names.size() > kNamesShown ? ", ..." : "");
    }

    Expected<void> find_rate() {
        const FoundArray rate = first_of(
            arrays_, {"mocap_framerate", "mocap_frame_rate", "fps", "framerate", "frame_rate"});
        if (rate_) {
            clip_.frames_per_second = *rate_;
            return {};
        }
        if (rate.array == nullptr) {
            // AIST++ keeps none and has 60; what networks write has mostly 30.
            clip_.frames_per_second = arrays_.contains("smpl_scaling") ? 60.0 : 30.0;
            clip_.warnings.push_back(
                fmt::format("says no frame rate: {:g} a second are taken (--fps sets it)",
                            clip_.frames_per_second));
            return {};
        }
        const auto value = single(rate, kLeastRate, kLargestRate);
        if (!value) {
            return fail(value.error());
        }
        clip_.frames_per_second = *value;
        return {};
    }

    Expected<void> find_way() {
        way_ = first_of(arrays_, {"trans", "smpl_trans", "transl", "translation"});
        if (way_.array == nullptr) {
            return {};
        }
        const std::vector<std::size_t>& shape = way_.array->shape;
        if (shape.size() != 2 || shape[0] != clip_.frame_count || shape[1] != 3) {
            return fail(fmt::format("{} has the shape {}; it must be ({}, 3), a place a frame",
                                    way_.name,
                                    shape_text(shape),
                                    clip_.frame_count));
        }
        if (const FoundArray scaling = first_of(arrays_, {"smpl_scaling"});
            scaling.array != nullptr) {
            const auto value = single(scaling, 1e-6, kLargestScaling);
            if (!value) {
                return fail(value.error());
            }
            scaling_ = *value;
        }
        return {};
    }

    // The first number that is not finite, or so large that the file is damaged.
    Expected<void> check_numbers() {
        for (const FoundArray& found : {body_, root_, way_}) {
            if (found.array == nullptr) {
                continue;
            }
            const double largest =
                found.name == way_.name ? kLargestMotionNumber * scaling_ : kLargestTurn;
            const std::vector<double>& values = found.array->values;
            const auto bad = std::find_if(values.begin(), values.end(), [&](double value) {
                return !(std::abs(value) <= largest);
            });
            if (bad != values.end()) {
                const std::size_t row = values.size() / clip_.frame_count;
                return fail(fmt::format("{}: frame {} holds {}, which is impossible",
                                        found.name,
                                        static_cast<std::size_t>(bad - values.begin()) / row,
                                        *bad));
            }
        }
        return {};
    }

    void build_skeleton() {
        clip_.metres_per_unit = 1.0;
        clip_.rests_in_t_pose = true;
        for (std::size_t j = 0; j < joints_; ++j) {
            const SmplJoint& joint = smpl_joints()[j];
            clip_.joints.push_back(
                {std::string(joint.name), joint.parent, joint.offset, std::nullopt});
        }
        clip_.joints[kHeadJoint].end_site = kCrown;
        clip_.joints[kLeftToes].end_site = clip_.joints[kRightToes].end_site = kToeTip;
        // Without joints for the hands their bases are tips.
        for (std::size_t hand = joints_; hand < smpl_joints().size(); ++hand) {
            clip_.joints[smpl_joints()[hand].parent].end_site = smpl_joints()[hand].offset;
        }
    }

    void fill_frames() {
        clip_.rotations.reserve(clip_.frame_count * joints_);
        clip_.positions.reserve(clip_.frame_count * joints_);
        for (std::size_t frame = 0; frame < clip_.frame_count; ++frame) {
            for (std::size_t j = 0; j < joints_; ++j) {
                clip_.rotations.push_back(rotation_of(turn(frame, j)));
                clip_.positions.push_back(j == 0 && way_.array != nullptr
                                              ? vector_at(*way_.array, frame) / scaling_
                                              : clip_.joints[j].offset);
            }
        }
    }

    static glm::dvec3 vector_at(const NumberArray& array, std::size_t index) {
        const double* const at = array.values.data() + 3 * index;
        return {at[0], at[1], at[2]};
    }
    glm::dvec3 turn(std::size_t frame, std::size_t joint) const {
        if (root_.array == nullptr) {
            return vector_at(*body_.array, frame * in_file_ + joint);
        }
        return joint == 0 ? vector_at(*root_.array, frame)
                          : vector_at(*body_.array, frame * (in_file_ - 1) + joint - 1);
    }

    void add_warnings() {
        if (in_file_ > smpl_joints().size()) {
            clip_.warnings.emplace_back("turns of the fingers and the face are left out");
        }
        if (way_.array == nullptr) {
            clip_.warnings.emplace_back("holds no translation: the body turns in one place");
        }
        if (std::find(content_.names.begin(), content_.names.end(), "betas") !=
            content_.names.end()) {
            clip_.warnings.push_back(
                fmt::format("the person's own shape (betas) is left out: a mean body of {:.4g} m",
                            kSmplHeight));
        }
    }

    const NpzContent& content_;
    const NumberArrays& arrays_;
    std::optional<double> rate_;
    FoundArray body_;
    FoundArray root_;          // null: the body's array begins with it
    FoundArray way_;           // of the root; null: none
    double scaling_ = 1.0;     // of the way
    std::size_t in_file_ = 0;  // joints a frame
    std::size_t joints_ = 0;   // of them that are read
    MotionClip clip_;
};

}  // namespace

const std::array<SmplJoint, 24>& smpl_joints() noexcept {
    static const std::array<SmplJoint, 24> kJoints = {{
        {"hips", 0, {0.0, 0.0, 0.0}},
        {"leftUpperLeg", 0, {0.05858135, -0.08228004, -0.01766408}},
        {"rightUpperLeg", 0, {-0.06030973, -0.09051332, -0.01354254}},
        {"spine", 0, {0.00443945, 0.12440352, -0.03838522}},
        {"leftLowerLeg", 1, {0.04345142, -0.38646945, 0.008037}},
        {"rightLowerLeg", 2, {-0.04325663, -0.38368791, -0.00484304}},
        {"chest", 3, {0.00448844, 0.1379564, 0.02682033}},
        {"leftFoot", 4, {-0.01479032, -0.42687458, -0.037428}},
        {"rightFoot", 5, {0.01905555, -0.4200455, -0.03456167}},
        {"upperChest", 6, {-0.00226458, 0.05603239, 0.00285505}},
        {"leftToes", 7, {0.04105436, -0.06028581, 0.12204243}},
        {"rightToes", 8, {-0.03483987, -0.06210566, 0.13032329}},
        {"neck", 9, {-0.0133902, 0.21163553, -0.03346758}},
        {"leftShoulder", 9, {0.07170245, 0.11399969, -0.01889817}},
        {"rightShoulder", 9, {-0.08295366, 0.11247234, -0.02370739}},
        {"head", 12, {0.01011321, 0.08893734, 0.05040987}},
        {"leftUpperArm", 13, {0.12292141, 0.04520509, -0.019046}},
        {"rightUpperArm", 14, {-0.11322832, 0.04685326, -0.00847207}},
        {"leftLowerArm", 16, {0.2553319, -0.01564902, -0.02294649}},
        {"rightLowerArm", 17, {-0.26012748, -0.01436928, -0.03126873}},
        {"leftHand", 18, {0.26570925, 0.01269811, -0.00737473}},
        {"rightHand", 19, {-0.26910836, 0.00679372, -0.00602676}},
        {"leftHandEnd", 20, {0.08669055, -0.01063603, -0.01559429}},
        {"rightHandEnd", 21, {-0.0887537, -0.00865157, -0.01010708}},
    }};
    return kJoints;
}

Expected<MotionClip> smpl_clip(const NpzContent& content, std::optional<double> frames_per_second) {
    return SmplReader(content, frames_per_second).read();
}

}  // namespace raks::motion
