#include "motion/skeleton/formats/bvh_hierarchy.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <set>
#include <string>
#include <utility>

#include "motion/skeleton/formats/motion_limits.hpp"

namespace raks::motion {
namespace {

constexpr std::size_t kMaxDepth = 100;  // against files that are no skeleton
constexpr std::array<std::string_view, 6> kChannelNames = {
    "xposition", "yposition", "zposition", "xrotation", "yrotation", "zrotation"};

// Reads keywords and braces in any layout: several may share a line, and a brace may stand on the
// next one. A stack holds the joints that are open.
class HierarchyReader {
 public:
    explicit HierarchyReader(MotionText& text) : text_(text) {}

    Expected<BvhHierarchy> read() {
        if (auto done = parse_head(); !done) {
            return fail(std::move(done.error()));
        }
        if (auto done = parse_hierarchy(); !done) {
            return fail(std::move(done.error()));
        }
        return std::move(hierarchy_);
    }

 private:
    /// The first line must be HIERARCHY.
    Expected<void> parse_head() {
        if (text_.is_at_end()) {
            return text_.fault("is empty");
        }
        const std::string_view first = text_.line().text;
        if (first.substr(0, 24) == "version https://git-lfs.") {
            return text_.fault(
                "is a Git LFS pointer, not a BVH file; fetch the file itself (git lfs pull)");
        }
        if (lower(first) != "hierarchy") {
            return text_.fault("is not a BVH file: it does not start with HIERARCHY");
        }
        text_.advance();
        return {};
    }

    /// Reads lines until MOTION.
    Expected<void> parse_hierarchy() {
        for (; !text_.is_at_end(); text_.advance()) {
            const auto& [line, number] = text_.line();
            if (lower(line) == "motion") {
                return end_hierarchy(number);
            }
            std::string_view rest = line;
            while (!trimmed(rest).empty()) {
                if (auto done = parse_item(rest, number); !done) {
                    return done;
                }
            }
        }
        return stack_.empty() && !hierarchy_.joints.empty()
                   ? text_.fault(text_.line_number(), "MOTION is missing")
                   : text_.fault(text_.line_number(), "the file ends inside the HIERARCHY");
    }

    /// At MOTION all braces must be closed.
    Expected<void> end_hierarchy(std::size_t line) {
        if (!stack_.empty() || is_waiting_for_brace_) {
            return text_.fault(line, "unbalanced braces: a closing brace is missing before MOTION");
        }
        if (hierarchy_.joints.empty()) {
            return text_.fault(line, "ROOT expected before MOTION");
        }
        text_.advance();
        return {};
    }

    /// One keyword with what belongs to it, or one brace.
    Expected<void> parse_item(std::string_view& rest, std::size_t line) {
        const std::string word = lower(take_word(rest));
        if (word == "{") {
            if (!is_waiting_for_brace_) {
                return text_.fault(line, "unbalanced braces: an opening brace without a joint");
            }
            is_waiting_for_brace_ = false;
            return {};
        }
        if (is_waiting_for_brace_) {
            return text_.fault(line, "an opening brace is missing after the joint's name");
        }
        if (word == "}") {
            if (stack_.empty()) {
                return text_.fault(line, "unbalanced braces: a closing brace too many");
            }
            stack_.pop_back();
            return {};
        }
        if (word == "root" || word == "joint") {
            return open_joint(word == "root", rest, line);
        }
        if (word == "end") {
            return open_end_site(rest, line);
        }
        if (word == "offset") {
            return parse_offset(rest, line);
        }
        if (word == "channels") {
            return parse_channels(rest, line);
        }
        return text_.fault(line, "unknown keyword \"" + word.substr(0, 40) + "\"");
    }

    /// ROOT or JOINT with its name.
    Expected<void> open_joint(bool is_root, std::string_view& rest, std::size_t line) {
        if (is_root != stack_.empty()) {
            return text_.fault(line, is_root ? "ROOT inside another joint" : "ROOT expected");
        }
        if (!stack_.empty() && stack_.back().is_end_site) {
            return text_.fault(line, "a JOINT inside an End Site");
        }
        if (hierarchy_.joints.size() >= kMostJoints || stack_.size() >= kMaxDepth) {
            return text_.fault(
                line, fmt::format("more than {} joints or {} levels", kMostJoints, kMaxDepth));
        }
        // The name is the rest of the line, as it may hold blanks; an opening brace may end the
        // line.
        std::string_view name = trimmed(rest);
        rest = {};
        if (!name.empty() && name.back() == '{') {
            name = trimmed(name.substr(0, name.size() - 1));
        } else {
            is_waiting_for_brace_ = true;
        }
        const std::size_t index = hierarchy_.joints.size();
        ClipJoint joint;
        joint.name = std::string(name);
        // A root is its own parent.
        joint.parent = stack_.empty() ? index : stack_.back().joint;
        hierarchy_.joints.push_back(std::move(joint));
        hierarchy_.channels.emplace_back();
        stack_.push_back({index, false});
        hierarchy_.roots += is_root ? 1 : 0;
        return {};
    }

    /// End Site: only its OFFSET matters, the tip of the joint around it.
    Expected<void> open_end_site(std::string_view& rest, std::size_t line) {
        if (lower(take_word(rest)) != "site") {
            return text_.fault(line, "\"End\" must be \"End Site\"");
        }
        if (stack_.empty() || stack_.back().is_end_site) {
            return text_.fault(line, "an End Site outside a joint");
        }
        is_waiting_for_brace_ = true;
        stack_.push_back({stack_.back().joint, true});
        return {};
    }

    /// OFFSET x y z, of a joint or an end site.
    Expected<void> parse_offset(std::string_view& rest, std::size_t line) {
        if (stack_.empty()) {
            return text_.fault(line, "OFFSET outside a joint");
        }
        glm::dvec3 offset{};
        for (int axis = 0; axis < 3; ++axis) {
            const std::string_view word = take_word(rest);
            if (word.empty() || word == "}" || word == "{") {
                return text_.fault(line, "OFFSET needs three numbers");
            }
            const auto value = text_.number(word, line);
            if (!value) {
                return fail(value.error());
            }
            offset[axis] = *value;
        }
        ClipJoint& joint = hierarchy_.joints[stack_.back().joint];
        if (stack_.back().is_end_site) {
            joint.end_site = offset;
        } else {
            joint.offset = offset;
        }
        return {};
    }

    /// CHANNELS n and n names, in the order in which rows give their values.
    Expected<void> parse_channels(std::string_view& rest, std::size_t line) {
        if (stack_.empty() || stack_.back().is_end_site) {
            return text_.fault(line, "CHANNELS outside a joint");
        }
        std::vector<BvhChannel>& channels = hierarchy_.channels[stack_.back().joint];
        const auto count = text_.number(take_word(rest), line);
        if (!count) {
            return fail(count.error());
        }
        if (!channels.empty() || *count < 0 || *count > 6 || *count != std::floor(*count)) {
            return text_.fault(line, fmt::format("CHANNELS {}: a joint has 0 to 6, once", *count));
        }
        while (!trimmed(rest).empty() && trimmed(rest).front() != '}') {
            const std::string name = lower(take_word(rest));
            const auto known = std::find(kChannelNames.begin(), kChannelNames.end(), name);
            if (known == kChannelNames.end()) {
                return text_.fault(line, "unknown channel \"" + name.substr(0, 40) + "\"");
            }
            channels.push_back(static_cast<BvhChannel>(known - kChannelNames.begin()));
        }
        if (static_cast<double>(channels.size()) != *count) {
            return text_.fault(
                line,
                fmt::format("CHANNELS {} is followed by {} names: the count does not match",
                            *count,
                            channels.size()));
        }
        const std::set<BvhChannel> distinct(channels.begin(), channels.end());
        if (distinct.size() != channels.size()) {
            return text_.fault(line, "a channel is named twice");
        }
        hierarchy_.channel_count += channels.size();
        return {};
    }

    // A joint or end site whose brace is open.
    struct Open {
        std::size_t joint = 0;
        bool is_end_site = false;
    };

    MotionText& text_;
    BvhHierarchy hierarchy_;
    std::vector<Open> stack_;            // from the root down
    bool is_waiting_for_brace_ = false;  // after a joint's name
};

}  // namespace

Expected<BvhHierarchy> read_bvh_hierarchy(MotionText& text) { return HierarchyReader(text).read(); }

}  // namespace raks::motion
