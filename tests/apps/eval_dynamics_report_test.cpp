#include "apps/reports/eval_dynamics_report.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <string>
#include <vector>

#include <nlohmann/json.hpp>

namespace raks::apps {
namespace {

// A dance that reaches everything.
engine::DynamicsResult danced() {
    engine::DynamicsResult result;
    result.ratios = {.full = 0.7,
                     .breakdown = 0.6,
                     .silence = 0.2,
                     .bar_after = 0.9,
                     .drop = 1.2,
                     .end_to_2 = 0.5,
                     .end_to_5 = 0.2,
                     .end_to_13 = 0.1};
    result.phrased.holds_per_minute = 4.0;
    result.phrased.second_spread = 2.5;
    result.phrased.body_spread = 3.5;
    result.phrased.still_hands = 0.1;
    result.phrased.hand_hits = 3.5;
    result.steady.nearest_bar = 0.08;
    result.steady.distinct_bars = 0.6;
    result.bars_to_begin = 0.8;
    result.first_count_off = 0.01;
    return result;
}

bool has_line(const std::string& text, const std::string& part, const std::string& end) {
    const std::size_t at = text.find(part);
    return at != std::string::npos &&
           text.substr(at, text.find('\n', at) - at).find(end) != std::string::npos;
}

TEST(EvalDynamicsReport, a_dance_that_reaches_everything_is_said_so) {
    const DynamicsReport report{danced(), danced()};
    const Verdict verdict = verdict_of(report);
    EXPECT_EQ(verdict.outside, 0U);
    // Ten for both, and one each that only the live and only the known dance has.
    EXPECT_EQ(verdict.bounded, 22U);
    const std::string text = to_text(report);
    EXPECT_EQ(text.find('!'), std::string::npos) << text;
    EXPECT_TRUE(has_line(text, "| silence from 0.5 s / full", "yes")) << text;
    EXPECT_TRUE(has_line(text, "| song: hands still %", "10.0")) << text;
}

TEST(EvalDynamicsReport, what_is_not_reached_or_missing_is_marked_where_it_is) {
    DynamicsReport report{danced(), danced()};
    report.live.ratios.silence = 0.26;
    report.known.first_count_off.reset();
    EXPECT_EQ(verdict_of(report).outside, 2U);
    const std::string text = to_text(report);
    EXPECT_TRUE(has_line(text, "| silence from 0.5 s / full", "0.26!")) << text;
    EXPECT_TRUE(has_line(text, "| silence from 0.5 s / full", "no")) << text;
    EXPECT_TRUE(has_line(text, "| first count 1", "-!")) << text;
    const auto json = nlohmann::json::parse(to_json(report).text());
    EXPECT_EQ(json["live"]["outside"], nlohmann::json::array({"silence_ratio"}));
    EXPECT_EQ(json["known"]["outside"], nlohmann::json::array({"first_count_off_ms"}));
    EXPECT_TRUE(json["known"]["values"]["first_count_off_ms"].is_null());
    EXPECT_TRUE(json["known"]["values"]["bars_to_begin"].is_null()) << "of the live dance only";
    EXPECT_EQ(json["live"]["values"]["bars_to_begin"], 0.8);
    EXPECT_EQ(json["bounds"]["song_holds_per_minute"], nlohmann::json::array({2.0, 8.0}));
}

TEST(EvalDynamicsReport, files_are_listed_with_the_mean_of_all) {
    const std::vector<FollowedFile> files{{"a.ogg", {0.6, 9.0}, {0.1, 9.0}},
                                          {"b.ogg", {0.4, 7.0}, {0.3, 7.0}}};
    const std::string text = to_text(std::span(files));
    EXPECT_TRUE(has_line(text, "| a.ogg", "+0.60")) << text;
    EXPECT_TRUE(has_line(text, "| mean", "+0.50 ")) << text;
    EXPECT_TRUE(has_line(text, "| mean", "+0.20!")) << text;
    const auto json = nlohmann::json::parse(to_json(std::span(files)));
    EXPECT_EQ(json["format"], "raks-eval-dance-against");
    EXPECT_NEAR(json["mean"]["live"].get<double>(), 0.2, 1e-9);
}

}  // namespace
}  // namespace raks::apps
