// Every file of the table of odd and bad BVH files, and what it says must happen to each; skipped
// where the table is not.
#include <gtest/gtest.h>

#include <cmath>
#include <filesystem>
#include <string>
#include <vector>

#include "base/file.hpp"
#include "motion/skeleton/formats/bvh.hpp"
#include "motion/skeleton/text_lines.hpp"
#include "tests/support/shared_data.hpp"

#include <glm/gtc/quaternion.hpp>

namespace raks::motion {
namespace {

namespace fs = std::filesystem;

struct Case {
    std::string file;
    std::string expected;  // "read" or "refuse"
    std::string detail;
};

std::vector<Case> cases_of(const std::string& table) {
    std::vector<Case> cases;
    for (const Line& line : split_lines(table)) {
        std::vector<std::string> cells(1);
        for (const char c : line.text) {
            if (c == '\t') {
                cells.emplace_back();
            } else {
                cells.back() += c;
            }
        }
        if (line.number > 1 && cells.size() >= 4) {
            cases.push_back({cells[0], cells[2], cells[3]});
        }
    }
    return cases;
}

class OddAndBad : public ::testing::Test {
 protected:
    void SetUp() override {
        folder_ = raks::test::shared_data() / "mocap";
        const auto table = read_file(folder_ / "odd_bad.tsv");
        if (!table) {
            GTEST_SKIP() << "no table in " << folder_;
        }
        cases_ = cases_of(*table);
        ASSERT_GE(cases_.size(), 50U);
    }
    [[nodiscard]] MotionClip clip(const std::string& name) const {
        const auto clip = read_bvh(folder_ / "odd" / name);
        EXPECT_TRUE(clip) << clip.error().message;
        return clip ? *clip : MotionClip{};
    }

    fs::path folder_;
    std::vector<Case> cases_;
};

/// Degrees between the root's rotations of a frame and the next.
double turn_after(const MotionClip& clip, std::size_t frame) {
    const glm::dquat way = glm::inverse(clip.rotation(frame, 0)) * clip.rotation(frame + 1, 0);
    return glm::degrees(2.0 * std::acos(std::min(1.0, std::abs(way.w))));
}

TEST_F(OddAndBad, files_are_read_or_refused_as_the_table_says) {
    for (const Case& each : cases_) {
        const auto clip = read_bvh(folder_ / each.file);
        EXPECT_EQ(clip.has_value(), each.expected == "read")
            << each.file << ": " << each.detail << (clip ? "" : ": " + clip.error().message);
        if (!clip) {
            EXPECT_EQ(clip.error().message.find('\n'), std::string::npos) << each.file;
            EXPECT_NE(clip.error().message.find(each.file), std::string::npos)
                << clip.error().message;
        }
    }
}

TEST_F(OddAndBad, variations_of_the_plain_file_are_the_same_motion) {
    const MotionClip plain = clip("plain.bvh");
    int compared = 0;
    for (const Case& each : cases_) {
        if (each.detail.rfind("same motion as plain.bvh", 0) != 0) {
            continue;
        }
        ++compared;
        const MotionClip other = clip(fs::path(each.file).filename().string());
        ASSERT_EQ(other.frame_count, plain.frame_count) << each.file;
        for (std::size_t frame = 0; frame < plain.frame_count; ++frame) {
            const auto places = world_pose(plain, frame).positions;
            const auto others = world_pose(other, frame).positions;
            for (std::size_t joint = 0; joint < places.size(); ++joint) {
                ASSERT_LT(glm::length(places[joint] - others[joint]), 1e-3) << each.file;
            }
        }
    }
    EXPECT_GE(compared, 12);
}

TEST_F(OddAndBad, a_root_near_gimbal_lock_hardly_turns) {
    const MotionClip root = clip("gimbal_root.bvh");
    for (std::size_t frame = 0; frame + 1 < root.frame_count; ++frame) {
        ASSERT_LT(turn_after(root, frame), 3.0) << frame;
    }
}

TEST_F(OddAndBad, a_turn_goes_on_where_its_angle_wraps) {
    const MotionClip turning = clip("euler_wrap.bvh");
    const auto heading = [&](std::size_t frame) {
        const glm::dvec3 ahead = turning.rotation(frame, 0) * glm::dvec3(0.0, 0.0, 1.0);
        return std::atan2(ahead.x, ahead.z);
    };
    double turned = 0.0;
    for (std::size_t frame = 0; frame + 1 < turning.frame_count; ++frame) {
        const double step = std::remainder(heading(frame + 1) - heading(frame), 2.0 * M_PI);
        EXPECT_LT(std::abs(glm::degrees(step)), 60.0) << frame;
        turned += step;
    }
    EXPECT_NEAR(glm::degrees(turned), 440.0, 10.0) << "it tilts a little as well";
}

}  // namespace
}  // namespace raks::motion
