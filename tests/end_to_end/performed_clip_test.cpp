// `--motion`: a clip in the place of a dance, in films, sheets and while music plays.
#include <gtest/gtest.h>

#include <filesystem>
#include <string>
#include <vector>

#include "base/file.hpp"
#include "base/pending_file.hpp"
#include "tests/end_to_end/program_fixture.hpp"

namespace raks::test {
namespace {

namespace fs = std::filesystem;

const fs::path kClipModels = fs::path(RAKS_SOURCE_DIR) / "tests" / "data" / "avatars";

class PerformedClip : public ProgramTest {};

TEST_F(PerformedClip, is_danced_by_an_avatar_in_a_dances_place) {
    write_clicks("song.wav");
    const std::string clip = (kClipModels / "six_poses.vrma").string();
    const std::string model = (kClipModels / "Godette_vrm_v4.vrm").string();
    const std::vector<std::string> film = {"render",
                                           "--motion",
                                           clip,
                                           "--avatar",
                                           model,
                                           "--size",
                                           "96x96",
                                           "--fps",
                                           "10",
                                           "--quality",
                                           "fast",
                                           "-o"};
    auto silent = film;
    silent.push_back(path("silent.mp4"));
    const auto result = run(silent);
    ASSERT_EQ(result.exit_code, 0) << result.err;
    auto sounding = film;
    sounding.insert(sounding.end(), {path("song.mp4"), path("song.wav"), "--duration", "0.4"});
    const auto other = run(sounding);
    ASSERT_EQ(other.exit_code, 0) << other.err;
    EXPECT_TRUE(fs::exists(path("song.mp4")));
    const auto sheet = run({"sheet", "--motion", clip, "--avatar", model, "-o", path("x.png")});
    ASSERT_EQ(sheet.exit_code, 0) << sheet.err;
    expect_one_line({"sheet", "--motion", model, "-o", path("y.png")}, 1, "there is no clip in it");
    expect_one_line({"render", "--motion", path("no.vrma"), "-o", path("y.mp4")}, 1, "no.vrma");
}

TEST_F(PerformedClip, goes_by_the_music_that_plays) {
    write_clicks("song.wav");
    const std::string clip = (kClipModels / "six_poses.vrma").string();
    const std::vector<std::string> play = {
        "play", path("song.wav"), "--headless", "--no-sound", "--duration", "0.3", "--motion"};
    const auto with = [&](std::vector<std::string> more) {
        std::vector<std::string> all = play;
        all.insert(all.end(), more.begin(), more.end());
        return all;
    };
    const auto by_beat = run(with({clip}));
    ASSERT_EQ(by_beat.exit_code, 0) << by_beat.err;
    EXPECT_NE(by_beat.err.find("performing six_poses.vrma: "), std::string::npos) << by_beat.err;
    const auto several = run(with({(kClipModels / "kenney_character.glb").string()}));
    EXPECT_NE(several.err.find("holds 4 clips; the first, \"static\", is read"), std::string::npos)
        << several.err;
    const auto by_song = run(with({clip, "--offset", "1.5", "--no-loop"}));
    ASSERT_EQ(by_song.exit_code, 0) << by_song.err;
    EXPECT_NE(by_song.err.find("from 1.50 s of the song on, once"), std::string::npos)
        << by_song.err;
    expect_one_line(with({path("no.vrma")}), 1, "no.vrma");
    EXPECT_EQ(run(with({clip, "--loop", "--no-loop"})).exit_code, 2);
    EXPECT_EQ(run(with({clip, "--sync", "bars"})).exit_code, 2);
    EXPECT_EQ(run({"play", path("song.wav"), "--headless", "--loop"}).exit_code, 2);
}

TEST_F(PerformedClip, for_mikumikudance_is_seen_by_its_camera) {
    write_clicks("song.wav", 1.0);
    const auto danced = run({"dance", path("song.wav"), "--dance", "waltz", "-o", path("x.vmd")});
    ASSERT_EQ(danced.exit_code, 0) << danced.err;
    const fs::path corpus = fs::path(RAKS_SOURCE_DIR) / "tests" / "fuzz" / "corpus" / "vmd";
    const std::string camera = (corpus / "camera.vmd").string();
    const auto filmed = [&](const std::string& folder, const std::vector<std::string>& more) {
        std::vector<std::string> words = {"render", "--motion", path("x.vmd"), "-o"};
        words.insert(words.end(), {path(folder) + "/", "--size", "64x64", "--quality", "fast"});
        words.insert(words.end(), {"--duration", "0.1", "--fps", "10"});
        words.insert(words.end(), more.begin(), more.end());
        const auto result = run(words);
        EXPECT_EQ(result.exit_code, 0) << result.err;
        const auto pictures = list_folder(path(folder));
        EXPECT_TRUE(pictures && !pictures->empty());
        return pictures ? read_file(pictures->front()).value_or(folder) : folder;
    };
    EXPECT_NE(filmed("plain", {}), filmed("seen", {"--camera-motion", camera}));
    const std::string output = path("y.mp4");
    expect_one_line({"render", "--motion", camera, "-o", output}, 1, "give it as --camera-motion");
    expect_one_line({"render", path("song.wav"), "--camera-motion", path("x.vmd"), "-o", output},
                    1,
                    "moves no camera, but a body; give it as --motion");
    expect_one_line(
        {"render", "--motion", path("x.vmd"), "--arm-angle", "91", "-o", output}, 2, "--arm-angle");
    ASSERT_TRUE(write_file(path("x.pmx"), "PMX "));
    expect_one_line({"avatar", "show", path("x.pmx")}, 1, "convert it to VRM");
    expect_one_line({"stick", path("x.pmx")}, 1, "convert it to VRM");
}

}  // namespace
}  // namespace raks::test
