// raks stick without a display: sheets of clips, and what it refuses. raks sheet: a film.
#include <gtest/gtest.h>

#include <cmath>
#include <nlohmann/json.hpp>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "base/file.hpp"
#include "base/pending_file.hpp"
#include "tests/end_to_end/program_fixture.hpp"

namespace raks::test {
namespace {

namespace fs = std::filesystem;

class Stick : public ProgramTest {
 protected:
    void SetUp() override { draw_small_pictures(); }
    [[nodiscard]] static std::string clip(const std::string& name) {
        return (fs::path(RAKS_SOURCE_DIR) / "tests" / "data" / "bvh" / name).string();
    }
    [[nodiscard]] std::string picture(const std::string& name) const {
        return read_file(folder_ / name).value_or("");
    }
};

TEST_F(Stick, draws_front_and_side_of_the_whole_clip) {
    const ProcessResult result =
        run({"stick", clip("odd/plain.bvh"), "-o", path("sheet.png"), "--scale", "0.01"});
    ASSERT_EQ(result.exit_code, 0) << result.err;
    EXPECT_TRUE(is_one_error_line(result.err)) << result.err;
    EXPECT_NE(result.err.find("plain.bvh: drawn as it is: no humanoid: legs, arms not found"),
              std::string::npos)
        << result.err;
    EXPECT_EQ(result.out,
              path("sheet.png") + ": front and side of frames 0 1 2 3 4 5 6 7 8 9 10 11\n");
    EXPECT_EQ(picture("sheet.png").substr(1, 3), "PNG");
}

TEST_F(Stick, writes_a_map_of_joints_that_it_reads_again) {
    ASSERT_EQ(run({"synth", "-o", path("song.wav"), "--duration", "2"}).exit_code, 0);
    ASSERT_EQ(run({"dance", path("song.wav"), "-o", path("danced.bvh")}).exit_code, 0);
    const ProcessResult written =
        run({"stick", path("danced.bvh"), "--write-joints", path("map.toml"), "--scale", "1"});
    ASSERT_EQ(written.exit_code, 0) << written.err;
    EXPECT_EQ(written.out,
              path("map.toml") + ": which joint is which bone; mend it and give it to --joints\n");
    const auto look = [&](const std::vector<std::string>& more) {
        std::vector<std::string> words = {
            "stick", path("danced.bvh"), "--write-joints", path("again.toml"), "--scale", "1"};
        words.insert(words.end(), more.begin(), more.end());
        return run(words);
    };
    ASSERT_EQ(look({"--joints", path("map.toml")}).exit_code, 0);
    EXPECT_EQ(picture("again.toml"), picture("map.toml"));
    const ProcessResult wrong =
        look({"--joints", path("map.toml"), "--joint", "head=leftHnd", "--joint", "hips=hips"});
    EXPECT_EQ(wrong.exit_code, 1);
    EXPECT_TRUE(is_one_error_line(wrong.err)) << wrong.err;
    EXPECT_NE(wrong.err.find("did you mean \"leftHand\"?"), std::string::npos) << wrong.err;
}

TEST_F(Stick, draws_one_frame_large_at_the_size_asked_for) {
    const auto frame = [&](const char* name, const char* scale, const char* number) {
        const ProcessResult result = run({"stick",
                                          clip("odd/plain.bvh"),
                                          "-o",
                                          path(name),
                                          "--frame",
                                          number,
                                          "--scale",
                                          scale});
        EXPECT_EQ(result.exit_code, 0) << result.err;
        return picture(name);
    };
    const std::string first = frame("first.png", "0.01", "0");
    EXPECT_FALSE(first.empty());
    EXPECT_TRUE(frame("again.png", "0.01", "0") == first);
    EXPECT_FALSE(frame("large.png", "0.02", "0") == first);
    EXPECT_FALSE(frame("later.png", "0.01", "5") == first);
}

TEST_F(Stick, draws_a_sheet_where_there_is_no_display) {
    ProcessPlan here = plan({"stick", clip("odd/plain.bvh"), "--frame", "3"});
    here.folder = folder_.path();
    const ProcessResult result = run_process(here);
    EXPECT_EQ(result.exit_code, 0) << result.err;
    EXPECT_EQ(result.out, "plain.png: front and side of frames 3\n");
    EXPECT_NE(result.err.find("no display"), std::string::npos) << result.err;
    EXPECT_FALSE(picture("plain.png").empty());
}

TEST_F(Stick, draws_a_written_dance_and_tells_what_is_wrong_with_it) {
    const std::string dance =
        (fs::path(RAKS_SOURCE_DIR) / "config" / "choreographies" / "waltz.toml").string();
    const ProcessResult good =
        run({"stick", dance, "--figure", "balance", "--tempo", "100", "-o", path("sheet.png")});
    ASSERT_EQ(good.exit_code, 0) << good.err;
    EXPECT_EQ(good.out, path("sheet.png") + ": front and side of balance, eighths of a beat\n");
    EXPECT_EQ(picture("sheet.png").substr(1, 3), "PNG");
    ASSERT_TRUE(write_file(folder_ / "bad.toml",
                           "format = \"raks-choreography\"\nversion = 1\ndance = \"x\"\n"
                           "tempo = [90, 90, 90]\n[[figure]]\nname = \"f\"\nbeats = 0\n"));
    for (const char* const command : {"stick", "train"}) {
        std::vector<std::string> words = {command};
        if (words[0] == "train") {
            words.emplace_back("figure");
        }
        words.insert(words.end(), {path("bad.toml"), "-o", path("x.png")});
        const ProcessResult bad = run(words);
        EXPECT_EQ(bad.exit_code, 1);
        EXPECT_TRUE(is_one_error_line(bad.err)) << bad.err;
        EXPECT_NE(bad.err.find("bad.toml: line 7: figure \"f\": beats is 0, must be 1 to 64"),
                  std::string::npos)
            << bad.err;
    }
}

TEST_F(Stick, refuses_in_one_line_what_is_no_clip) {
    ASSERT_TRUE(write_file(folder_ / "clip.x3d", "X3D"));
    const std::vector<std::pair<std::vector<std::string>, std::string>> cases = {
        {{path("none.bvh")}, "none.bvh"},
        {{path("clip.x3d")}, "is not a motion file of a known kind; known: BVH, "},
        {{clip("odd/plain.bvh"), "--frame", "12"}, "has no frame 12, its last is 11"},
        {{clip("odd/plain.bvh"), "-o", path("x.jpg")}, "cannot write this kind of picture"},
        {{clip("odd/plain.bvh"), "--rate", "0"}, "--rate 0 would stand still"},
        {{clip("odd/plain.bvh"), "--edges", "auto"}, "has a hierarchy, which joins its joints"},
        {{clip("bad/frame_time_zero.bvh")}, "give the rate with --fps"},
    };
    for (const auto& [arguments, part] : cases) {
        std::vector<std::string> command = {"stick"};
        command.insert(command.end(), arguments.begin(), arguments.end());
        const ProcessResult result = run(command);
        EXPECT_EQ(result.exit_code, 1) << part;
        EXPECT_TRUE(is_one_error_line(result.err)) << result.err;
        EXPECT_NE(result.err.find(part), std::string::npos) << result.err;
    }
    for (const auto& wrong :
         std::vector<std::vector<std::string>>{{"stick"},
                                               {"stick", clip("odd/plain.bvh"), "--fps", "0"},
                                               {"stick", clip("odd/plain.bvh"), "--scale", "-1"},
                                               {"stick", clip("odd/plain.bvh"), "--frame", "-1"}}) {
        EXPECT_EQ(run(wrong).exit_code, 2) << wrong.back();
    }
}

TEST_F(Stick, refuses_every_bad_file_in_one_line) {
    for (const auto& entry : fs::directory_iterator(clip("bad"))) {
        const ProcessResult result =
            run({"stick", entry.path().string(), "-o", path("never.png"), "--frame", "0"});
        EXPECT_EQ(result.exit_code, 1) << entry.path();
        EXPECT_TRUE(is_one_error_line(result.err)) << result.err;
    }
    EXPECT_FALSE(fs::exists(folder_ / "never.png"));
}

TEST_F(Stick, draws_what_is_odd_whether_humanoid_or_not) {
    for (const char* name : {"six_channels", "two_roots", "one_frame", "two_joints", "names"}) {
        const ProcessResult result = run({"stick",
                                          clip(std::string("odd/") + name + ".bvh"),
                                          "-o",
                                          path("odd.png"),
                                          "--frame",
                                          "0"});
        EXPECT_EQ(result.exit_code, 0) << name << ": " << result.err;
    }
}

TEST_F(Stick, draws_skeletons_and_points_of_other_formats) {
    const fs::path tests = fs::path(RAKS_SOURCE_DIR) / "tests";
    // A skeleton and its motion lie in one file of the fuzzer's.
    const std::string both = read_file(tests / "fuzz/corpus/acclaim/two_bones.txt").value();
    const std::size_t cut = both.find("%%\n");
    ASSERT_TRUE(write_file(folder_ / "x.asf", both.substr(0, cut)));
    ASSERT_TRUE(write_file(folder_ / "y.amc", both.substr(cut + 3)));
    const std::vector<std::pair<std::vector<std::string>, std::string>> cases = {
        {{path("y.amc"), "--skeleton", path("x.asf")},
         "says no frame rate: 120 a second are taken (--fps sets it)"},
        {{(tests / "fuzz/corpus/smpl_npz/amass.npz").string()}, ""},
        {{(tests / "fuzz/corpus/c3d/intel_float.c3d").string()},
         "1 of its points are angles, forces or the like and left out"},
        {{(tests / "data/avatars/kenney_character.glb#walk").string()}, ""},
    };
    for (const auto& [arguments, part] : cases) {
        std::vector<std::string> command = {"stick", "--frame", "1", "-o", path("x.png")};
        command.insert(command.end(), arguments.begin(), arguments.end());
        const ProcessResult result = run(command);
        EXPECT_EQ(result.exit_code, 0) << arguments[0] << ": " << result.err;
        EXPECT_NE(result.err.find(part), std::string::npos) << result.err;
        EXPECT_EQ(picture("x.png").substr(1, 3), "PNG");
        fs::remove(path("x.png"));
    }
    // Points cannot be learnt from.
    ASSERT_TRUE(write_file(folder_ / "labels.tsv",
                           "take\trole\tstart\tend\tfigure\tbeats\tconfidence\tsplit\n"
                           "two\tlead\t0\t64\tbasic\t8\t1\ttrain\n"));
    const ProcessResult points = run({"train",
                                      "figure",
                                      (tests / "fuzz/corpus/trc/two.trc").string(),
                                      "--labels",
                                      path("labels.tsv"),
                                      "-o",
                                      path("x.json")});
    EXPECT_EQ(points.exit_code, 1);
    EXPECT_TRUE(is_one_error_line(points.err)) << points.err;
    EXPECT_NE(points.err.find("holds 2 points, but joints are needed here"), std::string::npos)
        << points.err;
}

// Four points, the knee unseen in the middle.
constexpr std::string_view kPoints =
    "time,RHip_x,RHip_y,RHip_z,RKnee_x,RKnee_y,RKnee_z,RAnkle_x,RAnkle_y,RAnkle_z,hat_x,hat_y,"
    "hat_z\n"
    "0.00,0,0.9,0,0,0.5,0,0,0.1,0,0,1.7,0\n"
    "0.02,0,0.9,0,,,,0,0.1,0.1,0.1,1.7,0\n"
    "0.04,0,0.9,0,0,0.5,0,0,0.1,0.2,0.2,1.7,nan\n";

class StickPoints : public Stick {
 protected:
    void SetUp() override {
        Stick::SetUp();
        ASSERT_TRUE(write_file(folder_ / "p.csv", std::string(kPoints)));
    }
};

TEST_F(StickPoints, are_joined_as_a_file_says_and_what_it_names_wrongly_is_said) {
    ASSERT_TRUE(write_file(folder_ / "good.txt", "RHip RKnee\nRKnee RAnkle # shin\n"));
    ASSERT_TRUE(write_file(folder_ / "partly.txt", "RHip RKnee\nRKne RAnkle\n"));
    const auto edges_of = [&](const char* file, int exit_code) {
        const ProcessResult result =
            run({"stick", path("p.csv"), "--edges", path(file), "--scale", "1", "--json"});
        EXPECT_EQ(result.exit_code, exit_code) << result.err;
        const auto document = nlohmann::json::parse(result.out);
        EXPECT_EQ(document.at("points").at(1).at("seen"), 2);
        return std::pair{document.at("edges").size(), result.err};
    };
    EXPECT_EQ(edges_of("good.txt", 0).first, 2U);
    const auto [edges, said] = edges_of("partly.txt", 3);
    EXPECT_EQ(edges, 1U);
    EXPECT_NE(said.find("partly.txt: point \"RKne\" is unknown; did you mean \"RKnee\"?"),
              std::string::npos)
        << said;
    EXPECT_NE(said.find("partly.txt: 1 of 2 edges are left out"), std::string::npos) << said;
}

TEST_F(StickPoints, have_edges_of_known_sets_and_guessed_ones) {
    for (const auto& [edges, count] : {std::pair{"body25", 2U}, std::pair{"auto", 1U}}) {
        const ProcessResult result =
            run({"stick", path("p.csv"), "--edges", edges, "--scale", "1", "--json"});
        ASSERT_EQ(result.exit_code, 0) << result.err;
        EXPECT_GE(nlohmann::json::parse(result.out).at("edges").size(), count) << edges;
    }
    const ProcessResult drawn = run(
        {"stick", path("p.csv"), "--edges", "body25", "--scale", "1", "-o", path("points.png")});
    EXPECT_EQ(drawn.exit_code, 0) << drawn.err;
    EXPECT_EQ(picture("points.png").substr(1, 3), "PNG");
}

TEST_F(StickPoints, refuse_edges_that_are_none_in_one_line) {
    ASSERT_TRUE(write_file(folder_ / "one.txt", "RHip\n"));
    ASSERT_TRUE(write_file(folder_ / "empty.txt", ""));
    ASSERT_TRUE(write_file(folder_ / "binary.txt", std::string("\x7f\x45\x4c\x46\0\1\2", 7)));
    ASSERT_TRUE(write_file(folder_ / "huge.txt", std::string(std::size_t{2} << 20U, 'a')));
    const std::vector<std::pair<std::string, std::string>> cases = {
        {path("none.txt"), "none.txt"},
        {path("one.txt"), "one.txt: line 1: 1 name, must be two"},
        {path("empty.txt"), "empty.txt: has no edges"},
        {path("binary.txt"), "binary.txt"},
        {path("huge.txt"), "huge.txt"},
        {"coco25", "coco25"},
    };
    for (const auto& [edges, part] : cases) {
        const ProcessResult result = run(
            {"stick", path("p.csv"), "--edges", edges, "--scale", "1", "-o", path("never.png")});
        EXPECT_EQ(result.exit_code, 1) << edges;
        EXPECT_TRUE(is_one_error_line(result.err)) << result.err;
        EXPECT_NE(result.err.find(part), std::string::npos) << result.err;
    }
    EXPECT_FALSE(fs::exists(folder_ / "never.png"));
}

TEST_F(StickPoints, of_two_motions_are_compared_by_name) {
    std::string moved(kPoints);
    // The ankle 0.3 m aside in the last frame.
    moved.replace(moved.rfind("0,0.1,0.2"), 9, "0.3,0.1,0.2");
    ASSERT_TRUE(write_file(folder_ / "q.csv", moved));
    const std::vector<std::string> both = {
        "stick", path("p.csv"), path("q.csv"), "--scale", "1", "--up", "y"};
    const auto with = [&](const std::vector<std::string>& more) {
        std::vector<std::string> words = both;
        words.insert(words.end(), more.begin(), more.end());
        return run(words);
    };
    const ProcessResult json = with({"--json"});
    ASSERT_EQ(json.exit_code, 0) << json.err;
    const auto document = nlohmann::json::parse(json.out);
    EXPECT_EQ(document.at("worst_point"), "RAnkle");
    EXPECT_EQ(document.at("worst_frame"), 2);
    // Of ten places that both see one is 0.3 m off.
    EXPECT_NEAR(document.at("rms").get<double>(), std::sqrt(0.09 / 10.0), 1e-9);
    EXPECT_TRUE(document.at("points").at(1).at("distance").at(1).is_null());
    for (const char* const arrangement : {"--names", "--side-by-side"}) {
        const ProcessResult drawn = with({arrangement, "-o", path("two.png")});
        ASSERT_EQ(drawn.exit_code, 0) << drawn.err;
        EXPECT_NE(drawn.out.find("worst point RAnkle: 173.2 mm; worst frame 2"), std::string::npos)
            << drawn.out;
        EXPECT_EQ(picture("two.png").substr(1, 3), "PNG");
    }
    const ProcessResult hips = with({"--align", "hips", "--json"});
    EXPECT_EQ(hips.exit_code, 1);
    EXPECT_TRUE(is_one_error_line(hips.err)) << hips.err;
    EXPECT_NE(hips.err.find("has no hips to align by"), std::string::npos) << hips.err;
    EXPECT_EQ(with({"--align", "rigid", "--json"}).exit_code, 0);
    // Another skeleton's joints have other names.
    const ProcessResult strangers =
        run({"stick", path("p.csv"), clip("odd/plain.bvh"), "--scale", "1", "--json"});
    EXPECT_EQ(strangers.exit_code, 1);
    EXPECT_NE(strangers.err.find("the two motions have no point of the same name"),
              std::string::npos)
        << strangers.err;
}

TEST_F(StickPoints, and_clips_are_filmed) {
    const std::vector<std::string> film = {"stick",
                                           path("p.csv"),
                                           "--scale",
                                           "1",
                                           "--size",
                                           "320x240",
                                           "--names",
                                           "--trails",
                                           "--quality",
                                           "fast",
                                           "-o"};
    const auto filmed = [&](const std::string& output, const std::vector<std::string>& more) {
        std::vector<std::string> words = film;
        words.push_back(path(output));
        words.insert(words.end(), more.begin(), more.end());
        return run(words);
    };
    const ProcessResult folder = filmed("frames", {});
    ASSERT_EQ(folder.exit_code, 0) << folder.err;
    EXPECT_EQ(folder.out, path("frames") + ": 3 pictures, 50 a second\n");
    EXPECT_EQ(picture("frames/000003.png").substr(1, 3), "PNG");
    EXPECT_FALSE(picture("frames/000001.png") == picture("frames/000003.png"));
    ASSERT_EQ(filmed("back", {"--rate=-1"}).exit_code, 0);
    EXPECT_FALSE(picture("back/000001.png").empty());
    EXPECT_EQ(filmed("x.avi", {}).exit_code, 0);
    EXPECT_EQ(picture("x.avi").substr(0, 4), "RIFF");
}

using Sheet = Stick;

TEST_F(Sheet, films_sixteen_beats_of_a_figure) {
    const ProcessResult result = run({"sheet",
                                      "--dance",
                                      "rock",
                                      "--figure",
                                      "pogo",
                                      "--bpm",
                                      "165",
                                      "--fps",
                                      "4",
                                      "--quality",
                                      "fast",
                                      "-o",
                                      path("film")});
    ASSERT_EQ(result.exit_code, 0) << result.err;
    // 16 beats last 5.8 s.
    EXPECT_EQ(picture("film/000001.png").substr(1, 3), "PNG");
    EXPECT_FALSE(picture("film/000023.png").empty());
    EXPECT_TRUE(picture("film/000024.png").empty());
    EXPECT_FALSE(picture("film/000001.png") == picture("film/000003.png"));
}

}  // namespace
}  // namespace raks::test
