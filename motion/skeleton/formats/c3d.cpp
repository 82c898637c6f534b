#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <set>
#include <string>
#include <utility>

#include "motion/skeleton/formats/c3d_parameters.hpp"
#include "motion/skeleton/formats/motion_limits.hpp"
#include "motion/skeleton/formats/points.hpp"
#include "motion/skeleton/text_lines.hpp"

namespace raks::motion {
namespace {

constexpr double kFullCount = 65535;  // what a frame number of 16 bits says at most

class C3dReader {
 public:
    C3dReader(const C3dBytes& bytes, std::optional<double> rate)
        : bytes_(bytes), parameters_(c3d_parameters(bytes)), rate_(rate) {}

    Expected<PointClip> read() {
        if (auto done = read_layout(); !done) {
            return fail(std::move(done.error()));
        }
        read_names();
        read_facts();
        read_frames();
        if (auto done = check_points(clip_); !done) {
            return fail(std::move(done.error()));
        }
        return std::move(clip_);
    }

 private:
    std::optional<double> number(const std::string& name, std::size_t index = 0) const {
        const auto found = parameters_.find(name);
        if (found == parameters_.end() || found->second.numbers.size() <= index) {
            return std::nullopt;
        }
        // Beyond that, or not finite, a parameter is damaged: as if it were not there.
        constexpr double kLargest = 1e9;
        const double value = found->second.numbers[index];
        return std::abs(value) <= kLargest ? std::optional(value) : std::nullopt;
    }
    std::string word(const std::string& name) const {
        const auto found = parameters_.find(name);
        return found == parameters_.end() || found->second.words.empty() ? ""
                                                                         : found->second.words[0];
    }

    // Where the numbers lie and how many there are: the head's word where parameters lack.
    Expected<void> read_layout() {
        points_ =
            static_cast<std::size_t>(std::max(0.0, number("POINT:USED").value_or(bytes_.word(2))));
        if (points_ == 0) {
            return fail("holds no points, only other channels");
        }
        if (points_ > kMostJoints) {
            return fail(fmt::format("holds {} points; at most {}", points_, kMostJoints));
        }
        scale_ = number("POINT:SCALE").value_or(bytes_.number(12));
        is_float_ = scale_ < 0.0;
        if (!is_float_ && !(scale_ > 0.0 && std::isfinite(scale_))) {
            return fail(fmt::format("its scale is {}, which is impossible", scale_));
        }
        number_size_ = is_float_ ? 4 : 2;
        const std::size_t analogue = bytes_.word(4);
        frame_size_ = number_size_ * (4 * points_ + analogue);
        const double block = number("POINT:DATA_START").value_or(0.0) > 1.0
                                 ? *number("POINT:DATA_START")
                                 : static_cast<double>(bytes_.word(16));
        if (!(block >= 2.0)) {
            return fail("does not say where its points begin");
        }
        data_ = (static_cast<std::size_t>(block) - 1) * kC3dBlock;
        const std::size_t there = data_ < bytes_.size() ? (bytes_.size() - data_) / frame_size_ : 0;
        const double declared = declared_frames();
        clip_.frame_count =
            static_cast<std::size_t>(std::min(declared, static_cast<double>(there)));
        if (clip_.frame_count == 0) {
            return fail("has no frames: it is cut off");
        }
        if (static_cast<double>(there) < declared) {
            clip_.warnings.push_back(fmt::format(
                "{:g} frames are declared, {} are there: it is cut off", declared, there));
        }
        return {};
    }

    // The head has 16 bits for the last frame's number; longer takes have it elsewhere.
    double declared_frames() const {
        const double first = bytes_.word(6);
        const double last = bytes_.word(8);
        const auto start = number("TRIAL:ACTUAL_START_FIELD");
        const auto end = number("TRIAL:ACTUAL_END_FIELD");
        if (last >= kFullCount && start && end) {
            const double from =
                *start + 65536.0 * number("TRIAL:ACTUAL_START_FIELD", 1).value_or(0);
            const double to = *end + 65536.0 * number("TRIAL:ACTUAL_END_FIELD", 1).value_or(0);
            return std::max(0.0, to - from + 1.0);
        }
        if (last >= kFullCount && number("POINT:FRAMES")) {
            return std::max(last - first + 1.0, *number("POINT:FRAMES"));
        }
        return std::max(0.0, last - first + 1.0);
    }

    // LABELS holds 255 names at most; LABELS2 and so on go on.
    void read_names() {
        for (int part = 1; part < 16; ++part) {
            const auto found =
                parameters_.find(part == 1 ? "POINT:LABELS" : fmt::format("POINT:LABELS{}", part));
            if (found != parameters_.end()) {
                const std::vector<std::string>& words = found->second.words;
                labels_.insert(labels_.end(), words.begin(), words.end());
            }
        }
        labels_.resize(points_);
        std::set<std::string> others;
        for (const char* kind : {"ANGLES", "FORCES", "MOMENTS", "POWERS", "SCALARS"}) {
            const auto found = parameters_.find(std::string("POINT:") + kind);
            if (found != parameters_.end()) {
                others.insert(found->second.words.begin(), found->second.words.end());
            }
        }
        others.erase("");
        for (std::size_t point = 0; point < points_; ++point) {
            if (others.contains(labels_[point])) {
                continue;
            }
            places_.push_back(point);
            clip_.names.push_back(labels_[point].empty() ? fmt::format("point {}", point + 1)
                                                         : labels_[point]);
        }
        if (places_.size() < points_) {
            clip_.warnings.push_back(
                fmt::format("{} of its points are angles, forces or the like and left out",
                            points_ - places_.size()));
        }
    }

    void read_facts() {
        const double head_rate = bytes_.number(20);
        clip_.frames_per_second = rate_.value_or(number("POINT:RATE").value_or(head_rate));
        clip_.metres_per_unit = metres_of_unit(word("POINT:UNITS"));
        // Which of the world's axes points up on the screen, such as "+Z"; "-Z" looks from below.
        const std::string up = lower(word("POINT:Y_SCREEN"));
        if (up.size() == 2 && up[0] == '+' && up[1] >= 'x' && up[1] <= 'z') {
            glm::dvec3 axis(0.0);
            axis[up[1] - 'x'] = 1.0;
            clip_.up = axis;
        }
    }

    void read_frames() {
        clip_.positions.reserve(clip_.frame_count * places_.size());
        for (std::size_t frame = 0; frame < clip_.frame_count; ++frame) {
            for (const std::size_t point : places_) {
                clip_.positions.push_back(
                    place_at(data_ + frame * frame_size_ + 4 * number_size_ * point));
            }
        }
    }

    glm::dvec3 place_at(std::size_t at) const {
        constexpr double kUnseen = std::numeric_limits<double>::quiet_NaN();
        glm::dvec3 place(0.0);
        if (is_float_) {
            for (int axis = 0; axis < 3; ++axis) {
                place[axis] = bytes_.number(at + 4 * static_cast<std::size_t>(axis));
            }
            return bytes_.number(at + 12) < 0.0 ? glm::dvec3(kUnseen) : place;
        }
        for (int axis = 0; axis < 3; ++axis) {
            place[axis] = scale_ * static_cast<std::int16_t>(
                                       bytes_.word(at + 2 * static_cast<std::size_t>(axis)));
        }
        // The upper half says which cameras saw it; its sign, that none did.
        return static_cast<std::int16_t>(bytes_.word(at + 6)) < 0 ? glm::dvec3(kUnseen) : place;
    }

    const C3dBytes& bytes_;
    C3dParameters parameters_;
    std::optional<double> rate_;
    PointClip clip_;
    std::size_t points_ = 0;           // in the file
    std::vector<std::size_t> places_;  // those of them that are places
    std::vector<std::string> labels_;
    double scale_ = 1.0;
    bool is_float_ = false;
    std::size_t number_size_ = 4;
    std::size_t frame_size_ = 0;
    std::size_t data_ = 0;  // where the first frame begins
};

}  // namespace

Expected<PointClip> parse_c3d(std::string_view bytes,
                              std::string_view name,
                              std::optional<double> frames_per_second) {
    const auto processor = c3d_processor(bytes);
    if (!processor) {
        return fail(Error(processor.error()).in(std::string(name)));
    }
    const C3dBytes content(bytes, *processor);
    auto clip = C3dReader(content, frames_per_second).read();
    if (!clip) {
        return fail(std::move(clip.error()).in(std::string(name)));
    }
    return clip;
}

}  // namespace raks::motion
