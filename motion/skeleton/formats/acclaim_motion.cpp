#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <string>
#include <utility>

#include "base/file.hpp"
#include "base/printable.hpp"
#include "motion/skeleton/formats/acclaim.hpp"
#include "motion/skeleton/formats/motion_limits.hpp"
#include "motion/skeleton/formats/motion_text.hpp"

#include <glm/trigonometric.hpp>

namespace raks::motion {
namespace {

namespace fs = std::filesystem;

constexpr double kUsualRate = 120.0;  // of CMU's captures; some, as the salsa's, have 60

class AmcReader {
 public:
    AmcReader(std::string_view text, std::string_view name, const AcclaimSkeleton& skeleton)
        : text_(text, name), skeleton_(skeleton) {
        clip_.joints = skeleton.joints;
        clip_.metres_per_unit = skeleton.metres_per_unit;
        for (std::size_t joint = 0; joint < clip_.joints.size(); ++joint) {
            index_[clip_.joints[joint].name] = joint;
        }
    }

    Expected<MotionClip> read(std::optional<double> frames_per_second) {
        for (; !text_.is_at_end(); text_.advance()) {
            if (auto done = parse_line(); !done) {
                return fail(std::move(done.error()));
            }
        }
        if (auto done = end_frame(); !done) {
            return fail(std::move(done.error()));
        }
        if (clip_.frame_count == 0) {
            return text_.fault("has no frames");
        }
        clip_.frames_per_second = frames_per_second.value_or(kUsualRate);
        if (!frames_per_second) {
            clip_.warnings.push_back(fmt::format(
                "says no frame rate: {:g} a second are taken (--fps sets it)", kUsualRate));
        }
        return std::move(clip_);
    }

 private:
    Expected<void> parse_line() {
        const auto& [line, number] = text_.line();
        if (line.front() == '#') {
            return {};
        }
        if (line.front() == ':') {
            is_radians_ = is_radians_ || lower(line).substr(0, 8) == ":radians";
            return {};
        }
        std::string_view rest = line;
        const std::string_view word = take_word(rest);
        if (trimmed(rest).empty() && word.find_first_not_of("0123456789") == std::string::npos) {
            return begin_frame();
        }
        if (!is_open_) {
            return text_.fault(number, "a frame's number is expected");
        }
        return parse_joint(word, rest);
    }

    Expected<void> begin_frame() {
        if (auto done = end_frame(); !done) {
            return done;
        }
        if (clip_.frame_count >= kMostJointFrames / clip_.joints.size()) {
            return text_.fault(text_.line_number(), "has too many frames");
        }
        is_open_ = true;
        ++clip_.frame_count;
        has_numbers_.assign(clip_.joints.size(), false);
        for (const ClipJoint& joint : clip_.joints) {
            clip_.rotations.emplace_back(1.0, 0.0, 0.0, 0.0);
            clip_.positions.push_back(joint.offset);
        }
        return {};
    }

    // Every bone that can move must have moved.
    Expected<void> end_frame() {
        for (std::size_t joint = 0; is_open_ && joint < clip_.joints.size(); ++joint) {
            if (!has_numbers_[joint] && !skeleton_.freedoms[joint].empty()) {
                return text_.fault(text_.line_number(),
                                   fmt::format("frame {} has no numbers for the bone \"{}\"",
                                               clip_.frame_count,
                                               printable(clip_.joints[joint].name, 40)));
            }
        }
        return {};
    }

    Expected<void> parse_joint(std::string_view name, std::string_view rest) {
        const std::size_t line = text_.line_number();
        const auto found = index_.find(std::string(name));
        if (found == index_.end()) {
            return text_.fault(line,
                               fmt::format("the skeleton has no bone \"{}\": is it another's .asf? "
                                           "(--skeleton names it)",
                                           printable(name, 40)));
        }
        const std::size_t joint = found->second;
        const std::vector<AcclaimFreedom>& freedoms = skeleton_.freedoms[joint];
        glm::dquat turn(1.0, 0.0, 0.0, 0.0);
        glm::dvec3 way(0.0);
        for (const AcclaimFreedom freedom : freedoms) {
            const auto value = text_.number(take_word(rest), line);
            if (!value) {
                return fail(value.error());
            }
            const int code = static_cast<int>(freedom);
            if (code < 3) {
                way[code] = *value;
            } else if (freedom != AcclaimFreedom::length) {
                glm::dvec3 axis(0.0);
                axis[code - 3] = 1.0;
                turn = glm::angleAxis(is_radians_ ? *value : glm::radians(*value), axis) * turn;
            }
        }
        if (!trimmed(rest).empty()) {
            return text_.fault(line,
                               fmt::format("the bone \"{}\" has more than its {} numbers",
                                           printable(name, 40),
                                           freedoms.size()));
        }
        // The turn is about the bone's own axes, which are turned against the world's at rest.
        const glm::dquat& axes = skeleton_.axes[joint];
        const std::size_t at = (clip_.frame_count - 1) * clip_.joints.size() + joint;
        clip_.rotations[at] = axes * turn * glm::inverse(axes);
        clip_.positions[at] += joint == 0 ? way : axes * way;
        has_numbers_[joint] = true;
        return {};
    }

    MotionText text_;
    const AcclaimSkeleton& skeleton_;
    std::map<std::string, std::size_t> index_;  // joint by name
    MotionClip clip_;
    bool is_radians_ = false;
    bool is_open_ = false;  // a frame has begun
    std::vector<bool> has_numbers_;
};

// The file's name that the first line of an .amc says: "#!OML:ASF F:\VICON\rory3.ASF".
std::string said_name(std::string_view text) {
    constexpr std::string_view kMark = "#!OML:ASF";
    const std::string_view line = trimmed(text.substr(0, text.find_first_of("\r\n")));
    if (line.substr(0, kMark.size()) != kMark) {
        return {};
    }
    const std::size_t slash = line.find_last_of("\\/ ");
    return lower(line.substr(slash == std::string_view::npos ? 0 : slash + 1));
}

}  // namespace

Expected<MotionClip> parse_amc(std::string_view text,
                               std::string_view name,
                               const AcclaimSkeleton& skeleton,
                               std::optional<double> frames_per_second) {
    return AmcReader(text, name, skeleton).read(frames_per_second);
}

Expected<fs::path> find_asf(const fs::path& amc, std::string_view text) {
    const fs::path folder = amc.has_parent_path() ? amc.parent_path() : fs::path(".");
    const auto listed = list_folder(folder);
    std::vector<fs::path> skeletons;
    for (const fs::path& path : listed ? *listed : std::vector<fs::path>()) {
        if (lower(path.extension().string()) == ".asf") {
            skeletons.push_back(path);
        }
    }
    const std::string stem = lower(amc.stem().string());
    for (const std::string& wanted :
         {stem + ".asf", stem.substr(0, stem.rfind('_')) + ".asf", said_name(text)}) {
        for (const fs::path& path : skeletons) {
            if (lower(path.filename().string()) == wanted) {
                return path;
            }
        }
    }
    if (skeletons.size() == 1) {
        return skeletons[0];
    }
    return fail(
        fmt::format("{}: needs its skeleton, an .asf; {} lie beside it: name it with "
                    "--skeleton X.asf",
                    amc.string(),
                    skeletons.empty() ? "none" : std::to_string(skeletons.size())));
}

}  // namespace raks::motion
