// Calibration films that are drawn of a known rig: it comes back from them, by their own sound.
#include "apps/raks_capture/drawn_boards.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <cstdio>
#include <filesystem>
#include <string>
#include <vector>

#include "apps/raks_capture/carried_board.hpp"
#include "apps/raks_capture/filmed_boards.hpp"
#include "apps/raks_capture/synchronise.hpp"
#include "motion/capture/studio/point_studio.hpp"
#include "tests/support/temporary_folder.hpp"

#include <glm/geometric.hpp>

namespace raks::apps {
namespace {

constexpr double kRate = 5.0;

/// Two cameras of a ring of eight, and a board.
class DrawnBoards : public ::testing::Test {
 protected:
    DrawnBoards() : rig_(capture::unlike_cameras_rig(8, 640, 480)) {
        rig_.cameras.resize(2);
        for (capture::Camera& camera : rig_.cameras) {
            camera.lens.fx *= 1.4;
            camera.lens.fy *= 1.4;
        }
        // Large, since the pictures are small.
        board_.columns = 5;
        board_.rows = 4;
        board_.square = 0.2;
        board_.marker = 0.15;
    }

    [[nodiscard]] CapturePlan plan_of(const BoardFilms& films) const {
        CapturePlan plan;
        plan.folder = folder_.path();
        plan.board = board_;
        for (std::size_t i = 0; i < rig_.cameras.size(); ++i) {
            plan.cameras.push_back({rig_.cameras[i].name, {}, films.films[i], 0.0});
        }
        return plan;
    }

    test::TemporaryFolder folder_;
    capture::Rig rig_;
    capture::Board board_;
};

TEST_F(DrawnBoards, bring_the_rig_back_by_their_own_sound) {
    const std::vector<capture::Clock> truth = {{"cam1", 0.0, 0.0, 1.0}, {"cam2", 0.37, 40.0, 1.0}};
    const auto films = draw_board_films(
        rig_, board_, truth, folder_.path(), {.frames_per_second = kRate, .is_draft = true});
    ASSERT_TRUE(films) << films.error().message;

    SyncPlan heard;
    for (std::size_t i = 0; i < 2; ++i) {
        const double metres =
            glm::distance(rig_.cameras[i].centre(), DrawnFilmOptions{}.loudspeaker);
        heard.cameras.push_back({rig_.cameras[i].name, films->films[i], metres});
    }
    const auto synced = synchronise(heard);
    ASSERT_TRUE(synced) << synced.error().message;
    const std::vector<capture::Clock> clocks = synced->clocks();
    ASSERT_EQ(clocks.size(), 2U);
    EXPECT_NEAR(clocks[1].capture_time(20.0) - clocks[0].capture_time(20.0),
                truth[1].capture_time(20.0) - 20.0,
                5e-4);

    const CapturePlan plan = plan_of(*films);
    const auto boards = find_filmed_boards(plan, {.clocks = clocks});
    ASSERT_TRUE(boards) << boards.error().message;
    const auto done = capture::calibrate_rig(board_, boards->cameras, boards->sightings);
    ASSERT_TRUE(done) << done.error().message;
    std::printf("shared %zu, held-out edges %.2f mm, reprojection %.3f px\n",
                done->shared.between(0, 1),
                1e3 * done->held_out.rms,
                done->rms);
    EXPECT_GE(done->shared.between(0, 1), capture::kFewShared);
    EXPECT_LT(done->held_out.rms, 0.003);
    EXPECT_LT(done->rms, 0.4);
    const auto base = [](const capture::Rig& rig) {
        return glm::distance(rig.cameras[0].centre(), rig.cameras[1].centre());
    };
    std::printf("cameras apart: off by %.1f mm of %.2f m\n",
                1e3 * (base(done->rig) - base(rig_)),
                base(rig_));
    EXPECT_NEAR(base(done->rig), base(rig_), 0.04);
    for (std::size_t i = 0; i < 2; ++i) {
        const capture::Lens& lens = done->rig.cameras[i].lens;
        EXPECT_NEAR(lens.fx, rig_.cameras[i].lens.fx, 0.02 * lens.fx) << i;
    }
}

TEST_F(DrawnBoards, are_refused_where_the_clocks_leave_a_camera_out) {
    CapturePlan plan;
    plan.board = board_;
    plan.cameras = {{"cam1", {}, "x.mp4", 0.0}};
    const auto found = find_filmed_boards(plan, {.clocks = {{"cam2", 0.0, 0.0, 1.0}}});
    ASSERT_FALSE(found);
    EXPECT_NE(found.error().message.find("say nothing of it"), std::string::npos)
        << found.error().message;
}

TEST_F(DrawnBoards, stop_when_asked) {
    const std::vector<capture::Clock> clocks = {{"cam1", 0.0, 0.0, 1.0}, {"cam2", 0.0, 0.0, 1.0}};
    DrawnFilmOptions options{.frames_per_second = kRate};
    options.is_stop_requested = [] { return true; };
    const auto films = draw_board_films(rig_, board_, clocks, folder_.path(), options);
    ASSERT_FALSE(films);
    EXPECT_NE(films.error().message.find("was stopped"), std::string::npos);
    EXPECT_TRUE(std::filesystem::is_empty(folder_.path()));
}

TEST_F(DrawnBoards, end_on_the_floor_printed_side_up) {
    const CarriedBoard way(rig_, board_, 1);
    const capture::RigidMotion place = way.place_at(way.floor_time());
    const glm::dvec3 middle = place({2.5 * board_.square, 2.0 * board_.square, 0.0});
    EXPECT_LT(glm::length(middle), 1e-9);
    // z points away from who looks at the print.
    EXPECT_LT(glm::distance(place.rotation[2], glm::dvec3(0.0, -1.0, 0.0)), 1e-9);
    EXPECT_LT(glm::distance(place.rotation[0], glm::dvec3(1.0, 0.0, 0.0)), 1e-9);
    EXPECT_EQ(place.translation, way.place_at(way.seconds() + 100.0).translation);
    // Held still for most of the time, and nowhere torn.
    std::size_t still = 0;
    const auto steps = static_cast<std::size_t>(way.seconds() * 100.0);
    for (std::size_t i = 1; i < steps; ++i) {
        const double time = 0.01 * static_cast<double>(i);
        const double way_of_step =
            glm::distance(way.place_at(time).translation, way.place_at(time - 0.01).translation);
        still += way_of_step < 1e-9 ? 1U : 0U;
        EXPECT_LT(way_of_step, 0.6) << time;
    }
    EXPECT_GT(still, steps * 3 / 4);
}

}  // namespace
}  // namespace raks::apps
