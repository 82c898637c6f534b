#include "motion/skeleton/formats/mmd/vpd.hpp"

#include <fmt/format.h>

#include <array>
#include <charconv>
#include <cmath>
#include <optional>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "motion/skeleton/formats/mmd/mmd_clip.hpp"
#include "motion/skeleton/formats/mmd/mmd_morphs.hpp"
#include "motion/skeleton/text_lines.hpp"

#include <glm/geometric.hpp>

namespace raks::motion {
namespace {

constexpr float kLargestVpdNumber = 1e6F;  // units

tl::unexpected<Error> vpd_fault(std::size_t line, std::string_view what) {
    return fail(fmt::format("line {}: {}", line, what));
}

class VpdReader {
 public:
    explicit VpdReader(std::string_view text) : lines_(split_lines(text)) {}

    Expected<MmdMotion> read() {
        if (lines_.empty() || lines_[0].text.substr(0, kVpdMark.size()) != kVpdMark) {
            return fail("is not a pose of MikuMikuDance (VPD)");
        }
        for (at_ = 1; at_ < lines_.size(); ++at_) {
            // "Bone0{name" and "Morph0{name"; all else between blocks says nothing, also where a
            // character of code page 932 has the byte of a brace.
            const std::string_view line = lines_[at_].text;
            const bool is_morph = lower(line.substr(0, 5)) == "morph";
            const std::size_t brace = line.find('{');
            if ((!is_morph && lower(line.substr(0, 4)) != "bone") ||
                brace == std::string_view::npos) {
                continue;
            }
            const std::string_view name = trimmed(line.substr(brace + 1));
            if (auto read = is_morph ? read_morph(name) : read_bone(name); !read) {
                return fail(std::move(read.error()));
            }
        }
        if (foreign_ > 0) {
            motion_.warnings.push_back(
                fmt::format("{} bones and morphs that are none of a body (hair, clothes, helpers) "
                            "are left out",
                            foreign_));
        }
        return std::move(motion_);
    }

 private:
    // The numbers of the next line, up to its semicolon: "0.0,0.0,0.0;  // trans".
    Expected<void> read_numbers(std::span<float> numbers) {
        if (++at_ >= lines_.size()) {
            return vpd_fault(lines_.back().number, "ends within a block: it is cut off");
        }
        const std::size_t number = lines_[at_].number;
        std::string_view line = lines_[at_].text;
        line = line.substr(0, line.find(';'));
        for (float& value : numbers) {
            line = trimmed(line);
            const auto [end, fault] =
                std::from_chars(line.data(), line.data() + line.size(), value);
            if (fault != std::errc() || !(std::abs(value) <= kLargestVpdNumber)) {
                return vpd_fault(number,
                                 fmt::format("has not the {} numbers that belong there, or one "
                                             "that is impossible",
                                             numbers.size()));
            }
            line.remove_prefix(static_cast<std::size_t>(end - line.data()));
            line = trimmed(line);
            if (!line.empty() && line.front() == ',') {
                line.remove_prefix(1);
            }
        }
        return {};
    }

    Expected<void> read_bone(std::string_view name) {
        std::array<float, 3> place{};
        std::array<float, 4> turn{};
        if (auto read = read_numbers(place); !read) {
            return read;
        }
        if (auto read = read_numbers(turn); !read) {
            return read;
        }
        const auto bone = mmd_bone_named(name);
        if (!bone) {
            ++foreign_;
            return {};
        }
        MmdBoneKey key;
        key.place = static_cast<float>(kMmdMetres) * glm::vec3(place[0], place[1], -place[2]);
        const glm::quat given(turn[3], -turn[0], -turn[1], turn[2]);
        if (glm::length(given) > 0.0F) {
            key.turn = glm::normalize(given);
        }
        motion_.bones[index_of(*bone)] = {key};
        return {};
    }

    Expected<void> read_morph(std::string_view name) {
        std::array<float, 1> weight{};
        if (auto read = read_numbers(weight); !read) {
            return read;
        }
        const auto morph = mmd_morph_named(name);
        if (!morph) {
            ++foreign_;
            return {};
        }
        motion_.morphs[*morph] = {{0, weight[0]}};
        return {};
    }

    std::vector<Line> lines_;
    std::size_t at_ = 0;
    MmdMotion motion_;
    std::size_t foreign_ = 0;
};

}  // namespace

Expected<MmdMotion> read_vpd(std::string_view text) { return VpdReader(text).read(); }

Expected<MotionClip> parse_vpd(std::string_view text, std::string_view name, double arm_angle) {
    auto motion = read_vpd(text);
    if (!motion) {
        return fail(std::move(motion.error()).in(std::string(name)));
    }
    auto clip = mmd_clip(*motion, arm_angle);
    if (!clip) {
        return fail(std::move(clip.error()).in(std::string(name)));
    }
    return clip;
}

}  // namespace raks::motion
