// `raks avatar`: what is in a model, told to people and programs.
#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>
#include <nlohmann/json.hpp>
#include <sstream>
#include <string>
#include <vector>

#include "base/file.hpp"
#include "base/pending_file.hpp"
#include "tests/end_to_end/program_fixture.hpp"

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

TEST_F(Avatar, is_exported_as_vrm_once_it_is_known_whose_work_it_is) {
    give("RiggedFigure.glb", "figure.glb");
    const std::string output = path("x.vrm");
    expect_one_line({"avatar", "export", output, "--from", "figure"}, 1, "give --author NAME");
    expect_one_line({"avatar", "export", output, "--from", "figure", "--author", "Cesium"},
                    1,
                    "give --licence TEXT");
    const ProcessResult written = run({"avatar",
                                       "export",
                                       output,
                                       "--from",
                                       "figure",
                                       "--author",
                                       "Cesium",
                                       "--licence",
                                       "CC-BY-4.0"});
    EXPECT_EQ(written.exit_code, 0) << written.err;
    const ProcessResult shown = run({"avatar", "show", output, "--json"});
    ASSERT_EQ(shown.exit_code, 0) << shown.err;
    const auto json = nlohmann::json::parse(shown.out);
    EXPECT_EQ(json["format"], "VRM 1.0");
    EXPECT_EQ(json["meta"]["title"], "figure");
    EXPECT_EQ(json["meta"]["authors"], nlohmann::json({"Cesium"}));
    EXPECT_EQ(run({"avatar", "export", path("x.glb"), "--from", "figure"}).exit_code, 0);
    expect_one_line({"avatar", "export", path("x.ply"), "--from", "figure"},
                    1,
                    "x.ply: an avatar is exported as .vrm, .glb, .3ds or .obj");
}

TEST_F(Avatar, as_3ds_brings_its_pictures_and_dances_by_the_labels_beside_it) {
    give("Godette_vrm_v4.vrm", "me.vrm");
    const std::string output = path("godette.3ds");
    const ProcessResult written = run({"avatar", "export", output, "--from", "me"});
    EXPECT_EQ(written.exit_code, 0) << written.err;
    EXPECT_TRUE(fs::exists(path("godette.labels.toml")));
    EXPECT_TRUE(fs::exists(path("godett1.png")));
    const ProcessResult shown = run({"avatar", "show", output, "--json"});
    ASSERT_EQ(shown.exit_code, 0) << shown.err;
    const auto json = nlohmann::json::parse(shown.out);
    EXPECT_EQ(json["format"], "3DS v3");
    EXPECT_EQ(shown.err, "");
}

TEST_F(Avatar, export_writes_no_labels_over_those_that_it_reads) {
    fs::copy_file(kModels / "RiggedFigure.glb", path("me.glb"));
    // These are found by themselves, as they lie beside the model.
    const std::string labels =
        "format = \"raks-avatar-labels\"\nversion = 1\n[bones]\nhips = \"torso_joint_1\"\n";
    ASSERT_TRUE(write_file(path("me.labels.toml"), labels));
    expect_one_line({"avatar", "export", path("me.3ds"), "--from", path("me.glb")},
                    1,
                    "me.labels.toml: is what is to be read; write to another name");
    EXPECT_EQ(*read_file(path("me.labels.toml"), 4096), labels);
    EXPECT_FALSE(fs::exists(path("me.3ds")));
    EXPECT_EQ(run({"avatar", "export", path("you.3ds"), "--from", path("me.glb")}).exit_code, 0);
    EXPECT_TRUE(fs::exists(path("you.labels.toml")));
}

TEST_F(Avatar, the_mannequin_is_exported_where_no_other_is_named) {
    const std::string vrm = path("x.vrm");
    EXPECT_EQ(run({"avatar", "export", vrm}).exit_code, 0);
    const ProcessResult shown = run({"avatar", "show", vrm, "--json"});
    ASSERT_EQ(shown.exit_code, 0) << shown.err;
    const auto json = nlohmann::json::parse(shown.out);
    EXPECT_EQ(json["format"], "VRM 1.0");
    EXPECT_EQ(json["meta"]["title"], "Raks mannequin");
    EXPECT_EQ(run({"avatar", "export", path("x.obj")}).exit_code, 0);
    EXPECT_TRUE(fs::exists(path("x.mtl")));
    const auto mesh = read_text_file(path("x.obj"), std::size_t{64} << 20U);
    ASSERT_TRUE(mesh) << mesh.error().message;
    EXPECT_EQ(mesh->find("# Raks mannequin\nmtllib x.mtl\n"), 0U);
}

TEST_F(Avatar, that_cannot_be_read_is_told_in_one_line) {
    give("smoke_spring.vrm", "Anna.vrm");
    expect_one_line({"avatar", "show", "Ana"}, 1, "no avatar \"Ana\": neither a file nor one of");
    ASSERT_TRUE(write_file(path("x.glb"), "glTF"));
    expect_one_line(
        {"avatar", "show", path("x.glb")}, 1, "x.glb: is cut off within its header; copy it again");
    ASSERT_TRUE(write_file(path("x.fbx"), "Kaydara"));
    expect_one_line({"avatar", "show", path("x.fbx")}, 1, "x.fbx: is not FBX");
    ASSERT_TRUE(write_file(path("x.ply"), "ply"));
    expect_one_line(
        {"avatar", "show", path("x.ply")},
        1,
        "x.ply: is not a model that Raks reads; it reads .glb, .gltf, .vrm, .vrma, .3ds, .fbx, "
        ".dae and .obj");
    expect_one_line({"avatar", "show", "mannequin"}, 1, "the mannequin has no file");
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
    expect_one_line({"avatar", "pose", model, "--motion", clip, "-o", path("x.jpg")},
                    1,
                    "a posed avatar is written as .png, .obj or .tsv");
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

TEST_F(Avatar, pose_draws_a_posture_and_a_clip) {
    const std::string model = (kModels / "Godette_vrm_v4.vrm").string();
    const std::string poses = (kModels / "three_vrm" / "poses.json").string();
    const std::string clip = (kModels / "test.vrma").string();
    const auto posed = run({"avatar", "pose", model, "--pose", poses + "#T", "-o", path("a.png")});
    ASSERT_EQ(posed.exit_code, 0) << posed.err;
    const auto moved =
        run({"avatar", "pose", model, "--motion", clip, "--time", "0.2", "-o", path("b.png")});
    ASSERT_EQ(moved.exit_code, 0) << moved.err;
    EXPECT_NE(read_file(path("a.png")).value(), read_file(path("b.png")).value());
    expect_one_line(
        {"avatar", "pose", model, "--motion", clip, "--time", "all", "-o", path("c.png")},
        1,
        "a picture holds one time");
}

TEST_F(Avatar, height_makes_the_mesh_so_tall) {
    const std::string model = (kModels / "RiggedFigure.glb").string();
    const std::vector<std::string> words = {
        "avatar", "pose", model, "--motion", model, "-o", path("x.tsv"), "--height"};
    const auto height_of = [&](const std::string& height) {
        auto all = words;
        all.push_back(height);
        const auto result = run(all);
        EXPECT_EQ(result.exit_code, 0) << result.err;
        // Frame, node, name, x, y, z: the highest of the first frame.
        std::istringstream lines(read_file(path("x.tsv")).value());
        std::string line;
        double highest = 0.0;
        while (std::getline(lines, line) && (line[0] == 'f' || line.starts_with("0\t"))) {
            const std::size_t y = line.rfind('\t', line.rfind('\t') - 1);
            highest = line[0] == 'f' ? 0.0 : std::max(highest, std::stod(line.substr(y + 1)));
        }
        return highest;
    };
    EXPECT_NEAR(height_of("2.9") / height_of("1.45"), 2.0, 0.01);
    expect_one_line({"avatar", "show", model, "--height", "0"}, 2, "--height");
    const auto json =
        nlohmann::json::parse(run({"avatar", "show", model, "--height", "2", "--json"}).out);
    EXPECT_NEAR(json["dances_at_m"].get<double>(), 2.0, 1e-5);
}

TEST_F(Avatar, show_tells_what_a_face_moves) {
    const std::string model = (kModels / "sphere.vrm").string();
    const auto json = nlohmann::json::parse(
        run({"avatar", "show", model, "--json", "--expression", "happy=1,blink=0.5"}).out);
    ASSERT_TRUE(json["morph_weights"].is_array());
    for (const auto& weight : json["morph_weights"]) {
        EXPECT_TRUE(weight["node"].is_number_integer());
        EXPECT_TRUE(weight["target"].is_number_integer());
        EXPECT_GT(weight["weight"].get<double>(), 0.0);
    }
    expect_one_line({"avatar", "show", model, "--expression", "hapy=1"},
                    1,
                    "expression \"hapy\" is unknown; did you mean \"happy\"?");
    expect_one_line({"avatar", "show", model, "--expression", "happy=2"},
                    1,
                    "happy is \"2\", must be a number from 0 to 1");
    expect_one_line({"avatar", "show", model, "--expression", "happy"}, 1, "must be like happy=1");
    expect_one_line(
        {"avatar", "show", (kModels / "RiggedFigure.glb").string(), "--expression", "happy=1"},
        1,
        "the model has no expressions");
}

TEST_F(Avatar, show_draws_a_thumbnail) {
    for (const char* name : {"Godette_vrm_v4.vrm", "SimpleSkin.gltf"}) {
        const auto result =
            run({"avatar", "show", (kModels / name).string(), "--thumbnail", path("x.png")});
        ASSERT_EQ(result.exit_code, 0) << result.err;
        EXPECT_EQ(read_file(path("x.png")).value().substr(1, 3), "PNG");
    }
    const std::string clip = (kModels / "test.vrma").string();
    expect_one_line({"avatar", "show", clip, "--thumbnail", path("y.png")},
                    1,
                    "there is nothing in it to draw");
    expect_one_line({"avatar", "show", clip, "--thumbnail", path("y.jpg")},
                    1,
                    "a thumbnail is written as .png");
}

TEST_F(Avatar, the_mannequin_is_dressed_for_the_dance) {
    write_clicks("song.wav");
    const auto filmed = [&](const std::string& dress) {
        const auto result = run({"render",
                                 path("song.wav"),
                                 "-o",
                                 path(dress) + "/",
                                 "--dance",
                                 "hiphop",
                                 "--dress",
                                 dress,
                                 "--size",
                                 "64x64",
                                 "--quality",
                                 "fast",
                                 "--duration",
                                 "0.1",
                                 "--fps",
                                 "10"});
        EXPECT_EQ(result.exit_code, 0) << result.err;
        const auto pictures = list_folder(path(dress));
        EXPECT_TRUE(pictures && !pictures->empty());
        return pictures ? read_file(pictures->front()).value_or(dress) : dress;
    };
    const std::string by_dance = filmed("auto");
    EXPECT_EQ(by_dance, filmed("street"));
    EXPECT_NE(by_dance, filmed("dancer"));
    expect_one_line(
        {"sheet", "--dance", "hiphop", "--dress", "pyjamas", "-o", path("x.png")}, 2, "pyjamas");
}

TEST_F(Avatar, that_is_not_there_or_cannot_be_seen_is_refused_by_every_command) {
    write_clicks("song.wav", 1.0);
    const std::string song = path("song.wav");
    const std::string motion = (kModels / "six_poses.vrma").string();
    const std::vector<std::vector<std::string>> commands = {
        {"dance", song, "-o", path("x.bvh")},
        {"dance", song, "-o", path("x.vrma")},
        {"dance", song, "-o", path("x.glb")},
        {"render", song, "-o", path("x.mp4"), "--size", "64x64"},
        {"sheet", "--dance", "waltz", "-o", path("x.png")},
        {"play", song, "--headless", "--no-sound"},
        {"live", "--headless", "--duration", "1"}};
    for (const std::vector<std::string>& command : commands) {
        SCOPED_TRACE(command.front() + " " + command.back());
        const auto with = [&](const char* option, const std::string& value) {
            auto whole = command;
            whole.insert(whole.end(), {option, value});
            return whole;
        };
        expect_one_line(with("--avatar", "nosuch"), 1, "no avatar \"nosuch\": neither a file nor");
        expect_one_line(with("--labels", path("nosuch")), 1, "nosuch: ");
        if (command.front() != "live") {  // there is no input that it could listen to
            expect_one_line(
                with("--avatar", motion), 1, "six_poses.vrma: has bones, but no surface to draw");
        }
    }
    expect_one_line({"avatar", "export", path("x.obj"), "--labels", path("nosuch")}, 1, "nosuch: ");
    EXPECT_EQ(files(), std::vector<std::string>{"song.wav"});
}

TEST_F(Avatar, too_large_for_the_memory_is_said_in_one_line) {
    give("smoke_spring.vrm", "Anna.vrm");
    // A graphics driver may crash where it gets no memory, as it does not check whether it did.
    for (const long megabytes : {250, 270, 290, 350, 430, 490, 570, 610, 650}) {
        ProcessPlan little = plan({"xbody", "Anna", "-o", path("x.png")});
        little.address_space_limit = megabytes << 20;
        const ProcessResult result = run_process(little);
        EXPECT_FALSE(result.timed_out);
        EXPECT_TRUE(result.exit_code == 0 ||
                    (result.exit_code == 1 && is_one_error_line(result.err)))
            << megabytes << " MB: " << result.exit_code << " " << result.err;
    }
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
                                           "0.4",
                                           "--size",
                                           "96x96",
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

TEST_F(Avatar, several_are_worn_in_turn_by_as_many_dancers) {
    write_clicks("song.wav");
    give("Godette_vrm_v4.vrm", "Godette.vrm");
    const auto film_with = [&](const std::string& name, const std::vector<std::string>& words) {
        std::vector<std::string> film = {"render",
                                         path("song.wav"),
                                         "--duration",
                                         "0.2",
                                         "--size",
                                         "160x96",
                                         "--quality",
                                         "fast",
                                         "--as-live",
                                         "--dance",
                                         "salsa",
                                         "--camera",
                                         "front",
                                         "-o",
                                         path(name)};
        film.insert(film.end(), words.begin(), words.end());
        const auto result = run(film);
        EXPECT_EQ(result.exit_code, 0) << result.err;
        return read_file(path(name) + "/000001.png").value_or("");
    };
    const auto alike = film_with("alike", {"--dancers", "2"});
    const auto mixed = film_with("mixed", {"--avatar", "mannequin", "--avatar", "Godette"});
    const auto turned = film_with("turned", {"--avatar", "Godette", "--avatar", "mannequin"});
    ASSERT_FALSE(alike.empty() || mixed.empty() || turned.empty());
    EXPECT_NE(alike, mixed);
    EXPECT_NE(mixed, turned);
    EXPECT_EQ(alike, film_with("same", {"--avatar", "mannequin", "--dancers", "2"}));
}

TEST_F(Avatar, the_music_lies_beside_a_figure_that_dances_to_it) {
    write_clicks("song.wav");
    fs::create_directory(path("out"));
    const std::vector<std::string> dance = {"dance", path("song.wav"), "-o", path("out/x.glb")};
    const auto result = run(dance);
    ASSERT_EQ(result.exit_code, 0) << result.err;
    EXPECT_TRUE(holds(path("out/x.glb"), "song.wav"));
    EXPECT_EQ(read_file(path("out/song.wav")).value(), read_file(path("song.wav")).value());
    ASSERT_TRUE(write_file(path("out/song.wav"), "mine"));
    const auto again = run(dance);
    EXPECT_EQ(again.exit_code, 0);
    EXPECT_NE(again.err.find("song.wav: lies there already"), std::string::npos) << again.err;
    EXPECT_EQ(read_file(path("out/song.wav")).value(), "mine");
}

TEST_F(Avatar, one_of_several_that_cannot_be_read_is_told_in_one_line) {
    write_clicks("song.wav");
    give("Godette_vrm_v4.vrm", "Godette.vrm");
    ASSERT_TRUE(write_file(path("bad.glb"), "glTF"));
    const std::vector<std::string> film = {
        "render", path("song.wav"), "-o", path("x.mp4"), "--avatar", "Godette", "--avatar"};
    auto broken = film;
    broken.push_back(path("bad.glb"));
    expect_one_line(broken, 1, "bad.glb: is cut off within its header; copy it again");
    ASSERT_TRUE(write_file(path("x.toml"),
                           "format = \"raks-avatar-labels\"\nversion = 1\n[bones]\n"
                           "hips = \"Hips\"\n"));
    auto labelled = film;
    labelled.insert(labelled.end(), {"mannequin", "--labels", path("x.toml")});
    expect_one_line(labelled, 1, "--labels says which nodes are the bones of one avatar");
    EXPECT_FALSE(fs::exists(path("x.mp4")));
    expect_one_line({"render", "-o", path("x.mp4"), "--dancers", "33"},
                    2,
                    "dance.dancers is 33, must be 0 to 32");
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
    EXPECT_NE(message_of((kModels / "expected.tsv").string()).find("is not a model"),
              std::string::npos);
}

}  // namespace
}  // namespace raks::test
