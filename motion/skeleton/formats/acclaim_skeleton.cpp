#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <string>
#include <utility>

#include "base/printable.hpp"
#include "motion/skeleton/formats/acclaim.hpp"
#include "motion/skeleton/formats/motion_limits.hpp"
#include "motion/skeleton/formats/motion_text.hpp"

#include <glm/geometric.hpp>
#include <glm/trigonometric.hpp>

namespace raks::motion {
namespace {

// The scale of all of CMU's files: their lengths divided by it are inches (mocap.cs.cmu.edu/faqs).
constexpr double kCmuLength = 0.45;
constexpr double kInch = 0.0254;  // metres

struct AcclaimBone {
    std::string name;
    std::size_t line = 0;  // where it begins
    std::optional<glm::dvec3> direction;
    std::optional<double> length;
    glm::dquat axis{1.0, 0.0, 0.0, 0.0};
    std::vector<AcclaimFreedom> freedoms;
    std::optional<std::size_t> parent;  // 0: the root, else the bone's number plus 1
    std::vector<std::size_t> children;
};

std::optional<AcclaimFreedom> freedom_of(std::string_view word) {
    constexpr std::array<std::string_view, 7> kNames = {"tx", "ty", "tz", "rx", "ry", "rz", "l"};
    const std::string plain = lower(word);
    const auto* const found = std::find(kNames.begin(), kNames.end(), plain);
    return found == kNames.end()
               ? std::nullopt
               : std::optional(static_cast<AcclaimFreedom>(found - kNames.begin()));
}

// Turns about the axes of an order such as "XYZ", of which the first comes first.
std::optional<glm::dquat> turned(const glm::dvec3& angles, std::string_view order) {
    if (order.empty()) {
        order = "xyz";
    }
    glm::dquat rotation(1.0, 0.0, 0.0, 0.0);
    const std::string letters = lower(order);
    if (letters.size() != 3) {
        return std::nullopt;
    }
    for (std::size_t i = 0; i < 3; ++i) {
        if (letters[i] < 'x' || letters[i] > 'z') {
            return std::nullopt;
        }
        glm::dvec3 axis(0.0);
        axis[letters[i] - 'x'] = 1.0;
        // The numbers stand in the order of the letters.
        rotation = glm::angleAxis(angles[static_cast<int>(i)], axis) * rotation;
    }
    return rotation;
}

class AsfReader {
 public:
    AsfReader(std::string_view text, std::string_view name) : text_(text, name) {}

    Expected<AcclaimSkeleton> read() {
        // The root is a bone without length.
        root_.direction = glm::dvec3(0.0);
        root_.length = 0.0;
        root_.name = "root";
        bones_.push_back(root_);
        for (; !text_.is_at_end(); text_.advance()) {
            if (auto done = parse_line(); !done) {
                return fail(std::move(done.error()));
            }
        }
        return build();
    }

 private:
    Expected<void> parse_line() {
        std::string_view rest = text_.line().text;
        if (rest.front() == '#') {
            return {};
        }
        if (rest.front() == ':') {
            section_ = lower(take_word(rest));
            return {};
        }
        if (section_ == ":units") {
            return parse_unit(rest);
        }
        if (section_ == ":root") {
            return parse_root(rest);
        }
        if (section_ == ":bonedata") {
            return parse_bone(rest);
        }
        if (section_ == ":hierarchy") {
            return parse_children(rest);
        }
        if (section_.empty()) {
            return text_.fault(text_.line_number(), "is not an Acclaim skeleton (.asf)");
        }
        return {};
    }

    Expected<double> number(std::string_view& rest) const {
        return text_.number(take_word(rest), text_.line_number());
    }
    Expected<glm::dvec3> vector(std::string_view& rest) const {
        glm::dvec3 result(0.0);
        for (int i = 0; i < 3; ++i) {
            const auto value = number(rest);
            if (!value) {
                return fail(value.error());
            }
            result[i] = *value;
        }
        return result;
    }

    Expected<void> parse_unit(std::string_view rest) {
        const std::string key = lower(take_word(rest));
        if (key == "length") {
            const auto value = number(rest);
            if (!value) {
                return fail(value.error());
            }
            if (std::abs(*value - kCmuLength) < 1e-6) {
                metres_per_unit_ = kInch / kCmuLength;
            }
        } else if (key == "angle") {
            is_radians_ = lower(take_word(rest)).substr(0, 3) == "rad";
        }
        return {};
    }

    Expected<void> parse_root(std::string_view rest) {
        const std::string key = lower(take_word(rest));
        if (key == "order") {
            return parse_freedoms(rest, bones_[0]);
        }
        if (key == "axis") {
            root_order_ = std::string(take_word(rest));
        } else if (key == "position") {
            const auto place = vector(rest);
            if (!place) {
                return fail(place.error());
            }
            root_place_ = *place;
        } else if (key == "orientation") {
            const auto angles = vector(rest);
            if (!angles) {
                return fail(angles.error());
            }
            root_turn_ = *angles;
        }
        return {};
    }

    Expected<void> parse_freedoms(std::string_view rest, AcclaimBone& bone) {
        while (!trimmed(rest).empty()) {
            const std::string_view word = take_word(rest);
            const auto freedom = freedom_of(word);
            if (!freedom || bone.freedoms.size() == 7) {
                return text_.fault(
                    text_.line_number(),
                    fmt::format("\"{}\" is not a degree of freedom (tx ty tz rx ry rz l)",
                                printable(word, 40)));
            }
            bone.freedoms.push_back(*freedom);
        }
        return {};
    }

    Expected<void> parse_bone(std::string_view rest) {
        const std::size_t line = text_.line_number();
        const std::string key = lower(take_word(rest));
        if (key == "begin") {
            if (bones_.size() > kMostJoints) {
                return text_.fault(line, fmt::format("more than {} bones", kMostJoints));
            }
            bones_.emplace_back();
            bones_.back().line = line;
            return {};
        }
        if (bones_.size() == 1) {
            return text_.fault(line, "a bone begins with \"begin\"");
        }
        AcclaimBone& bone = bones_.back();
        if (key == "name") {
            bone.name = std::string(trimmed(rest));
        } else if (key == "dof") {
            return parse_freedoms(rest, bone);
        } else if (key == "length") {
            const auto value = number(rest);
            if (!value) {
                return fail(value.error());
            }
            bone.length = *value;
        } else if (key == "direction") {
            const auto value = vector(rest);
            if (!value) {
                return fail(value.error());
            }
            const double size = glm::length(*value);
            bone.direction = size > 1e-9 ? *value / size : glm::dvec3(0.0);
        } else if (key == "axis") {
            const auto angles = vector(rest);
            if (!angles) {
                return fail(angles.error());
            }
            return take_axis(*angles, take_word(rest), bone);
        }
        return {};  // id, bodymass, cofmass, limits and their further lines, end
    }

    Expected<void> take_axis(const glm::dvec3& angles, std::string_view order, AcclaimBone& bone) {
        const auto axis = turned(is_radians_ ? angles : glm::radians(angles), order);
        if (!axis) {
            return text_.fault(
                text_.line_number(),
                fmt::format("\"{}\" is not an order of axes, such as xyz", printable(order, 40)));
        }
        bone.axis = *axis;
        return {};
    }

    std::optional<std::size_t> bone_named(std::string_view name) {
        if (index_.empty()) {
            for (std::size_t i = 0; i < bones_.size(); ++i) {
                index_.emplace(bones_[i].name, i);
            }
        }
        const auto found = index_.find(std::string(name));
        return found == index_.end() ? std::nullopt : std::optional(found->second);
    }

    // "parent child child ...".
    Expected<void> parse_children(std::string_view rest) {
        const std::size_t line = text_.line_number();
        const std::string_view first = take_word(rest);
        if (first == "begin" || first == "end") {
            return {};
        }
        const auto parent = bone_named(first);
        if (!parent) {
            return text_.fault(line, fmt::format("there is no bone \"{}\"", printable(first, 40)));
        }
        while (!trimmed(rest).empty()) {
            const std::string_view word = take_word(rest);
            const auto child = bone_named(word);
            if (!child || *child == 0) {
                return text_.fault(line,
                                   fmt::format("there is no bone \"{}\"", printable(word, 40)));
            }
            if (bones_[*child].parent) {
                return text_.fault(
                    line, fmt::format("the bone \"{}\" has two parents", printable(word, 40)));
            }
            bones_[*child].parent = *parent;
            bones_[*parent].children.push_back(*child);
        }
        return {};
    }

    Expected<AcclaimSkeleton> build() {
        if (bones_.size() == 1) {
            return text_.fault("has no bones: this is not an Acclaim skeleton (.asf)");
        }
        if (index_.size() != bones_.size()) {
            return text_.fault(index_.empty() ? "has no hierarchy" : "has two bones of one name");
        }
        if (auto done = take_axis(root_turn_, root_order_, bones_[0]); !done) {
            return fail(std::move(done.error()));
        }
        AcclaimSkeleton skeleton;
        skeleton.metres_per_unit = metres_per_unit_;
        std::vector<std::size_t> joint_of(bones_.size(), 0);
        // From the root outward, so that a ring of bones is never entered.
        std::vector<std::size_t> open = {0};
        while (!open.empty()) {
            const std::size_t at = open.back();
            open.pop_back();
            const AcclaimBone& bone = bones_[at];
            if (!bone.direction || !bone.length) {
                return text_.fault(bone.line,
                                   fmt::format("the bone \"{}\" needs a direction and a length",
                                               printable(bone.name, 40)));
            }
            joint_of[at] = skeleton.joints.size();
            const std::size_t parent = bone.parent.value_or(0);
            ClipJoint joint{bone.name, joint_of[parent], root_place_, std::nullopt};
            if (at != 0) {
                joint.offset = *bones_[parent].direction * *bones_[parent].length;
            }
            if (bone.children.empty()) {
                joint.end_site = *bone.direction * *bone.length;
            }
            skeleton.joints.push_back(std::move(joint));
            skeleton.axes.push_back(bone.axis);
            skeleton.freedoms.push_back(bone.freedoms);
            open.insert(open.end(), bone.children.rbegin(), bone.children.rend());
        }
        if (skeleton.joints.size() != bones_.size()) {
            return text_.fault(fmt::format("{} of its {} bones do not hang on the root",
                                           bones_.size() - skeleton.joints.size(),
                                           bones_.size() - 1));
        }
        return skeleton;
    }

    MotionText text_;
    std::string section_;  // the keyword with its colon
    bool is_radians_ = false;
    std::optional<double> metres_per_unit_;
    AcclaimBone root_;
    std::string root_order_;
    glm::dvec3 root_place_{};
    glm::dvec3 root_turn_{};
    std::vector<AcclaimBone> bones_;  // the root first
    std::map<std::string, std::size_t> index_;
};

}  // namespace

Expected<AcclaimSkeleton> parse_asf(std::string_view text, std::string_view name) {
    return AsfReader(text, name).read();
}

}  // namespace raks::motion
