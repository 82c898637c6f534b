#include "apps/raks_capture/capture_steps.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <chrono>
#include <filesystem>
#include <string>
#include <vector>

#include "base/pending_file.hpp"
#include "tests/support/temporary_folder.hpp"

namespace raks::apps {
namespace {

namespace fs = std::filesystem;

/// A capture whose files have times that the test sets: seconds from a moment of long ago.
class CaptureSteps : public ::testing::Test {
 protected:
    CaptureSteps() {
        plan_.folder = folder_.path();
        plan_.cameras = {{"left", {}, {}, 0.0}, {"right", {}, {}, 0.0}};
    }

    void put(const std::string& name, int second) const {
        const fs::path file = plan_.file(name);
        fs::create_directories(file.parent_path());
        ASSERT_TRUE(write_file(file, "x"));
        fs::last_write_time(file, start_ + std::chrono::seconds(second));
    }

    [[nodiscard]] StepState state(const std::string& command) const {
        const auto steps = capture_steps(plan_);
        const auto found = std::find_if(steps.begin(), steps.end(), [&command](const auto& step) {
            std::string words = step.command;
            if (step.arguments == std::vector<std::string>{"--boards"}) {
                words += " --boards";
            }
            return words == command;
        });
        return state_of(*found);
    }

    test::TemporaryFolder folder_;
    CapturePlan plan_;
    fs::file_time_type start_ = fs::file_time_type::clock::now() - std::chrono::hours(24);
};

TEST_F(CaptureSteps, come_in_the_order_in_which_each_reads_what_those_before_it_make) {
    std::string order;
    for (const CaptureStep& step : capture_steps(plan_)) {
        order += step.command + " ";
    }
    EXPECT_EQ(order, "calibrate sync track solve report ");
}

TEST_F(CaptureSteps, without_markers_begin_with_keypoints_and_need_no_board) {
    plan_.is_markerless = true;
    std::string order;
    for (const CaptureStep& step : capture_steps(plan_)) {
        order += step.command + (step.arguments.empty() ? "" : step.arguments.front()) + " ";
    }
    EXPECT_EQ(order, "keypoints sync calibrate--dancer track--method solve report ");
    put("keypoints/left.csv", 1);
    put("keypoints/right.csv", 1);
    EXPECT_EQ(state("keypoints"), StepState::given);
    EXPECT_EQ(state("sync"), StepState::missing);
    put("clocks.toml", 2);
    put("rig.toml", 3);
    EXPECT_EQ(state("calibrate"), StepState::up_to_date);
    put("keypoints/right.csv", 4);
    EXPECT_EQ(state("calibrate"), StepState::outdated);
    EXPECT_EQ(state("sync"), StepState::outdated);
}

TEST_F(CaptureSteps, are_to_be_done_where_their_output_is_missing_or_older_than_an_input) {
    put("capture.toml", 0);
    put("tracks.csv", 1);
    EXPECT_EQ(state("solve"), StepState::missing);
    put("dance.bvh", 1);
    put("body.toml", 2);
    EXPECT_EQ(state("solve"), StepState::up_to_date);
    put("tracks.csv", 2);
    EXPECT_EQ(state("solve"), StepState::outdated);
    put("dance.bvh", 3);
    EXPECT_EQ(state("solve"), StepState::up_to_date);
}

TEST_F(CaptureSteps, follow_edits_and_the_marker_set) {
    plan_.markers = "markers.toml";
    put("detections.csv", 0);
    put("tracks.csv", 1);
    EXPECT_EQ(state("track"), StepState::up_to_date);
    put("markers.toml", 2);
    EXPECT_EQ(state("track"), StepState::outdated);
    put("tracks.csv", 3);
    put("edits.jsonl", 4);
    EXPECT_EQ(state("track"), StepState::outdated);
}

TEST_F(CaptureSteps, leave_a_rig_and_clocks_alone_that_there_is_nothing_to_make_from) {
    EXPECT_EQ(state("calibrate"), StepState::missing);
    put("rig.toml", 0);
    put("clocks.toml", 0);
    put("capture.toml", 1);
    EXPECT_EQ(state("calibrate"), StepState::given);
    EXPECT_EQ(state("sync"), StepState::given);
    plan_.cameras[0].calibration = "left_board.mp4";
    plan_.cameras[1].film = "right.mp4";
    EXPECT_EQ(state("calibrate"), StepState::outdated);
    EXPECT_EQ(state("sync"), StepState::outdated);
}

TEST_F(CaptureSteps, take_the_clocks_of_films_that_show_board_and_dance) {
    for (PlannedCamera& camera : plan_.cameras) {
        camera.film = camera.calibration = camera.name + ".mp4";
    }
    const auto steps = capture_steps(plan_);
    EXPECT_EQ(steps[0].command, "sync");
    EXPECT_EQ(steps[1].command, "calibrate");
    EXPECT_EQ(steps[1].arguments,
              (std::vector<std::string>{"--clocks", plan_.file("clocks.toml").string()}));
    put("rig.toml", 1);
    put("clocks.toml", 2);
    EXPECT_EQ(state("calibrate"), StepState::outdated);
}

TEST_F(CaptureSteps, tell_the_clocks_of_calibration_films_before_they_are_calibrated_with) {
    for (PlannedCamera& camera : plan_.cameras) {
        camera.calibration = camera.name + "_board.mp4";
    }
    const auto steps = capture_steps(plan_);
    EXPECT_EQ(steps[0].command, "sync");
    EXPECT_EQ(steps[1].command, "calibrate");
    EXPECT_EQ(state("sync --boards"), StepState::missing);
    put("rig.toml", 1);
    put("board_clocks.toml", 2);
    EXPECT_EQ(state("calibrate"), StepState::outdated);
    // Folders of pictures have no sound.
    fs::create_directory(plan_.file("left_board.mp4"));
    EXPECT_EQ(capture_steps(plan_)[0].command, "calibrate");
}

TEST_F(CaptureSteps, hear_the_song_beside_the_films) {
    plan_.music = "song.mp3";
    plan_.cameras[0].film = "left.mp4";
    put("clocks.toml", 1);
    put("song.mp3", 2);
    EXPECT_EQ(state("sync"), StepState::outdated);
}

}  // namespace
}  // namespace raks::apps
