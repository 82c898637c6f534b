#include "motion/capture/solving/body_file.hpp"

#include "base/toml_reader.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>
#include <utility>
#include <vector>

#include "base/plain_name.hpp"

#include <glm/geometric.hpp>

namespace raks::capture {
namespace {

using motion::Bone;

constexpr std::string_view kBodyFormat = "raks-joints";
constexpr double kFiledDegree = M_PI / 180.0;
constexpr double kFiledNoLimit = 1e3;  // radians
constexpr double kUsualDeviation = 60.0 * kFiledDegree;
constexpr double kUsualAcceleration = 80.0;  // radians / s^2
constexpr NumberRange kTurnRange = {-360.0, 360.0};

/// A joint as the file has it.
struct FiledJoint {
    TurningJoint joint;
    std::string parent;  ///< empty: the root
    std::size_t line = 0;
};

void read_turned_bones(const toml::table& table, TurningJoint& joint, TomlComplaints& complaints) {
    const toml::array* const bones = table["bones"].as_array();
    if (bones == nullptr || bones->empty() || bones->size() > joint.bones.size()) {
        complaints.complain(table, "needs bones = [\"leftUpperArm\"], 1 to 3");
        return;
    }
    joint.count = bones->size();
    for (std::size_t i = 0; i < joint.count; ++i) {
        joint.bones[i] =
            static_cast<Bone>(complaints.word((*bones)[i], "bone", motion::kBoneNames));
        if (i > 0 &&
            motion::kBoneParents[index_of(joint.bones[i])] != index_of(joint.bones[i - 1])) {
            complaints.complain(
                table,
                fmt::format("{} does not hang on {}: bones that share a turn follow one another",
                            motion::kBoneNames[index_of(joint.bones[i])],
                            motion::kBoneNames[index_of(joint.bones[i - 1])]));
        }
    }
}

glm::dvec3 filed_vector(const toml::node& node,
                        std::string_view name,
                        NumberRange range,
                        TomlComplaints& complaints) {
    const auto values = complaints.numbers<3>(node, name, range, "[x, y, z]");
    return {values[0], values[1], values[2]};
}

void read_filed_hinge(const toml::table& table, TurningJoint& joint, TomlComplaints& complaints) {
    joint.is_hinge = true;
    joint.axis = filed_vector(*table.get("axis"), "axis", {-1e6, 1e6}, complaints);
    if (glm::length(joint.axis) < 1e-6) {
        complaints.complain(table, "axis has no length; [1, 0, 0] is the left");
    } else {
        joint.axis = glm::normalize(joint.axis);
    }
    joint.lowest = -M_PI;
    joint.highest = M_PI;
    if (const toml::node* const limits = table.get("limits")) {
        const auto ends =
            complaints.numbers<2>(*limits, "limits", kTurnRange, "[lowest, highest], degrees");
        joint.lowest = ends[0] * kFiledDegree;
        joint.highest = ends[1] * kFiledDegree;
        if (joint.lowest >= joint.highest) {
            complaints.complain(*limits, "limits must rise: [lowest, highest], degrees");
        }
    }
    joint.usual_angle = std::clamp(0.0, joint.lowest, std::max(joint.lowest, joint.highest));
    joint.deviation = glm::dvec3(kUsualDeviation, 0.0, 0.0);
    if (const toml::node* const usual = table.get("usual")) {
        joint.usual_angle = complaints.number(*usual, "usual", kTurnRange) * kFiledDegree;
        if (joint.usual_angle < joint.lowest || joint.usual_angle > joint.highest) {
            complaints.complain(*usual, "usual lies beyond the limits");
        }
    }
    if (const toml::node* const deviation = table.get("deviation")) {
        joint.deviation.x = complaints.number(*deviation, "deviation", {0.1, 1e6}) * kFiledDegree;
    }
}

void read_filed_ball(const toml::table& table, TurningJoint& joint, TomlComplaints& complaints) {
    joint.highest = kFiledNoLimit;
    joint.deviation = glm::dvec3(kUsualDeviation);
    if (const toml::node* const limit = table.get("limit")) {
        joint.highest = complaints.number(*limit, "limit", {1.0, 180.0}) * kFiledDegree;
    }
    if (const toml::node* const usual = table.get("usual")) {
        joint.usual =
            turned_by(kFiledDegree * filed_vector(*usual, "usual", kTurnRange, complaints));
        if (joint.count > 1) {
            complaints.complain(*usual, "usual is for joints of one bone");
        }
    }
    if (const toml::node* const deviation = table.get("deviation")) {
        joint.deviation =
            kFiledDegree * filed_vector(*deviation, "deviation", {0.1, 1e6}, complaints);
    }
}

void read_filed_turn(const toml::table& table,
                     bool is_root,
                     TurningJoint& joint,
                     TomlComplaints& complaints) {
    joint.acceleration = kUsualAcceleration;
    complaints.read(table, "acceleration", {0.1, 1e5}, joint.acceleration);
    const bool is_hinge = table.contains("axis");
    for (const auto& [key, form] : {std::pair("limits", is_hinge), std::pair("limit", !is_hinge)}) {
        if (const toml::node* const node = table.get(key); node != nullptr && !form) {
            complaints.complain(*node,
                                is_hinge ? "a hinge has limits = [lowest, highest]"
                                         : "limits are those of a hinge, which has an axis; else "
                                           "limit = the whole turn");
        }
    }
    if (is_root) {
        for (const char* const key : {"axis", "limits", "limit", "usual", "deviation"}) {
            if (const toml::node* const node = table.get(key)) {
                complaints.complain(*node, "the root turns as it likes: name and bones alone");
            }
        }
        joint.highest = kFiledNoLimit;
        joint.deviation = glm::dvec3(kFiledNoLimit);
    } else if (is_hinge) {
        read_filed_hinge(table, joint, complaints);
        if (joint.count > 1) {
            complaints.complain(table, "a hinge has one bone");
        }
    } else {
        read_filed_ball(table, joint, complaints);
    }
}

std::vector<FiledJoint> read_filed_joints(const toml::table& root, TomlComplaints& complaints) {
    std::vector<FiledJoint> joints;
    const toml::array* const nodes = root["joint"].as_array();
    if (nodes == nullptr || nodes->empty() || nodes->size() > kMostJoints) {
        complaints.complain(
            fmt::format("needs [[joint]] with name and bones, 1 to {}", kMostJoints));
        return joints;
    }
    constexpr std::array<std::string_view, 9> kKeys = {
        "name", "parent", "bones", "axis", "limits", "limit", "usual", "deviation", "acceleration"};
    for (const toml::node& node : *nodes) {
        const toml::table* const table = node.as_table();
        if (table == nullptr) {
            complaints.complain(node, "a joint must be a table [[joint]]");
            continue;
        }
        complaints.check_keys(*table, kKeys);
        FiledJoint filed;
        filed.line = table->source().begin.line;
        filed.joint.name = complaints.text(*table, "name");
        filed.parent = complaints.text(*table, "parent");
        if (!is_plain_name(filed.joint.name) ||
            filed.joint.name.find_first_of(",\t\"") != std::string::npos) {
            complaints.complain(*table, "needs name = \"leftElbow\" or another short text");
        }
        const auto is_same = [&](const FiledJoint& other) {
            return other.joint.name == filed.joint.name;
        };
        if (std::any_of(joints.begin(), joints.end(), is_same)) {
            complaints.complain(*table,
                                fmt::format("two joints are called \"{}\"", filed.joint.name));
        }
        read_turned_bones(*table, filed.joint, complaints);
        read_filed_turn(*table, filed.parent.empty(), filed.joint, complaints);
        joints.push_back(std::move(filed));
    }
    return joints;
}

/// Puts the joints in order, parents first, and checks that they are a body.
class BodyBuilder {
 public:
    BodyBuilder(std::vector<FiledJoint> joints, TomlComplaints& complaints)
        : joints_(std::move(joints)), complaints_(complaints) {}

    std::vector<TurningJoint> build() {
        check_root();
        std::vector<bool> is_placed(joints_.size());
        for (bool is_done = false; !is_done && complaints_.is_sound();) {
            is_done = true;
            for (std::size_t i = 0; i < joints_.size(); ++i) {
                const auto parent = placed_called(joints_[i].parent);
                if (!is_placed[i] && (joints_[i].parent.empty() || parent)) {
                    check_place(joints_[i], parent);
                    is_placed[i] = true;
                    ordered_.push_back(joints_[i].joint);
                    is_done = false;
                    break;
                }
            }
        }
        for (std::size_t i = 0; i < joints_.size(); ++i) {
            if (!is_placed[i]) {
                complain_of_unplaced(joints_[i]);
            }
        }
        check_between();
        return std::move(ordered_);
    }

 private:
    [[nodiscard]] std::optional<std::size_t> placed_called(const std::string& name) const {
        const auto found = std::find_if(ordered_.begin(), ordered_.end(), [&](const auto& joint) {
            return joint.name == name;
        });
        return found != ordered_.end()
                   ? std::optional(static_cast<std::size_t>(found - ordered_.begin()))
                   : std::nullopt;
    }

    void check_root() {
        std::size_t roots = 0;
        for (const FiledJoint& filed : joints_) {
            if (!filed.parent.empty()) {
                continue;
            }
            if (++roots > 1) {
                complaints_.complain(filed.line,
                                     fmt::format("joint \"{}\" is a second root; give it a parent",
                                                 filed.joint.name));
            }
            if (filed.joint.bones[0] != Bone::hips || filed.joint.count != 1) {
                complaints_.complain(
                    filed.line, "the root, the joint without parent, must have bones = [\"hips\"]");
            }
        }
        if (roots == 0) {
            complaints_.complain("no joint is the root: one has no parent, and bones = [\"hips\"]");
        }
    }

    void complain_of_unplaced(const FiledJoint& filed) {
        const bool is_known =
            std::any_of(joints_.begin(), joints_.end(), [&](const FiledJoint& other) {
                return other.joint.name == filed.parent;
            });
        complaints_.complain(
            filed.line,
            is_known ? fmt::format("joint \"{}\" hangs on itself, in a loop by way of \"{}\"",
                                   filed.joint.name,
                                   filed.parent)
                     : fmt::format("joint \"{}\" hangs on \"{}\", which there is not",
                                   filed.joint.name,
                                   filed.parent));
    }

    // Where a joint hangs its bones must hang, too.
    void check_place(const FiledJoint& filed, std::optional<std::size_t> parent) {
        if (!parent) {
            return;
        }
        const Bone last = ordered_[*parent].bones[ordered_[*parent].count - 1];
        std::size_t bone = index_of(filed.joint.bones[0]);
        const bool is_same = bone == index_of(last);
        if (is_same && (bone == 0 || ordered_[*parent].count > 1 || filed.joint.count > 1)) {
            complaints_.complain(
                filed.line,
                fmt::format(
                    "joint \"{}\" turns a bone that \"{}\" turns", filed.joint.name, filed.parent));
        }
        while (bone != 0 && bone != index_of(last)) {
            bone = motion::kBoneParents[bone];
        }
        if (bone != index_of(last)) {
            complaints_.complain(filed.line,
                                 fmt::format("joint \"{}\" cannot hang on \"{}\": {} does not hang "
                                             "on {}",
                                             filed.joint.name,
                                             filed.parent,
                                             motion::kBoneNames[index_of(filed.joint.bones[0])],
                                             motion::kBoneNames[index_of(last)]));
        }
        parents_.emplace_back(ordered_.size(), *parent);
    }

    // No other joint may turn a bone between a joint and its parent, or a bone of another joint
    // that is not its parent.
    void check_between() {
        if (!complaints_.is_sound()) {
            return;
        }
        for (const auto& [child, parent] : parents_) {
            const TurningJoint& joint = ordered_[child];
            const std::size_t end = index_of(ordered_[parent].bones[ordered_[parent].count - 1]);
            std::size_t bone = index_of(joint.bones[0]);
            for (; bone != end; bone = motion::kBoneParents[bone]) {
                complain_of_turner(bone, child, parent);
            }
            for (std::size_t i = 1; i < joint.count; ++i) {
                complain_of_turner(index_of(joint.bones[i]), child, parent);
            }
        }
    }

    // Complains if a joint that does not hang on `child` turns this bone.
    void complain_of_turner(std::size_t bone, std::size_t child, std::size_t parent) {
        for (std::size_t other = 0; other < ordered_.size(); ++other) {
            const TurningJoint& joint = ordered_[other];
            const bool turns =
                std::any_of(joint.bones.begin(),
                            joint.bones.begin() + static_cast<std::ptrdiff_t>(joint.count),
                            [bone](Bone turned) { return index_of(turned) == bone; });
            if (other == child || other == parent || !turns || hangs_on(other, child)) {
                continue;
            }
            complaints_.complain(
                line_of(ordered_[child].name),
                fmt::format(
                    "joint \"{}\" turns {} between \"{}\" and \"{}\"; hang one on the other",
                    joint.name,
                    motion::kBoneNames[bone],
                    ordered_[parent].name,
                    ordered_[child].name));
        }
    }

    [[nodiscard]] bool hangs_on(std::size_t joint, std::size_t other) const {
        while (joint != other) {
            const auto found = std::find_if(parents_.begin(),
                                            parents_.end(),
                                            [joint](const auto& p) { return p.first == joint; });
            if (found == parents_.end()) {
                return false;
            }
            joint = found->second;
        }
        return true;
    }

    [[nodiscard]] std::size_t line_of(const std::string& name) const {
        const auto found = std::find_if(joints_.begin(), joints_.end(), [&](const auto& filed) {
            return filed.joint.name == name;
        });
        return found->line;
    }

    std::vector<FiledJoint> joints_;
    TomlComplaints& complaints_;
    std::vector<TurningJoint> ordered_;
    std::vector<std::pair<std::size_t, std::size_t>> parents_;  // child, parent
};

}  // namespace

Expected<BodyModel> read_body_model(std::string_view text, const std::string& file) {
    const Expected<toml::table> root = parse_toml(text, file);
    if (!root) {
        return fail(root.error());
    }
    TomlComplaints complaints(file);
    constexpr std::array<std::string_view, 3> kKeys = {"format", "version", "joint"};
    complaints.check_keys(*root, kKeys);
    complaints.check_head(*root, kBodyFormat, 1);
    std::vector<FiledJoint> filed = read_filed_joints(*root, complaints);
    if (!complaints.is_sound()) {
        return fail(complaints.fault());
    }
    std::vector<TurningJoint> joints = BodyBuilder(std::move(filed), complaints).build();
    std::size_t variables = 3;
    for (const TurningJoint& joint : joints) {
        variables += joint.size();
    }
    if (variables > kMostVariables) {
        complaints.complain(fmt::format(
            "has {} variables, may have {}: make joints hinges", variables, kMostVariables));
    }
    if (!complaints.is_sound()) {
        return fail(complaints.fault());
    }
    return BodyModel(std::move(joints));
}

std::string body_model_text(const BodyModel& model) {
    std::string text = fmt::format("format = \"{}\"\nversion = 1\n", kBodyFormat);
    const auto degrees = [](const glm::dvec3& turn) {
        const glm::dvec3 d = turn / kFiledDegree;
        return fmt::format("[{}, {}, {}]", d.x, d.y, d.z);
    };
    for (std::size_t i = 0; i < model.joints().size(); ++i) {
        const TurningJoint& joint = model.joints()[i];
        text += fmt::format("\n[[joint]]\nname = {}\n", toml_quoted(joint.name));
        if (i > 0) {
            text +=
                fmt::format("parent = {}\n", toml_quoted(model.joints()[model.parent_of(i)].name));
        }
        std::vector<std::string> bones;
        for (std::size_t k = 0; k < joint.count; ++k) {
            bones.push_back(fmt::format("\"{}\"", motion::kBoneNames[index_of(joint.bones[k])]));
        }
        text += fmt::format(
            "bones = [{}]\nacceleration = {}\n", fmt::join(bones, ", "), joint.acceleration);
        if (i == 0) {
            continue;
        }
        if (joint.is_hinge) {
            text +=
                fmt::format("axis = [{}, {}, {}]\nlimits = [{}, {}]\nusual = {}\ndeviation = {}\n",
                            joint.axis.x,
                            joint.axis.y,
                            joint.axis.z,
                            joint.lowest / kFiledDegree,
                            joint.highest / kFiledDegree,
                            joint.usual_angle / kFiledDegree,
                            joint.deviation.x / kFiledDegree);
            continue;
        }
        if (joint.highest < M_PI + 1e-9) {
            text += fmt::format("limit = {}\n", joint.highest / kFiledDegree);
        }
        if (joint.count == 1) {
            text += fmt::format("usual = {}\n", degrees(turn_vector(joint.usual)));
        }
        text += fmt::format("deviation = {}\n", degrees(joint.deviation));
    }
    return text;
}

}  // namespace raks::capture
