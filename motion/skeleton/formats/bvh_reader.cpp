#include <algorithm>
#include <charconv>
#include <cmath>
#include <map>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "base/file.hpp"
#include "motion/skeleton/formats/bvh.hpp"
#include "motion/skeleton/formats/bvh_hierarchy.hpp"
#include "motion/skeleton/formats/frame_rate.hpp"
#include "motion/skeleton/formats/motion_limits.hpp"

#include <fmt/format.h>

namespace raks::motion {
namespace {

/// Reads what follows MOTION into a clip whose joints are known.
class MotionReader {
 public:
    MotionReader(MotionText& text,
                 BvhHierarchy hierarchy,
                 std::string_view name,
                 const BvhOptions& options)
        : text_(text), hierarchy_(std::move(hierarchy)), name_(name), options_(options) {
        clip_.joints = hierarchy_.joints;
    }

    Expected<MotionClip> read() {
        if (auto done = parse_motion(); !done) {
            return fail(std::move(done.error()));
        }
        add_warnings();
        return std::move(clip_);
    }

 private:
    /// Frames, Frame Time, then the rows.
    Expected<void> parse_motion() {
        const std::size_t frames_line = text_.line_number();
        const auto frames_text = text_.value_of("frames");
        if (!frames_text) {
            return fail(frames_text.error());
        }
        double frames = 0.0;
        const auto parsed =
            std::from_chars(frames_text->data(), frames_text->data() + frames_text->size(), frames);
        if (parsed.ec != std::errc{} || !(frames >= 0) || frames != std::floor(frames)) {
            return text_.fault(
                frames_line,
                fmt::format("Frames: \"{}\" is not a count", frames_text->substr(0, 40)));
        }
        if (frames > kMostDeclaredFrames) {
            return text_.fault(
                frames_line,
                fmt::format("Frames: {} is more than {:g}", frames, kMostDeclaredFrames));
        }
        if (auto done = parse_frame_time(); !done) {
            return done;
        }
        return parse_rows(static_cast<std::size_t>(frames));
    }

    /// Seconds a frame; a given rate overrides whatever is there.
    Expected<void> parse_frame_time() {
        const std::size_t line = text_.line_number();
        const auto text = text_.value_of("frame time");
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
            const WrittenRate written = rate_of_frame_time(
                text->substr(0, static_cast<std::size_t>(parsed.ptr - text->data())), seconds);
            clip_.frames_per_second = written.frames_per_second;
            if (!written.warning.empty()) {
                clip_.warnings.push_back(written.warning);
            }
        } else {
            return text_.fault(
                line,
                fmt::format("Frame Time: \"{}\" must be > 0 seconds; give the rate with --fps",
                            text->substr(0, 40)));
        }
        return {};
    }

    /// All numbers in one list, since rows may be wrapped; line breaks serve only for better
    /// messages.
    Expected<void> parse_rows(std::size_t declared) {
        if (hierarchy_.channel_count == 0) {
            return text_.fault("has no channels");
        }
        std::vector<double> values;
        std::size_t rows = 0;
        std::size_t row_size = 0;
        bool is_even = true;  // all lines hold equally many numbers
        for (; !text_.is_at_end(); text_.advance(), ++rows) {
            std::string_view rest = text_.line().text;
            const std::size_t before = values.size();
            while (!trimmed(rest).empty()) {
                const auto value = text_.number(take_word(rest), text_.line_number());
                if (!value) {
                    // Replaces the file's name in the message, which fault() adds again.
                    return text_.fault(fmt::format("frame {}: {}",
                                                   values.size() / hierarchy_.channel_count,
                                                   value.error().message.substr(name_.size() + 2)));
                }
                values.push_back(*value);
            }
            const std::size_t size = values.size() - before;
            is_even = is_even && (rows == 0 || size == row_size);
            row_size = size;
        }
        // One line a frame, but of the wrong length: better said once than for frame 0.
        if (is_even && rows == declared && rows > 0 && row_size != hierarchy_.channel_count) {
            return text_.fault(fmt::format(
                "rows have {} values for {} channels", row_size, hierarchy_.channel_count));
        }
        if (values.size() % hierarchy_.channel_count != 0) {
            return text_.fault(fmt::format("frame {} has {} of {} values",
                                           values.size() / hierarchy_.channel_count,
                                           values.size() % hierarchy_.channel_count,
                                           hierarchy_.channel_count));
        }
        const std::size_t there = values.size() / hierarchy_.channel_count;
        if (there == 0) {
            return text_.fault(text_.line_number(), "has no frames");
        }
        if (there != declared) {
            clip_.warnings.push_back(
                there > declared ? fmt::format("{} extra rows after the {} declared are left out",
                                               there - declared,
                                               declared)
                                 : fmt::format("declares {} frames and has {}", declared, there));
        }
        // Never more than declared, but at least one frame of what is there.
        clip_.frame_count = std::min(there, std::max<std::size_t>(declared, 1));
        fill_frames(values);
        return {};
    }

    /// Values to local rotations and positions, in the order of each joint's channels.
    void fill_frames(const std::vector<double>& values) {
        std::size_t next = 0;
        for (std::size_t frame = 0; frame < clip_.frame_count; ++frame) {
            for (std::size_t joint = 0; joint < clip_.joints.size(); ++joint) {
                glm::dvec3 position = clip_.joints[joint].offset;
                glm::dquat rotation(1.0, 0.0, 0.0, 0.0);
                for (const BvhChannel channel : hierarchy_.channels[joint]) {
                    const double value = values[next++];
                    const int code = static_cast<int>(channel);
                    if (code < 3) {
                        position[code] = value;
                        continue;
                    }
                    glm::dvec3 axis(0.0);
                    axis[code - 3] = 1.0;
                    // Rotations multiply in the order of the channels: for "Z X Y" it is Rz Rx Ry.
                    rotation = rotation * glm::angleAxis(glm::radians(value), axis);
                }
                clip_.rotations.push_back(rotation);
                clip_.positions.push_back(position);
            }
        }
    }

    void add_warnings() {
        if (hierarchy_.roots > 1) {
            clip_.warnings.push_back(fmt::format("has {} roots; all are read", hierarchy_.roots));
        }
        std::map<std::string_view, int> uses;
        std::vector<std::string_view> repeated;
        for (const ClipJoint& joint : clip_.joints) {
            if (++uses[joint.name] == 2) {
                repeated.push_back(joint.name);
            }
        }
        if (repeated.size() == 1) {
            clip_.warnings.push_back(
                fmt::format("the name \"{}\" is used twice", repeated.front()));
        } else if (!repeated.empty()) {
            clip_.warnings.push_back(fmt::format(
                "{} names are used twice: \"{}\" and others", repeated.size(), repeated.front()));
        }
    }

    MotionText& text_;
    BvhHierarchy hierarchy_;
    std::string_view name_;
    BvhOptions options_;
    MotionClip clip_;
};

}  // namespace

Expected<MotionClip> parse_bvh(std::string_view text,
                               std::string_view name,
                               const BvhOptions& options) {
    // Editors on Windows put it before UTF-8.
    constexpr std::string_view kByteOrderMark = "\xEF\xBB\xBF";
    if (text.substr(0, 3) == kByteOrderMark) {
        text.remove_prefix(3);
    }
    MotionText lines(text, name);
    auto hierarchy = read_bvh_hierarchy(lines);
    if (!hierarchy) {
        return fail(std::move(hierarchy.error()));
    }
    return MotionReader(lines, std::move(*hierarchy), name, options).read();
}

Expected<MotionClip> read_bvh(const std::filesystem::path& path, const BvhOptions& options) {
    const auto text = read_file(path);
    if (!text) {
        return fail(text.error());
    }
    return parse_bvh(*text, path.string(), options);
}

}  // namespace raks::motion
