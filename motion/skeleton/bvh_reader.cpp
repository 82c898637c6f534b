#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <set>
#include <string>
#include <utility>
#include <vector>

#include "base/file.hpp"
#include "motion/skeleton/bvh.hpp"
#include "motion/skeleton/text_lines.hpp"

#include <fmt/format.h>

namespace raks::motion {
namespace {

constexpr std::size_t kMaxJoints = 1000;
constexpr std::size_t kMaxDepth = 100;
constexpr double kMaxNumber = 1e6;
constexpr double kMaxFrames = 1e7;

/// The six channels of a joint, in the order of their codes: X, Y, Z position, X, Y, Z rotation.
enum class Channel : std::uint8_t {
    x_position,
    y_position,
    z_position,
    x_rotation,
    y_rotation,
    z_rotation
};
constexpr std::array<std::string_view, 6> kChannelNames = {
    "xposition", "yposition", "zposition", "xrotation", "yrotation", "zrotation"};

class Parser {
 public:
    Parser(std::string_view text, std::string_view name, const BvhOptions& options)
        : lines_(split_lines(text)), name_(name), options_(options) {}

    Expected<MotionClip> parse() {
        if (auto done = parse_head(); !done) {
            return fail(done.error());
        }
        if (auto done = parse_hierarchy(); !done) {
            return fail(done.error());
        }
        if (auto done = parse_motion(); !done) {
            return fail(done.error());
        }
        add_warnings();
        return std::move(clip_);
    }

 private:
    [[nodiscard]] tl::unexpected<Error> fault(std::size_t line, const std::string& what) const {
        return fail(fmt::format("{}: line {}: {}", name_, line, what));
    }
    [[nodiscard]] tl::unexpected<Error> fault(const std::string& what) const {
        return fail(fmt::format("{}: {}", name_, what));
    }
    [[nodiscard]] std::size_t last_line() const {
        return lines_.empty() ? 1 : lines_.back().number;
    }

    Expected<void> parse_head() {
        if (lines_.empty()) {
            return fault("is empty");
        }
        if (lines_[0].text.substr(0, 24) == "version https://git-lfs.") {
            return fault(
                "is a Git LFS pointer, not a BVH file; fetch the file itself (git lfs pull)");
        }
        if (lower(lines_[0].text) != "hierarchy") {
            return fault("is not a BVH file: it does not start with HIERARCHY");
        }
        next_ = 1;
        return {};
    }

    Expected<void> parse_hierarchy() {
        for (; next_ < lines_.size(); ++next_) {
            std::string_view rest = lines_[next_].text;
            if (lower(rest) == "motion") {
                return end_hierarchy(lines_[next_].number);
            }
            while (!trimmed(rest).empty()) {
                if (auto done = parse_item(rest, lines_[next_].number); !done) {
                    return done;
                }
            }
        }
        return stack_.empty() && !clip_.joints.empty()
                   ? fault(last_line(), "MOTION is missing")
                   : fault(last_line(), "the file ends inside the HIERARCHY");
    }

    Expected<void> end_hierarchy(std::size_t line) {
        if (!stack_.empty() || is_waiting_for_brace_) {
            return fault(line, "unbalanced braces: a closing brace is missing before MOTION");
        }
        if (clip_.joints.empty()) {
            return fault(line, "ROOT expected before MOTION");
        }
        ++next_;
        return {};
    }

    /// One keyword with what belongs to it, or one brace.
    Expected<void> parse_item(std::string_view& rest, std::size_t line) {
        const std::string word = lower(take_word(rest));
        if (word == "{") {
            if (!is_waiting_for_brace_) {
                return fault(line, "unbalanced braces: an opening brace without a joint");
            }
            is_waiting_for_brace_ = false;
            return {};
        }
        if (is_waiting_for_brace_) {
            return fault(line, "an opening brace is missing after the joint's name");
        }
        if (word == "}") {
            if (stack_.empty()) {
                return fault(line, "unbalanced braces: a closing brace too many");
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
        return fault(line, "unknown keyword \"" + word.substr(0, 40) + "\"");
    }

    Expected<void> open_joint(bool is_root, std::string_view& rest, std::size_t line) {
        if (is_root != stack_.empty()) {
            return fault(line, is_root ? "ROOT inside another joint" : "ROOT expected");
        }
        if (!stack_.empty() && stack_.back().is_end_site) {
            return fault(line, "a JOINT inside an End Site");
        }
        if (clip_.joints.size() >= kMaxJoints || stack_.size() >= kMaxDepth) {
            return fault(line,
                         fmt::format("more than {} joints or {} levels", kMaxJoints, kMaxDepth));
        }
        // The name is the rest of the line: it may hold blanks. A brace may stand behind it.
        std::string_view name = trimmed(rest);
        rest = {};
        if (!name.empty() && name.back() == '{') {
            name = trimmed(name.substr(0, name.size() - 1));
        } else {
            is_waiting_for_brace_ = true;
        }
        const std::size_t index = clip_.joints.size();
        ClipJoint joint;
        joint.name = std::string(name);
        joint.parent = stack_.empty() ? index : stack_.back().joint;
        clip_.joints.push_back(std::move(joint));
        channels_.emplace_back();
        stack_.push_back({index, false});
        roots_ += is_root ? 1 : 0;
        return {};
    }

    Expected<void> open_end_site(std::string_view& rest, std::size_t line) {
        if (lower(take_word(rest)) != "site") {
            return fault(line, "\"End\" must be \"End Site\"");
        }
        if (stack_.empty() || stack_.back().is_end_site) {
            return fault(line, "an End Site outside a joint");
        }
        is_waiting_for_brace_ = true;
        stack_.push_back({stack_.back().joint, true});
        return {};
    }

    Expected<double> number(std::string_view word, std::size_t line) const {
        if (!word.empty() && word.front() == '+') {
            word.remove_prefix(1);
        }
        double value = 0.0;
        const auto result = std::from_chars(word.data(), word.data() + word.size(), value);
        if (result.ec == std::errc::result_out_of_range) {
            return fault(line, fmt::format("\"{}\" is out of range", word.substr(0, 40)));
        }
        if (word.empty() || result.ec != std::errc{} || result.ptr != word.data() + word.size()) {
            const bool is_comma = word.find(',') != std::string_view::npos;
            return fault(line,
                         fmt::format("\"{}\" is no number{}",
                                     word.substr(0, 40),
                                     is_comma ? " (decimal comma? BVH has decimal points)" : ""));
        }
        if (!std::isfinite(value)) {
            return fault(line, fmt::format("\"{}\" is not finite", word));
        }
        if (std::abs(value) > kMaxNumber) {
            return fault(line, fmt::format("{} is out of range (above {:g})", value, kMaxNumber));
        }
        return value;
    }

    Expected<void> parse_offset(std::string_view& rest, std::size_t line) {
        if (stack_.empty()) {
            return fault(line, "OFFSET outside a joint");
        }
        glm::dvec3 offset{};
        for (int axis = 0; axis < 3; ++axis) {
            const std::string_view word = take_word(rest);
            if (word.empty() || word == "}" || word == "{") {
                return fault(line, "OFFSET needs three numbers");
            }
            const auto value = number(word, line);
            if (!value) {
                return fail(value.error());
            }
            offset[axis] = *value;
        }
        ClipJoint& joint = clip_.joints[stack_.back().joint];
        if (stack_.back().is_end_site) {
            joint.end_site = offset;
        } else {
            joint.offset = offset;
        }
        return {};
    }

    Expected<void> parse_channels(std::string_view& rest, std::size_t line) {
        if (stack_.empty() || stack_.back().is_end_site) {
            return fault(line, "CHANNELS outside a joint");
        }
        std::vector<Channel>& channels = channels_[stack_.back().joint];
        const auto count = number(take_word(rest), line);
        if (!count) {
            return fail(count.error());
        }
        if (!channels.empty() || *count < 0 || *count > 6 || *count != std::floor(*count)) {
            return fault(line, fmt::format("CHANNELS {}: a joint has 0 to 6, once", *count));
        }
        while (!trimmed(rest).empty() && trimmed(rest).front() != '}') {
            const std::string name = lower(take_word(rest));
            const auto known = std::find(kChannelNames.begin(), kChannelNames.end(), name);
            if (known == kChannelNames.end()) {
                return fault(line, "unknown channel \"" + name.substr(0, 40) + "\"");
            }
            channels.push_back(static_cast<Channel>(known - kChannelNames.begin()));
        }
        if (static_cast<double>(channels.size()) != *count) {
            return fault(
                line,
                fmt::format("CHANNELS {} is followed by {} names: the count does not match",
                            *count,
                            channels.size()));
        }
        const std::set<Channel> distinct(channels.begin(), channels.end());
        if (distinct.size() != channels.size()) {
            return fault(line, "a channel stands twice");
        }
        channel_count_ += channels.size();
        return {};
    }

    /// "Key words: value" at the next line; the value's text.
    Expected<std::string_view> value_of(std::string_view key) {
        if (next_ >= lines_.size() || lower(lines_[next_].text.substr(0, key.size())) != key) {
            return fault(next_ < lines_.size() ? lines_[next_].number : last_line(),
                         key == "frames" ? "Frames is missing" : "Frame Time is missing");
        }
        std::string_view value = trimmed(lines_[next_++].text.substr(key.size()));
        if (!value.empty() && value.front() == ':') {
            value = trimmed(value.substr(1));
        }
        return value;
    }

    Expected<void> parse_motion() {
        const std::size_t frames_line = next_ < lines_.size() ? lines_[next_].number : last_line();
        const auto frames_text = value_of("frames");
        if (!frames_text) {
            return fail(frames_text.error());
        }
        double frames = 0.0;
        const auto parsed =
            std::from_chars(frames_text->data(), frames_text->data() + frames_text->size(), frames);
        if (parsed.ec != std::errc{} || !(frames >= 0) || frames != std::floor(frames)) {
            return fault(frames_line,
                         fmt::format("Frames: \"{}\" is no count", frames_text->substr(0, 40)));
        }
        if (frames > kMaxFrames) {
            return fault(frames_line,
                         fmt::format("Frames: {} is more than {:g}", frames, kMaxFrames));
        }
        if (auto done = parse_frame_time(); !done) {
            return done;
        }
        return parse_rows(static_cast<std::size_t>(frames));
    }

    Expected<void> parse_frame_time() {
        const std::size_t line = next_ < lines_.size() ? lines_[next_].number : last_line();
        const auto text = value_of("frame time");
        if (!text) {
            return fail(text.error());
        }
        double seconds = 0.0;
        const auto parsed = std::from_chars(text->data(), text->data() + text->size(), seconds);
        const bool is_good =
            parsed.ec == std::errc{} && std::isfinite(seconds) && seconds > 1e-6 && seconds < 100.0;
        if (options_.frames_per_second) {
            clip_.frames_per_second = *options_.frames_per_second;
        } else if (is_good) {
            clip_.frames_per_second = 1.0 / seconds;
        } else {
            return fault(
                line,
                fmt::format("Frame Time: \"{}\" must be > 0 seconds; give the rate with --fps",
                            text->substr(0, 40)));
        }
        return {};
    }

    Expected<void> parse_rows(std::size_t declared) {
        if (channel_count_ == 0) {
            return fault("has no channels");
        }
        std::vector<double> values;
        std::size_t rows = 0;
        std::size_t row_size = 0;
        bool is_even = true;  // all lines hold equally many numbers
        for (; next_ < lines_.size(); ++next_, ++rows) {
            std::string_view rest = lines_[next_].text;
            const std::size_t before = values.size();
            while (!trimmed(rest).empty()) {
                const auto value = number(take_word(rest), lines_[next_].number);
                if (!value) {
                    return fault(fmt::format("frame {}: {}",
                                             values.size() / channel_count_,
                                             value.error().message.substr(name_.size() + 2)));
                }
                values.push_back(*value);
            }
            const std::size_t size = values.size() - before;
            is_even = is_even && (rows == 0 || size == row_size);
            row_size = size;
        }
        if (is_even && rows == declared && rows > 0 && row_size != channel_count_) {
            return fault(
                fmt::format("rows have {} values for {} channels", row_size, channel_count_));
        }
        if (values.size() % channel_count_ != 0) {
            return fault(fmt::format("frame {} has {} of {} values",
                                     values.size() / channel_count_,
                                     values.size() % channel_count_,
                                     channel_count_));
        }
        const std::size_t there = values.size() / channel_count_;
        if (there == 0) {
            return fault(last_line(), "has no frames");
        }
        if (there != declared) {
            clip_.warnings.push_back(
                there > declared ? fmt::format("{} extra rows after the {} declared are left out",
                                               there - declared,
                                               declared)
                                 : fmt::format("declares {} frames and has {}", declared, there));
        }
        clip_.frame_count = std::min(there, std::max<std::size_t>(declared, 1));
        fill_frames(values);
        return {};
    }

    void fill_frames(const std::vector<double>& values) {
        std::size_t next = 0;
        for (std::size_t frame = 0; frame < clip_.frame_count; ++frame) {
            for (std::size_t joint = 0; joint < clip_.joints.size(); ++joint) {
                glm::dvec3 position = clip_.joints[joint].offset;
                glm::dquat rotation(1.0, 0.0, 0.0, 0.0);
                for (const Channel channel : channels_[joint]) {
                    const double value = values[next++];
                    const int code = static_cast<int>(channel);
                    if (code < 3) {
                        position[code] = value;
                        continue;
                    }
                    glm::dvec3 axis(0.0);
                    axis[code - 3] = 1.0;
                    rotation = rotation * glm::angleAxis(glm::radians(value), axis);
                }
                clip_.rotations.push_back(rotation);
                clip_.positions.push_back(position);
            }
        }
    }

    void add_warnings() {
        if (roots_ > 1) {
            clip_.warnings.push_back(fmt::format("has {} roots; all are read", roots_));
        }
        std::set<std::string> names;
        for (const ClipJoint& joint : clip_.joints) {
            if (!names.insert(joint.name).second) {
                clip_.warnings.push_back("the name \"" + joint.name + "\" is used twice");
            }
        }
    }

    struct Open {
        std::size_t joint = 0;
        bool is_end_site = false;
    };

    std::vector<Line> lines_;
    std::string name_;
    BvhOptions options_;
    std::size_t next_ = 0;
    MotionClip clip_;
    std::vector<std::vector<Channel>> channels_;  // by joint
    std::size_t channel_count_ = 0;
    std::vector<Open> stack_;
    bool is_waiting_for_brace_ = false;
    int roots_ = 0;
};

}  // namespace

Expected<MotionClip> parse_bvh(std::string_view text,
                               std::string_view name,
                               const BvhOptions& options) {
    constexpr std::string_view kByteOrderMark = "\xEF\xBB\xBF";
    if (text.substr(0, 3) == kByteOrderMark) {
        text.remove_prefix(3);
    }
    return Parser(text, name, options).parse();
}

Expected<MotionClip> read_bvh(const std::filesystem::path& path, const BvhOptions& options) {
    const auto text = read_file(path);
    if (!text) {
        return fail(text.error());
    }
    return parse_bvh(*text, path.string(), options);
}

}  // namespace raks::motion
