#include <gtest/gtest.h>

#include <cmath>
#include <filesystem>

#include "base/file.hpp"
#include "motion/figures/figure_model.hpp"
#include "tests/motion/figures/small_figure.hpp"
#include "tests/support/temporary_folder.hpp"
#include "tests/support/text.hpp"

namespace raks::motion {
namespace {

const FigureModel& good_model() {
    static const FigureModel model = test::small_figure();
    return model;
}

TEST(FigureFile, reads_back_the_same_bits) {
    const std::string text = figure_text(good_model());
    const Expected<FigureModel> again = parse_figure(text, "known.json");
    ASSERT_TRUE(again) << again.error().message;
    EXPECT_EQ(figure_text(*again), text);
    EXPECT_EQ(again->part(Part::lower).states[2].mean,
              good_model().part(Part::lower).states[2].mean);
    EXPECT_EQ(again->net_turn, good_model().net_turn);
    EXPECT_EQ(again->landings[0].size(), 8U);
}

TEST(FigureFile, keeps_how_far_hands_are_closed) {
    FigureModel model = good_model();
    model.fist = {std::vector<double>{0.25}, std::vector<double>(kContactBins, 0.5)};
    model.fist[1][7] = 0.75;
    const auto read = parse_figure(figure_text(model), "x.json");
    ASSERT_TRUE(read) << read.error().message;
    EXPECT_EQ(read->fist, model.fist);
}

TEST(FigureFile, keeps_how_its_size_follows_the_tempo) {
    FigureModel model = good_model();
    EXPECT_EQ(figure_text(model).find("size_by_tempo"), std::string::npos);
    model.size_by_tempo = {0.7, 0.0};
    const auto read = parse_figure(figure_text(model), "x.json");
    ASSERT_TRUE(read) << read.error().message;
    EXPECT_EQ(read->size_by_tempo.body, 0.7);
    EXPECT_EQ(read->size_by_tempo.arms, 0.0);
}

TEST(FigureFile, is_saved_whole_and_loaded) {
    const raks::test::TemporaryFolder folder;
    const std::filesystem::path path = folder / "known.json";
    ASSERT_TRUE(save_figure(good_model(), path));
    const Expected<FigureModel> again = load_figure(path);
    ASSERT_TRUE(again) << again.error().message;
    EXPECT_EQ(again->name, "known");
    std::filesystem::remove(path);
    const Expected<FigureModel> missing = load_figure(path);
    ASSERT_FALSE(missing);
    EXPECT_NE(missing.error().message.find("cannot be opened"), std::string::npos);
}

TEST(FigureValidation, names_the_first_wrong_field) {
    const double nan = std::nan("");
    struct Row {
        std::function<void(FigureModel&)> spoil;
        std::string message;
    };
    const std::vector<Row> table = {
        {[](FigureModel& m) { m.parts[0].states[3].variance[0] = -0.2; },
         "parts[0].states[3].variance[0] is -0.2, must be 1e-12 or more"},
        {[](FigureModel& m) { m.parts[1].states[0].delta_variance[2] = 0.0; },
         "parts[1].states[0].delta_variance[2] is 0, must be 1e-12 or more"},
        {[=](FigureModel& m) { m.parts[2].states[1].mean[5] = nan; },
         "parts[2].states[1].mean[5] is nan, must lie within +-10000"},
        {[](FigureModel& m) { m.parts[2].states[1].delta_delta_mean[5] = INFINITY; },
         "parts[2].states[1].delta_delta_mean[5] is inf, must lie within +-10000"},
        {[](FigureModel& m) { m.parts[0].states[1].mean.pop_back(); },
         "parts[0].states[1].mean has 14 numbers, must have 15"},
        {[](FigureModel& m) { m.parts[0].states.clear(); },
         "parts[0].states has 0 entries, must have 1 to 192"},
        {[](FigureModel& m) { m.parts[1].transition[1][1] -= 0.5; },
         "parts[1].transition[1] sums to 0.5, must be 1"},
        {[](FigureModel& m) { m.parts[1].transition.pop_back(); },
         "parts[1].transition has 3 numbers, must have 4"},
        {[](FigureModel& m) { m.parts[1].initial[0] = 0.5; },
         "parts[1].initial sums to 0.5, must be 1"},
        {[](FigureModel& m) { m.parts[0].covariance[0][0] = -1.0; },
         "parts[0].covariance[0][0] is -1, must be 1e-12 or more"},
        {[](FigureModel& m) { m.parts[0].states[0].variance[2] = 1.34e-321; },
         "parts[0].states[0].variance[2] is 1.34e-321, must be 1e-12 or more"},
        {[](FigureModel& m) { m.parts[0].states[0].variance[2] = 1e-200; },
         "parts[0].states[0].variance[2] is 1e-200, must be 1e-12 or more"},
        {[](FigureModel& m) { m.dance = "../../evil"; },
         "\"../../evil\" cannot be a name: 1 to 64 bytes, no '/', '\\' or control characters, not "
         "\".\" "
         "or \"..\""},
        {[](FigureModel& m) {
             m.beats = 64;
             m.samples_per_beat = 200;
         },
         "samples_per_beat is 200: 12800 samples in 64 beats, must be at most 2048"},
        {[](FigureModel& m) { m.parts[0].covariance[0][1] += 5.0; },
         "parts[0].covariance is not positive definite"},
        {[](FigureModel& m) { m.parts[0].covariance_kind = CovarianceKind::full; },
         "parts[0].state_covariances has 0 entries, must have 4"},
        {[](FigureModel& m) {
             m.parts[2].covariance_kind = CovarianceKind::full;
             m.parts[2].state_covariances.assign(4, m.parts[2].covariance);
             m.parts[2].state_covariances[3][0][0] = -1.0;
         },
         "parts[2].state_covariances[3][0][0] is -1, must be 1e-12 or more"},
        {[](FigureModel& m) {
             m.parts[2].covariance_kind = CovarianceKind::diagonal;
             m.parts[2].state_covariances.assign(4, {m.parts[2].global_variance});
             m.parts[2].state_covariances[1][0][5] = 0.0;
         },
         "parts[2].state_covariances[1][0][5] is 0, must be 1e-12 or more"},
        {[](FigureModel& m) {
             m.parts[1].covariance_kind = CovarianceKind::diagonal;
             m.parts[1].state_covariances.assign(4, {m.parts[2].covariance});
         },
         "parts[1].state_covariances[0] has 18 rows, must have 1"},
        {[](FigureModel& m) { m.parts[0].occurrence.pop_back(); },
         "parts[0].occurrence has 7 rows, must have 8"},
        {[](FigureModel& m) { m.parts[0].occurrence[2].push_back(0.0); },
         "parts[0].occurrence[2] has 5 numbers, must have 4"},
        {[](FigureModel& m) {
             m.parts[0].occurrence[2] = {0.5, 0.5, 0.5, 0.0};
         },
         "parts[0].occurrence[2] sums to 1.5, must be 1"},
        {[=](FigureModel& m) { m.parts[0].occurrence[7][1] = nan; },
         "parts[0].occurrence[7][1] is nan, must lie in [0, 1]"},
        {[](FigureModel& m) { m.parts[1].stays.clear(); },
         "parts[1].stays has 0 numbers, must have 4"},
        {[](FigureModel& m) { m.parts[1].stays[1].deviation = Beats(-0.1); },
         "parts[1].stays[1].deviation is -0.1, must lie in [0, 8]"},
        {[](FigureModel& m) { m.parts[0].global_variance[14] = 0.0; },
         "parts[0].global_variance[14] is 0, must be 1e-12 or more"},
        {[](FigureModel& m) { m.parts[1].joints[2].mean.w = 3.0; },
         "parts[1].joints[2].mean has length"},
        {[](FigureModel& m) { std::swap(m.parts[0], m.parts[1]); }, "parts[0].part must be torso"},
        {[](FigureModel& m) { m.beats = 0; }, "beats is 0, must be 1 to 64"},
        {[](FigureModel& m) { m.samples_per_beat = 3; }, "samples_per_beat is 3, must be 4 to 200"},
        {[](FigureModel& m) { m.learnt_tempo = Bpm(0.0); },
         "learnt_tempo is 0, must lie in [20, 400]"},
        {[=](FigureModel& m) { m.net_displacement.y = nan; },
         "net_displacement[1] is nan, must lie in [-100, 100]"},
        {[](FigureModel& m) { m.contact[1][63] = 1.5; },
         "contact.right[63] is 1.5, must lie in [0, 1]"},
        {[](FigureModel& m) {
             m.fist = {std::vector<double>{0.5}, std::vector<double>{1.2}};
         },
         "fist.right[0] is 1.2, must lie in [0, 1]"},
        {[](FigureModel& m) {
             m.fist = {std::vector<double>{0.5}, std::vector<double>(3, 0.5)};
         },
         "fist.right has 3 numbers, must have 1 or 64"},
        {[](FigureModel& m) { m.fist[0] = {0.5}; }, "fist.right has 0 numbers"},
        {[](FigureModel& m) { m.size_by_tempo.arms = -0.5; },
         "size_by_tempo.arms is -0.5, must lie in [0, 2]"},
        {[nan](FigureModel& m) { m.size_by_tempo.body = nan; },
         "size_by_tempo.body is nan, must lie in [0, 2]"},
        {[](FigureModel& m) { m.landings[0].pop_back(); },
         "landings.left has 7 numbers, must have 8"},
        {[](FigureModel& m) { m.landings[0][2].deviation = Beats(-1.0); },
         "landings.left[2].deviation is -1, must lie in [0, 8]"},
    };
    for (const Row& row : table) {
        FigureModel model = good_model();
        row.spoil(model);
        const Expected<void> ok = validate(model);
        ASSERT_FALSE(ok) << row.message;
        EXPECT_EQ(ok.error().message.substr(0, row.message.size()), row.message);
    }
    EXPECT_TRUE(validate(good_model()));
}

TEST(FigureFile, refuses_bad_files_in_one_line) {
    const std::string good = figure_text(good_model());
    const auto replaced = [&](const std::string& from, const std::string& to) {
        return raks::test::replaced(good, from, to);
    };
    const struct {
        std::string text;
        std::string message;
    } table[] = {
        {"", "x.json: not JSON (line 1): cut off or edited by hand? fetch or train it again"},
        {replaced("raks-figure", "raks-hmm"),
         "x.json: not a raks-figure file (no \"format\": \"raks-figure\")"},
        {replaced("\"version\": 1", "\"version\": 7"),
         "x.json: version 7 is newer than 2, the newest this program reads; update Raks"},
        {replaced("\"repeats\": 3", "\"repeats\": -3"),
         "x.json: repeats is -3, must be a whole number from 0 to 1000000; train the figure again"},
        {replaced("\"lead\"", "\"boss\""),
         "x.json: role is \"boss\", which is unknown; train the figure again"},
        {replaced("\"chest\"", "\"tail\""),
         "x.json: parts[0].joints[1].bone is \"tail\", which is unknown; train the figure again"},
        {replaced("\"variance\": [", "\"variance\": [-"),
         "x.json: parts[0].states[0].variance[0] is -"},
        {replaced("\"covariance\": [\n    [", "\"covariance\": [\n    [-"),
         "x.json: parts[0].covariance[0][0] is -"},
        {replaced("\"delta_mean\": [", "\"delta_mean\": [null,"),
         "x.json: parts[0].states[0].delta_mean[0] is not a number; train the figure again"},
        {replaced("\"stays\"", "\"stage\""),
         "x.json: parts[0].stays is missing; train the figure again"},
        {replaced("\"occurrence\": [\n    [", "\"occurrence\": [\n    [-"),
         "x.json: parts[0].occurrence[0][0] is -"},
        {replaced("\"net_turn\"", "\"net_tern\""),
         "x.json: net_turn is missing; train the figure again"},
    };
    for (const auto& row : table) {
        const Expected<FigureModel> model = parse_figure(row.text, "x.json");
        ASSERT_FALSE(model) << row.message;
        EXPECT_EQ(model.error().message.substr(0, row.message.size()), row.message);
        EXPECT_EQ(model.error().message.find('\n'), std::string::npos);
    }
}

TEST(FigureFile, a_model_from_before_the_table_was_kept_has_its_states_on_slices) {
    std::string text = figure_text(good_model());
    for (const std::string key : {"occurrence", "stays"}) {
        for (std::size_t at = text.find("\"" + key); at != std::string::npos;
             at = text.find("\"" + key)) {
            text.replace(at + 1, key.size(), "an_unknown_field");
        }
    }
    const Expected<FigureModel> model = parse_figure(text, "x.json");
    ASSERT_TRUE(model) << model.error().message;
    for (const PartModel& part : model->parts) {
        EXPECT_NEAR(part.occurrence[0][0], 1.0, 1e-12);
        EXPECT_NEAR(part.occurrence[7][3], 1.0, 1e-12);
        EXPECT_NEAR(part.stays[2].mean.count(), 2.0, 1e-12);
        EXPECT_EQ(part.stays[2].deviation.count(), 0.0);
    }
}

TEST(FigureFile, survives_cuts_and_flipped_bytes) {
    test::expect_survives_damage(figure_text(good_model()), 5);
}

}  // namespace
}  // namespace raks::motion
