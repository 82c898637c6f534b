// raks eval avatar: how models wear dances, told to people and programs.
#include <gtest/gtest.h>

#include <filesystem>
#include <set>
#include <string>

#include "base/pending_file.hpp"
#include "tests/end_to_end/program_fixture.hpp"

#include <nlohmann/json.hpp>

namespace raks::test {
namespace {

namespace fs = std::filesystem;
const fs::path kDevModels = fs::path(RAKS_SOURCE_DIR) / "tests" / "data" / "avatars";

class EvalAvatar : public ProgramTest {};

void expect_outside_is_what_breaks_its_bounds(const nlohmann::json& dance) {
    const auto outside = dance["outside"].get<std::set<std::string>>();
    for (const auto& [id, bound] : dance["bounds"].items()) {
        const auto& value = dance["values"][id];
        const bool is_outside = !value.is_null() && ((!bound[0].is_null() && value < bound[0]) ||
                                                     (!bound[1].is_null() && value > bound[1]));
        EXPECT_EQ(outside.count(id) == 1, is_outside) << id << ": " << value << " in " << bound;
    }
}

TEST_F(EvalAvatar, measures_the_mannequin_and_a_character_in_one_document) {
    const std::string godette = (kDevModels / "Godette_vrm_v4.vrm").string();
    const ProcessResult result =
        run({"eval", "avatar", "mannequin", godette, "--dance", "rock", "--json"});
    ASSERT_EQ(result.exit_code, 0) << result.err;
    const auto document = nlohmann::json::parse(result.out);
    EXPECT_EQ(document["format"], "raks-eval-avatar");
    EXPECT_EQ(document["version"], 1);
    ASSERT_EQ(document["avatars"].size(), 2U);
    const auto& mannequin = document["avatars"][0]["dances"];
    ASSERT_EQ(mannequin.size(), 1U);
    EXPECT_EQ(mannequin[0]["dance"], "rock");
    EXPECT_EQ(mannequin[0]["values"]["tails_lost"], 0.0);
    const auto& figure = document["avatars"][1];
    EXPECT_NEAR(figure["height_m"].get<double>(), 1.495, 0.02);
    const auto& values = figure["dances"][0]["values"];
    EXPECT_EQ(values["tails_lost"], 0.0);
    EXPECT_LT(values["planted_p99_cm"].get<double>(), 2.0);
    for (const auto& [id, bound] : figure["dances"][0]["bounds"].items()) {
        ASSERT_TRUE(values.contains(id)) << id;
        ASSERT_EQ(bound.size(), 2U) << id;
    }
    expect_outside_is_what_breaks_its_bounds(mannequin[0]);
    expect_outside_is_what_breaks_its_bounds(figure["dances"][0]);
}

TEST_F(EvalAvatar, names_what_cannot_dance_and_measures_the_others) {
    ASSERT_TRUE(write_file(path("x.glb"), "no model"));
    const ProcessResult result =
        run({"eval", "avatar", path("x.glb"), "mannequin", "--dance", "rock"});
    EXPECT_EQ(result.exit_code, 3) << result.err;
    EXPECT_NE(result.err.find("x.glb: "), std::string::npos) << result.err;
    EXPECT_NE(result.out.find("| mannequin | "), std::string::npos) << result.out;
    expect_one_line({"eval", "avatar", path("x.glb")}, 1, "x.glb: ");
    expect_one_line({"eval", "avatar", "mannequin", "--dance", "rok"}, 2, "rock");
}

}  // namespace
}  // namespace raks::test
