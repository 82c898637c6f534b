#include "apps/reports/reliability_table.hpp"

#include <gtest/gtest.h>

#include <nlohmann/json.hpp>

namespace raks::apps {
namespace {

// Three of four are right at .95; at .3 none of two.
std::vector<audio::Claim> known_claims() {
    return {
        {0.95F, true}, {0.3F, false}, {0.95F, true}, {0.95F, false}, {1.0F, true}, {0.39F, false}};
}

TEST(ReliabilityTable, says_of_each_confidence_how_many_were_right) {
    const std::string table =
        reliability_table("sure", {{"dances", known_claims()}, {"bars", {{0.05F, true}}}});
    EXPECT_EQ(table,
              "| sure  | dances | right | bars | right |\n"
              "|-------|-------:|------:|-----:|------:|\n"
              "| .0-.1 |      0 |     - |    1 | 100.0 |\n"
              "| .1-.2 |      0 |     - |    0 |     - |\n"
              "| .2-.3 |      0 |     - |    0 |     - |\n"
              "| .3-.4 |      2 |   0.0 |    0 |     - |\n"
              "| .4-.5 |      0 |     - |    0 |     - |\n"
              "| .5-.6 |      0 |     - |    0 |     - |\n"
              "| .6-.7 |      0 |     - |    0 |     - |\n"
              "| .7-.8 |      0 |     - |    0 |     - |\n"
              "| .8-.9 |      0 |     - |    0 |     - |\n"
              "| .9-1  |      4 |  75.0 |    0 |     - |\n");
}

TEST(ReliabilityTable, json_has_the_same_numbers) {
    const auto bins = nlohmann::json::parse(reliability_json(known_claims()).text());
    ASSERT_EQ(bins.size(), audio::kReliabilityBins);
    EXPECT_EQ(bins[0].dump(), R"({"claims":0,"right":0})");
    EXPECT_EQ(bins[3].dump(), R"({"claims":2,"right":0})");
    EXPECT_EQ(bins[9].dump(), R"({"claims":4,"right":3})");
}

}  // namespace
}  // namespace raks::apps
