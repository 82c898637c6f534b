// raks eval dance: from generated music to the table.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "tests/end_to_end/program_fixture.hpp"

#include <nlohmann/json.hpp>

namespace raks::test {
namespace {

class EvalDance : public ProgramTest {};

TEST_F(EvalDance, measures_a_trial_and_says_what_is_out_of_bounds) {
    const ProcessResult result = run({"eval", "dance", "--trial", "salsa-170", "--json"});
    ASSERT_EQ(result.exit_code, 0) << result.err;
    EXPECT_EQ(result.err, "");
    const auto document = nlohmann::json::parse(result.out);
    EXPECT_EQ(document["format"], "raks-eval-dance");
    EXPECT_EQ(document["version"], 1);
    EXPECT_EQ(document["role"], "lead");
    ASSERT_EQ(document["trials"].size(), 1U);
    const auto& trial = document["trials"][0];
    EXPECT_EQ(trial["name"], "salsa-170");
    EXPECT_EQ(trial["kind"], "steady");
    const auto& values = trial["values"];
    EXPECT_GE(values["landings"].get<double>(), 50.0);
    EXPECT_LE(std::abs(values["landing_mean_ms"].get<double>()), 15.0);
    EXPECT_LE(values["landing_deviation_ms"].get<double>(), 25.0);
    EXPECT_LE(values["slip_median_cm"].get<double>(), 1.5);
    EXPECT_GE(values["lowest_sole_mm"].get<double>(), -5.0);
    EXPECT_GT(values["danced_share"].get<double>(), 0.8);
    for (const auto& [id, bound] : document["bounds"]["steady"].items()) {
        const double value = values[id].get<double>();
        const bool is_within = (bound[0].is_null() || value >= bound[0].get<double>()) &&
                               (bound[1].is_null() || value <= bound[1].get<double>());
        const auto& outside = trial["outside"];
        EXPECT_EQ(is_within, std::find(outside.begin(), outside.end(), id) == outside.end()) << id;
    }
    ASSERT_FALSE(trial["figures"].empty());
    EXPECT_GE(trial["figures"][0]["repeats"].get<int>(), 3);
    EXPECT_GT(trial["figures"][0]["hips_travel"].get<double>(), 0.2);
}

TEST_F(EvalDance, measures_the_follow_in_a_couple_as_well_and_writes_tables) {
    const ProcessResult result = run({"eval",
                                      "dance",
                                      "--role",
                                      "follow",
                                      "--formation",
                                      "couple",
                                      "--trial",
                                      "salsa-200-to-160"});
    ASSERT_EQ(result.exit_code, 0) << result.err;
    EXPECT_NE(result.out.find("salsa, follow, trajectories, seed 1"), std::string::npos);
    EXPECT_NE(result.out.find("| salsa-200-to-160 |"), std::string::npos) << result.out;
    EXPECT_NE(result.out.find("| Raks: basic "), std::string::npos) << result.out;
    EXPECT_NE(result.out.find("| hands p90 cm "), std::string::npos) << result.out;
}

TEST_F(EvalDance, compares_the_loudness_of_files_with_the_dance) {
    ASSERT_EQ(run({"synth",
                   "house",
                   "--form",
                   "full:8,filtered:8,stop:4,drop:8",
                   "--duration",
                   "14",
                   "-o",
                   path("a.wav")})
                  .exit_code,
              0);
    const ProcessResult result =
        run({"eval", "dance", "--dance", "house", "--against", path("a.wav"), "--json"});
    ASSERT_EQ(result.exit_code, 0) << result.err;
    const auto document = nlohmann::json::parse(result.out);
    EXPECT_EQ(document["format"], "raks-eval-dance-against");
    ASSERT_EQ(document["files"].size(), 1U);
    const auto& file = document["files"][0];
    EXPECT_EQ(file["file"], "a.wav");
    EXPECT_GT(file["loudness_spread_db"].get<double>(), 12.0);
    EXPECT_LE(std::abs(file["known"].get<double>()), 1.0);
    EXPECT_EQ(document["mean"]["live"], file["live"]);
    const ProcessResult missing = run({"eval", "dance", "--against", path("none.wav")});
    EXPECT_EQ(missing.exit_code, 1);
    EXPECT_TRUE(is_one_error_line(missing.err)) << missing.err;
}

TEST_F(EvalDance, refuses_what_it_cannot_measure_in_one_line) {
    const ProcessResult both = run({"eval", "dance", "--trial", "dynamics", "--against", "a.wav"});
    EXPECT_EQ(both.exit_code, 2);
    EXPECT_TRUE(is_one_error_line(both.err)) << both.err;
    const ProcessResult unknown = run({"eval", "dance", "--trial", "salsa-181"});
    EXPECT_EQ(unknown.exit_code, 1);
    EXPECT_TRUE(is_one_error_line(unknown.err)) << unknown.err;
    EXPECT_NE(unknown.err.find("salsa-180"), std::string::npos) << unknown.err;
    const ProcessResult no_labels = run({"eval", "dance", "--clips", folder_.path().string()});
    EXPECT_EQ(no_labels.exit_code, 2);
    EXPECT_TRUE(is_one_error_line(no_labels.err)) << no_labels.err;
    const ProcessResult no_file =
        run({"eval", "dance", "--clips", folder_.path().string(), "--labels", path("none.tsv")});
    EXPECT_EQ(no_file.exit_code, 1);
    EXPECT_TRUE(is_one_error_line(no_file.err)) << no_file.err;
}

}  // namespace
}  // namespace raks::test
