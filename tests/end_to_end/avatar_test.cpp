// `raks avatar`: what is in a model, told to people and programs.
#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "base/file.hpp"
#include "base/pending_file.hpp"
#include "tests/end_to_end/program.hpp"

namespace raks::test {
namespace {

namespace fs = std::filesystem;

const fs::path kModels = fs::path(RAKS_SOURCE_DIR) / "tests" / "data" / "avatars";

class Avatar : public ProgramTest {
 protected:
    /// Puts a model into the user's folder of avatars.
    void give(const std::string& name, const std::string& as) const {
        const fs::path folder = folder_ / "share" / "raks" / "avatars";
        fs::create_directories(folder);
        fs::copy_file(kModels / name, folder / as);
    }
};

TEST_F(Avatar, show_tells_programs_what_is_in_a_model) {
    const auto result = run({"avatar", "show", (kModels / "RiggedFigure.glb").string(), "--json"});
    ASSERT_EQ(result.exit_code, 0) << result.err;
    const auto json = nlohmann::json::parse(result.out);
    EXPECT_EQ(json["document"], "raks-avatar");
    EXPECT_EQ(json["version"], 1);
    EXPECT_EQ(json["format"], "glTF 2.0");
    EXPECT_EQ(json["joints_or_bones"], 19);
    EXPECT_EQ(json["triangles"], 256);
    EXPECT_NEAR(json["height_m"].get<double>(), 1.45, 0.001);
    EXPECT_EQ(json["materials"].size(), 1U);
    EXPECT_EQ(json["humanoid"]["hips"]["name"], "torso_joint_1");
    EXPECT_EQ(json["humanoid"]["hips"]["reason"], "by its place in the skeleton");
    EXPECT_EQ(json["humanoid"]["leftHand"]["name"], "arm_joint_L_3");
    EXPECT_EQ(json["humanoid"]["leftHand"]["reason"], "by its name");
    EXPECT_TRUE(json["warnings"].is_array());
    EXPECT_TRUE(json["meta"].contains("credit_required"));
}

TEST_F(Avatar, show_tells_people_the_same) {
    const auto result = run({"avatar", "show", (kModels / "RiggedFigure.glb").string()});
    ASSERT_EQ(result.exit_code, 0) << result.err;
    EXPECT_NE(result.out.find("(glTF 2.0)"), std::string::npos) << result.out;
    EXPECT_NE(result.out.find("370 vertices, 256 triangles"), std::string::npos) << result.out;
    EXPECT_NE(result.out.find("1.45 m tall"), std::string::npos) << result.out;
}

TEST_F(Avatar, list_and_show_know_the_users_own) {
    EXPECT_NE(run({"avatar", "list"}).out.find("put .vrm or .glb files into"), std::string::npos);
    give("smoke_spring.vrm", "Anna.vrm");
    EXPECT_NE(run({"avatar", "list"}).out.find("Anna\n"), std::string::npos);
    const auto json = nlohmann::json::parse(run({"avatar", "list", "--json"}).out);
    ASSERT_EQ(json["avatars"].size(), 2U);
    EXPECT_EQ(json["avatars"][0]["name"], "mannequin");
    EXPECT_EQ(json["avatars"][1]["name"], "Anna");
    EXPECT_EQ(run({"avatar", "show", "Anna"}).exit_code, 0);
    EXPECT_EQ(run({"avatar", "show", "Anna.vrm"}).exit_code, 0);
}

TEST_F(Avatar, that_cannot_be_read_is_told_in_one_line) {
    give("smoke_spring.vrm", "Anna.vrm");
    expect_one_line({"avatar", "show", "Ana"}, 1, "no avatar \"Ana\": neither a file nor one of");
    ASSERT_TRUE(write_file(path("x.glb"), "glTF"));
    expect_one_line({"avatar", "show", path("x.glb")}, 1, "x.glb: cut within its head");
    ASSERT_TRUE(write_file(path("x.fbx"), "Kaydara"));
    expect_one_line({"avatar", "show", path("x.fbx")}, 1, "x.fbx: no model that is read");
    expect_one_line({"avatar", "show", "mannequin"}, 1, "the mannequin is no file");
}

TEST_F(Avatar, pose_writes_the_mesh_of_a_posture) {
    const std::string model = (kModels / "Godette_vrm_v4.vrm").string();
    const std::string poses = (kModels / "three_vrm" / "poses.json").string();
    const auto result =
        run({"avatar", "pose", model, "--pose", poses + "#squat", "-o", path("x.obj")});
    ASSERT_EQ(result.exit_code, 0) << result.err;
    const std::string text = read_file(path("x.obj")).value();
    EXPECT_NE(text.find("\no node68.mesh0.primitive0\nv "), std::string::npos);
    EXPECT_NE(text.find("\nf "), std::string::npos);
}

TEST_F(Avatar, pose_writes_all_joints_of_a_clip) {
    const std::string model = (kModels / "smoke_spring.vrm").string();
    const std::string clip = (kModels / "six_poses.vrma").string();
    const auto result =
        run({"avatar", "pose", model, "--motion", clip, "--time", "all", "-o", path("x.tsv")});
    ASSERT_EQ(result.exit_code, 0) << result.err;
    const std::string text = read_file(path("x.tsv")).value();
    EXPECT_EQ(text.rfind("frame\tnode\tname\tx\ty\tz\n0\t", 0), 0U);
    EXPECT_NE(text.find("\n60\t"), std::string::npos);
}

TEST_F(Avatar, what_cannot_be_posed_is_told_in_one_line) {
    const std::string model = (kModels / "smoke_spring.vrm").string();
    const std::string clip = (kModels / "test.vrma").string();
    const std::string poses = (kModels / "three_vrm" / "poses.json").string();
    expect_one_line(
        {"avatar", "pose", model, "-o", path("x.obj")}, 1, "give --pose FILE.json#NAME");
    expect_one_line({"avatar", "pose", model, "--pose", poses + "#squad", "-o", path("x.obj")},
                    1,
                    "poses.json: pose \"squad\" is unknown; did you mean \"squat\"?");
    expect_one_line({"avatar", "pose", model, "--motion", clip, "-o", path("x.png")},
                    1,
                    "a posed avatar is written as .obj or .tsv");
    expect_one_line(
        {"avatar", "pose", model, "--motion", clip, "--time", "99", "-o", path("x.obj")},
        1,
        "--time is 99, but the clip ends at");
    expect_one_line(
        {"avatar", "pose", model, "--motion", clip, "--time", "all", "-o", path("x.obj")},
        1,
        "an .obj holds one time");
    expect_one_line({"avatar", "pose", model, "--motion", model, "-o", path("x.obj")},
                    1,
                    "there is no clip in it");
}

/// Bytes of a film in a row somewhere.
bool holds(const fs::path& file, const std::string& text) {
    return read_file(file).value().find(text) != std::string::npos;
}

TEST_F(Avatar, a_character_dances_in_films_and_its_maker_is_named) {
    write_clicks("song.wav");
    give("Godette_vrm_v4.vrm", "Godette.vrm");
    const std::vector<std::string> film = {"render",
                                           path("song.wav"),
                                           "--duration",
                                           "1",
                                           "--size",
                                           "160x160",
                                           "--quality",
                                           "fast",
                                           "--as-live",
                                           "-o"};
    auto with = film;
    with.insert(with.end(), {path("with.mp4"), "--avatar", "Godette"});
    const auto result = run(with);
    ASSERT_EQ(result.exit_code, 0) << result.err;
    EXPECT_NE(result.err.find("avatar: Low-Poly Godette by SirRichard94, CC_BY (credit required)"),
              std::string::npos)
        << result.err;
    EXPECT_TRUE(holds(path("with.mp4"), "Low-Poly Godette by SirRichard94"));
    auto without = film;
    without.push_back(path("without.mp4"));
    ASSERT_EQ(run(without).exit_code, 0);
    EXPECT_FALSE(holds(path("without.mp4"), "Godette"));
    EXPECT_NE(read_file(path("with.mp4")).value(), read_file(path("without.mp4")).value());
}

TEST_F(Avatar, who_cannot_dance_is_told_in_one_line) {
    const std::vector<std::string> sheet = {
        "sheet", "--dance", "waltz", "-o", path("x.png"), "--avatar"};
    const auto message_of = [&](const std::string& avatar) {
        auto words = sheet;
        words.push_back(avatar);
        const auto result = run(words);
        EXPECT_EQ(result.exit_code, 1) << avatar;
        EXPECT_EQ(std::count(result.err.begin(), result.err.end(), '\n'), 1) << result.err;
        EXPECT_FALSE(fs::exists(path("x.png"))) << avatar;
        return result.err;
    };
    EXPECT_NE(message_of("nobody").find("nobody"), std::string::npos);
    // A bending stick, and a clip without a body.
    EXPECT_NE(message_of((kModels / "SimpleSkin.gltf").string()).find("leftUpperLeg"),
              std::string::npos);
    EXPECT_NE(message_of((kModels / "expected.tsv").string()).find("no model"), std::string::npos);
}

}  // namespace
}  // namespace raks::test
