// The models that ship: they load, they are the basic step, and the clips give them again.
#include <gtest/gtest.h>

#include <cmath>
#include <cstdlib>
#include <filesystem>

#include "base/file.hpp"
#include "motion/figures/figure_model.hpp"
#include "tests/support/temporary_folder.hpp"
#include "training/figures/training_plan.hpp"

namespace raks::motion {
namespace {

namespace fs = std::filesystem;

const fs::path kModels = fs::path(RAKS_SOURCE_DIR) / "models" / "trained";

/// Reference data beside the repository, where there is some.
fs::path shared_mocap() {
    const char* const given = std::getenv("RAKS_SHARED");  // NOLINT(concurrency-mt-unsafe)
    const fs::path root =
        given != nullptr ? fs::path(given) : fs::path(RAKS_SOURCE_DIR) / "../shared";
    return root / "data" / "mocap";
}

fs::path model_path(DanceRole role,
                    const std::string& figure = "basic",
                    FigureFeatures features = FigureFeatures::angles) {
    const std::string name(kRoleNames[static_cast<std::size_t>(role)]);
    const std::string kind = features == FigureFeatures::positions ? "_positions" : "";
    return kModels / ("salsa_" + figure + "_" + name + kind + ".json");
}

class ShippedFigure : public ::testing::TestWithParam<DanceRole> {};
INSTANTIATE_TEST_SUITE_P(SalsaBasic,
                         ShippedFigure,
                         ::testing::Values(DanceRole::lead, DanceRole::follow),
                         [](const auto& role) {
                             return std::string(kRoleNames[static_cast<std::size_t>(role.param)]);
                         });

/// The same figures, learnt anew: long enough to be left out under a sanitizer.
class FigureFromClips : public ShippedFigure {};
INSTANTIATE_TEST_SUITE_P(SalsaBasic,
                         FigureFromClips,
                         ::testing::Values(DanceRole::lead, DanceRole::follow),
                         [](const auto& role) {
                             return std::string(kRoleNames[static_cast<std::size_t>(role.param)]);
                         });

TEST_P(ShippedFigure, is_a_basic_of_eight_beats_that_says_where_it_comes_from) {
    const Expected<FigureModel> model = load_figure(model_path(GetParam()));
    ASSERT_TRUE(model) << model.error().message;
    EXPECT_EQ(model->name, "basic");
    EXPECT_EQ(model->dance, "salsa");
    EXPECT_EQ(model->role, GetParam());
    EXPECT_EQ(model->beats, 8);
    EXPECT_EQ(model->attribution, cmu_attribution());
    EXPECT_NEAR(model->learnt_tempo.bpm(), 170.0, 15.0);
    EXPECT_LT(glm::length(model->net_displacement), 0.15);
    EXPECT_LT(fs::file_size(model_path(GetParam())), 1'000'000U);
    for (const PartModel& part : model->parts) {
        EXPECT_EQ(part.states.size(), 16U);
    }
}

TEST_P(ShippedFigure, lands_late_on_three_and_seven_as_people_do) {
    const Expected<FigureModel> model = load_figure(model_path(GetParam()));
    ASSERT_TRUE(model);
    // Lead: left on 1, right on 5; the follow mirrors. 0.15 beats: twice the standard error.
    const std::size_t one = GetParam() == DanceRole::lead ? 0 : 1;
    const auto median = [&](std::size_t side, std::size_t count) {
        EXPECT_GE(model->landings[side][count - 1].repeats, 5);
        return model->landings[side][count - 1].median.count();
    };
    EXPECT_NEAR(median(one, 1), 0.0, 0.15);
    EXPECT_NEAR(median(1 - one, 5), 0.0, 0.15);
    EXPECT_NEAR(median(one, 3), 0.36, 0.15);
    EXPECT_NEAR(median(1 - one, 7), 0.36, 0.15);
}

TEST_P(ShippedFigure, half_turns_are_half_turns) {
    // Cross-body: both end half a turn further; the follow's travelling turn has a full one more.
    const auto turn_of = [](const std::string& figure) {
        const Expected<FigureModel> model = load_figure(model_path(GetParam(), figure));
        EXPECT_TRUE(model) << model.error().message;
        return model->net_turn / M_PI;
    };
    EXPECT_NEAR(std::abs(turn_of("cross_body_lead")), 1.0, 0.25);
    const bool is_lead = GetParam() == DanceRole::lead;
    EXPECT_NEAR(std::abs(turn_of("inplace_turn")), is_lead ? 0.0 : 2.0, 0.25);
    EXPECT_NEAR(std::abs(turn_of("travelling_turn")), is_lead ? 1.0 : 3.0, 0.25);
}

TEST_P(ShippedFigure, of_positions_tells_what_the_one_of_angles_does) {
    for (const char* const figure :
         {"basic", "cross_body_lead", "inplace_turn", "travelling_turn"}) {
        const Expected<FigureModel> angles = load_figure(model_path(GetParam(), figure));
        const Expected<FigureModel> positions =
            load_figure(model_path(GetParam(), figure, FigureFeatures::positions));
        ASSERT_TRUE(angles && positions) << figure;
        EXPECT_EQ(positions->features, FigureFeatures::positions);
        EXPECT_EQ(positions->attribution, cmu_attribution());
        EXPECT_EQ(positions->repeats, angles->repeats);
        EXPECT_EQ(positions->contact, angles->contact);
        EXPECT_EQ(positions->peak_toe_speed, angles->peak_toe_speed);
        EXPECT_NEAR(positions->net_turn, angles->net_turn, 1e-9);
    }
}

TEST_P(FigureFromClips, comes_out_of_them_bit_for_bit) {
    const fs::path mocap = shared_mocap();
    const fs::path archive = mocap / "salsa" / "salsa.tar.xz";
    if (!fs::exists(archive)) {
        GTEST_SKIP() << "no clips at " << archive;
    }
    const bool is_lead = GetParam() == DanceRole::lead;
    const std::string prefix = is_lead ? "60" : "61";
    const raks::test::TemporaryFolder folder;
    const std::string command = "tar -xJf '" + archive.string() + "' -C '" +
                                folder.path().string() + "' --wildcards '*" + prefix + "_*.bvh'";
    // NOLINTNEXTLINE(concurrency-mt-unsafe, cert-env33-c): a test that unpacks its own input
    ASSERT_EQ(std::system(command.c_str()), 0) << command;

    FigureTrainingPlan plan;
    plan.clips = {folder.path()};
    plan.labels = mocap / "labels_salsa.tsv";
    plan.counts = mocap / "salsa_counts.tsv";
    plan.faults = mocap / "salsa_glitches.tsv";
    plan.dance = "salsa";
    plan.role = GetParam();
    plan.split = "train";
    plan.reading.frames_per_second = 60.0;
    plan.metres_per_unit = is_lead ? 1.267 : 1.17;
    plan.attribution = cmu_attribution();
    for (const char* const figure :
         {"basic", "cross_body_lead", "inplace_turn", "travelling_turn"}) {
        for (const FigureFeatures features : {FigureFeatures::angles, FigureFeatures::positions}) {
            plan.figure = figure;
            plan.features = features;
            const Expected<FigureTrainingReport> report = train_figure(plan);
            ASSERT_TRUE(report) << report.error().message;
            EXPECT_EQ(figure_text(report->model),
                      read_file(model_path(GetParam(), figure, features)).value())
                << figure;
        }
    }
}

}  // namespace
}  // namespace raks::motion
