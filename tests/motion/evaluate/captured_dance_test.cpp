// People's clips: the plain cut of one take, with labels of its own; skipped where it is not.
#include "motion/evaluate/captured_dance.hpp"

#include <gtest/gtest.h>

#include <filesystem>
#include <string>

#include "base/file.hpp"
#include "base/pending_file.hpp"
#include "tests/support/shared_data.hpp"
#include "tests/support/temporary_folder.hpp"

namespace raks::motion {
namespace {

namespace fs = std::filesystem;

class CapturedClips : public ::testing::Test {
 protected:
    void SetUp() override { clips_ = raks::test::shared_data() / "mocap" / "salsa"; }

    [[nodiscard]] CapturedDancePlan plan(const std::string& labels) const {
        const std::string heads = "take\trole\tstart\tend\tfigure\tbeats\tconfidence\n";
        EXPECT_TRUE(write_file(folder_ / "labels.tsv", heads + labels));
        CapturedDancePlan plan;
        plan.folder = clips_;
        plan.labels = folder_ / "labels.tsv";
        plan.reading.frames_per_second = 60.0;
        plan.metres_per_unit = 1.267;
        return plan;
    }

    fs::path clips_;
    raks::test::TemporaryFolder folder_;
};

constexpr const char* kTwoBasics =
    "60_03_973_1679\tlead\t0\t100\tidle\t8\t1\n"
    "60_03_973_1679\tlead\t178\t355\tbasic\t8\t0.95\n"
    "60_03_973_1679\tlead\t355\t532\tbasic\t8\t0.95\n"
    "60_03_973_1679\tlead\t532\t700\tbasic\t8\t0.3\n"
    "61_03_973_1679\tfollow\t178\t355\tbasic\t8\t0.95\n";

TEST_F(CapturedClips, is_measured_between_its_first_and_last_figure) {
    if (!fs::exists(clips_ / "60_03_973_1679.bvh")) {
        GTEST_SKIP() << "no clip in " << clips_;
    }
    const auto dances = measure_captured(plan(kTwoBasics), {});
    ASSERT_TRUE(dances) << dances.error().message;
    ASSERT_EQ(dances->size(), 1U) << "the follow's take is not the lead's";
    const DanceMeasures& measures = dances->front().measures;
    ASSERT_EQ(measures.figures.size(), 1U);
    EXPECT_EQ(measures.figures[0].amplitudes.size(), 2U) << "the doubtful one is no repeat";
    // 19 joints, third differences from frame 178 + 2 to 700 - 6.
    EXPECT_EQ(measures.jerk.samples.size(), 19U * (700U - 178U - 7U));
    EXPECT_NEAR(measures.figures[0].amplitudes[0].hips_travel, 0.6, 0.2);
    EXPECT_NEAR(
        rms_distance(measures.figures[0].shapes[0], measures.figures[0].shapes[1]), 0.08, 0.05);
}

TEST_F(CapturedClips, leaves_faults_out) {
    if (!fs::exists(clips_ / "60_03_973_1679.bvh")) {
        GTEST_SKIP() << "no clip in " << clips_;
    }
    CapturedDancePlan with_faults = plan(kTwoBasics);
    ASSERT_TRUE(write_file(folder_ / "faults.tsv",
                           "take\tfrom\tto\tjoints\n"
                           "60_03_973_1679\t200\t203\tlFoot\n"
                           "60_03_973_1679\t0\t705\thead,lHand\n"));
    with_faults.faults = folder_ / "faults.tsv";
    const auto dances = measure_captured(with_faults, {});
    ASSERT_TRUE(dances) << dances.error().message;
    const DanceMeasures& measures = dances->front().measures;
    EXPECT_EQ(measures.figures[0].amplitudes.size(), 1U);
    // 4 faulty frames and the 7 before from which a difference would see them.
    EXPECT_EQ(measures.jerk.samples.size(), 19U * (700U - 178U - 7U - 11U));
    ASSERT_TRUE(write_file(folder_ / "faults.tsv",
                           "take\tfrom\tto\tjoints\n60_03_973_1679\t0\t705\thip,abdomen\n"));
    EXPECT_FALSE(measure_captured(with_faults, {})) << "all fault";
}

TEST_F(CapturedClips, says_what_is_missing) {
    CapturedDancePlan follow = plan("60_03\tlead\t178\t355\tbasic\t8\t0.95\n");
    follow.role = DanceRole::follow;
    const auto no_role = measure_captured(follow, {});
    ASSERT_FALSE(no_role);
    EXPECT_EQ(no_role.error().message, follow.labels.string() + ": has no labels of the follow");
    CapturedDancePlan no_clip = plan("no_such_take\tlead\t178\t355\tbasic\t8\t0.95\n");
    const auto missing = measure_captured(no_clip, {});
    ASSERT_FALSE(missing);
    EXPECT_NE(missing.error().message.find("no_such_take.bvh"), std::string::npos);
}

}  // namespace
}  // namespace raks::motion
