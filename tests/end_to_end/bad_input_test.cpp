#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <string>
#include <utility>

#include "audio/io/wav_writer.hpp"
#include "audio/music/generator/music_generator.hpp"
#include "base/file.hpp"
#include "base/pending_file.hpp"
#include "motion/skeleton/formats/bvh.hpp"
#include "motion/skeleton/skeleton.hpp"
#include "tests/end_to_end/program_fixture.hpp"

namespace raks::test {
namespace {

class BadInput : public ProgramTest {
 protected:
    void write(const std::string& name, const std::string& bytes) const {
        ASSERT_TRUE(write_file(path(name), bytes));
    }
};

TEST_F(BadInput, files_that_are_no_music_are_refused_by_every_command) {
    write("empty.wav", "");
    write("text.mp3", "this is not music\n");
    std::filesystem::create_directory(folder_ / "folder.wav");
    std::filesystem::copy_file(RAKS_PROGRAM, folder_ / "program.mp3");
    write("other_riff.mp3", "RIFF\x64\x01\x01\x01sfbkLIST" + std::string(100'000, '\xff'));
    const struct {
        const char* file;
        const char* part;
    } cases[] = {
        {"program.mp3", "is not audio"},
        {"other_riff.mp3", "not"},
        {"missing.wav", "No such file"},
        {"empty.wav", "empty"},
        {"text.mp3", "not"},
        {"folder.wav", "folder"},
    };
    for (const auto& c : cases) {
        const std::string file = path(c.file);
        expect_one_line({"analyze", file, "--json"}, 1, c.part);
        expect_one_line({"dance", file, "-o", path("x.bvh")}, 1, c.part);
        expect_one_line({"render", file, "-o", path("x.mp4")}, 1, c.part);
    }
    EXPECT_EQ(files(),
              (std::vector<std::string>{
                  "empty.wav", "folder.wav", "other_riff.mp3", "program.mp3", "text.mp3"}));
}

TEST_F(BadInput, a_file_of_no_length_is_played_and_has_nothing_to_draw) {
    ASSERT_TRUE(audio::write_wav(path("zero.wav"), {}, 2, SampleRate(48'000)));
    expect_one_line({"dance", path("zero.wav"), "-o", path("x.bvh")}, 1, "no poses");
    expect_one_line({"render", path("zero.wav"), "-o", path("x.mp4")}, 1, "no picture");
    EXPECT_EQ(run({"play", path("zero.wav"), "--headless", "--no-sound"}).exit_code, 0);
    EXPECT_EQ(run({"analyze", path("zero.wav"), "--json"}).exit_code, 0);
    EXPECT_EQ(files(), std::vector<std::string>{"zero.wav"});
}

TEST_F(BadInput, wrong_usage_is_exit_code_2) {
    write_clicks("music.wav");
    const std::string music = path("music.wav");
    expect_one_line({"dnace", music}, 2, "dnace");
    expect_one_line({"analyze"}, 2, "file");
    expect_one_line({"render", music}, 2, "out");
    expect_one_line({"render", music, "-o", path("x.mp4"), "--fps", "0"}, 2, "fps");
    expect_one_line({"render", music, "-o", path("x.mp4"), "--size", "big"}, 2, "picture size");
    expect_one_line({"render", music, "-o", path("x.mp4"), "--backdrop", "red"}, 2, "#00ff00");
    expect_one_line(
        {"render", music, "-o", path("x.mov"), "--alpha", "--backdrop", "stage"}, 2, "--alpha");
    expect_one_line({"play", music, "--seed", "-1"}, 2, "seed");
    expect_one_line({"dance", music, "-o", path("x.bvh"), "--fps", "1e9"}, 2, "fps");
    expect_one_line({"bench", "hearing"}, 2, "hearing");
    expect_one_line({"train", "report", music, "--labels", music, "--role", "boss"}, 2, "boss");
    expect_one_line({"train", "report", music, "--most-states", "1"}, 2, "most-states");
    EXPECT_EQ(files(), std::vector<std::string>{"music.wav"});
}

TEST_F(BadInput, outputs_that_cannot_be_written_leave_nothing) {
    write_clicks("music.wav");
    const std::string music = path("music.wav");
    expect_one_line({"dance", music, "-o", path("x.xyz")}, 1, ".bvh");
    expect_one_line({"dance", music, "-o", path("none/x.bvh")}, 1, "none");
    expect_one_line({"render", music, "-o", path("x.xyz")}, 1, ".mp4");
    expect_one_line({"render", music, "-o", path("none/x.mp4")}, 1, "none");
    expect_one_line({"render", music, "-o", path("x.mp4"), "--size", "321x180"}, 1, "even");
    expect_one_line({"synth", "-o", path("x.wav"), "--beats", path("none/x.beats")}, 1, "none");
    EXPECT_EQ(files(), std::vector<std::string>{"music.wav"});
}

TEST_F(BadInput, what_render_cannot_write_is_said_before_anything_is_read) {
    // The music is not there: whoever looked at it first would say so.
    const std::string music = path("missing.wav");
    expect_one_line({"render", music, "-o", path("x.ogv")}, 1, "unknown kind of film");
    expect_one_line({"render", music, "-o", path("x.mov")}, 1, "with alpha alone; use .mp4");
    expect_one_line({"render", music, "-o", path("x.mp4"), "--alpha"}, 1, "has no alpha; use .mov");
    expect_one_line({"render", music, "-o", path("none/x.mkv")}, 1, "cannot be written");
    expect_one_line({"render", music, "-o", path("x.webm"), "--size", "99x100"}, 1, "even");
    EXPECT_EQ(files(), std::vector<std::string>{});
}

TEST_F(BadInput, a_full_disk_ends_in_one_line_and_leaves_nothing) {
    write_clicks("music.wav", 8.0);
    for (const char* output : {"x.mp4", "x.avi", "x.bvh"}) {
        const std::string command = std::string(output) == "x.bvh" ? "dance" : "render";
        ProcessPlan full = plan({command, path("music.wav"), "-o", path(output)});
        if (command == "render") {
            full.command.insert(full.command.end(), {"--size", "320x180", "--quality", "fast"});
        }
        full.file_size_limit = 20'000;
        const ProcessResult result = run_process(full);
        EXPECT_EQ(result.exit_code, 1) << output << result.err;
        EXPECT_TRUE(is_one_error_line(result.err)) << output << "\n" << result.err;
        EXPECT_EQ(files(), std::vector<std::string>{"music.wav"}) << output;
    }
}

TEST_F(BadInput, a_truncated_file_gives_what_is_there_with_a_warning_or_is_refused) {
    write_clicks("music.wav");
    const std::string whole = read_file(path("music.wav")).value();
    for (const std::size_t size :
         {std::size_t{10}, std::size_t{43}, std::size_t{44}, std::size_t{45}, whole.size() / 2}) {
        write("cut.wav", whole.substr(0, size));
        const ProcessResult result = run({"analyze", path("cut.wav"), "--json"});
        EXPECT_TRUE(result.exit_code == 0 || result.exit_code == 1) << size;
        EXPECT_TRUE(result.err.empty() || is_one_error_line(result.err)) << result.err;
    }
}

TEST_F(BadInput, a_file_full_of_nan_is_analyzed_as_silence) {
    std::string wav(
        "RIFF\0\0\0\0WAVEfmt "
        "\x10\0\0\0\x03\0\x01\0\x80\xbb\0\0\0\xee\x02\0\x04\0\x20\0data\0\0\0\0",
        44);
    const float nan = std::numeric_limits<float>::quiet_NaN();
    const std::uint32_t bytes = 48'000 * 2 * sizeof(float);
    wav.replace(40, 4, std::string(reinterpret_cast<const char*>(&bytes), 4));
    const std::uint32_t riff = bytes + 36;
    wav.replace(4, 4, std::string(reinterpret_cast<const char*>(&riff), 4));
    for (std::uint32_t i = 0; i < bytes / sizeof(float); ++i) {
        wav.append(reinterpret_cast<const char*>(&nan), sizeof nan);
    }
    write("nan.wav", wav);
    const ProcessResult result = run({"analyze", path("nan.wav"), "--json"});
    EXPECT_EQ(result.exit_code, 0) << result.err;
    EXPECT_EQ(result.out.find(": nan"), std::string::npos);
    EXPECT_EQ(result.out.find("null"), std::string::npos);
}

TEST_F(BadInput, a_theme_that_is_unknown_or_mangled_is_told_and_the_default_is_shown) {
    write("bad.toml", "format = \"raks-theme\"\nversion = 1\nexposure = \"bright\"\n");
    write_clicks("x.wav", 1.0);
    const std::pair<std::string, std::string> cases[] = {
        {"stgae", "did you mean \"stage\"?"},
        {path("bad.toml"), "line 3: exposure must be a number"},
        {path("none.toml"), "none.toml"},
    };
    for (const auto& [theme, part] : cases) {
        const ProcessResult drawn = run({"render",
                                         path("x.wav"),
                                         "-o",
                                         path("x.mkv"),
                                         "--size",
                                         "64x64",
                                         "--duration",
                                         "0.2",
                                         "--theme",
                                         theme});
        EXPECT_EQ(drawn.exit_code, 0) << drawn.err;
        EXPECT_NE(drawn.err.find(part), std::string::npos) << drawn.err;
        const std::string said = "the theme \"stage\" is shown instead";
        const std::size_t at = drawn.err.find(said);
        ASSERT_NE(at, std::string::npos) << drawn.err;
        EXPECT_EQ(drawn.err.find(said, at + 1), std::string::npos) << drawn.err;
    }
}

TEST_F(BadInput, an_unknown_key_in_the_settings_is_said_and_stops_nothing) {
    std::filesystem::create_directories(folder_ / "config" / "raks");
    ASSERT_TRUE(write_file(folder_ / "config" / "raks" / "config.toml",
                           "[picture]\nthme = \"x\"\nfps = 25.0\n"));
    write_clicks("x.wav", 1.0);
    const ProcessResult danced = run({"dance", path("x.wav"), "-o", path("x.bvh")});
    EXPECT_EQ(danced.exit_code, 0);
    EXPECT_TRUE(is_one_error_line(danced.err)) << danced.err;
    EXPECT_NE(danced.err.find("did you mean \"picture.theme\"?"), std::string::npos) << danced.err;
    const ProcessResult shown = run({"config", "show"});
    EXPECT_EQ(shown.exit_code, 0) << shown.err;
    EXPECT_NE(shown.out.find("fps = 25.0 "), std::string::npos) << "the other keys hold";
    EXPECT_NE(shown.err.find("did you mean \"picture.theme\"?"), std::string::npos) << shown.err;
}

TEST_F(BadInput, files_that_options_name_must_be_there_also_where_nothing_needs_them) {
    const std::string dance =
        (std::filesystem::path(RAKS_SOURCE_DIR) / "config" / "choreographies" / "waltz.toml")
            .string();
    for (const char* const option : {"--joints", "--skeleton"}) {
        expect_one_line(
            {"stick", dance, "-o", path("x.png"), option, path("nosuch")}, 1, "nosuch: cannot be");
    }
    for (const char* const option :
         {"--joints", "--skeleton", "--labels", "--counts", "--faults", "--music"}) {
        expect_one_line({"train", "figure", dance, "-o", path("x/"), option, path("nosuch")},
                        1,
                        "nosuch: cannot be");
    }
    EXPECT_EQ(files(), std::vector<std::string>{});
}

TEST_F(BadInput, help_and_the_way_to_the_settings_are_given_whatever_the_settings_say) {
    std::filesystem::create_directories(folder_ / "config" / "raks");
    const std::filesystem::path settings = folder_ / "config" / "raks" / "config.toml";
    ASSERT_TRUE(write_file(settings, "= not TOML"));
    expect_one_line({"play", path("x.wav")}, 2, "config.toml");
    const ProcessResult help = run({"play", "--help"});
    EXPECT_EQ(help.exit_code, 0) << help.err;
    EXPECT_NE(help.out.find("--seed"), std::string::npos) << help.out;
    EXPECT_EQ(run({}).exit_code, 0);
    const ProcessResult where = run({"config", "path"});
    EXPECT_EQ(where.exit_code, 0) << where.err;
    EXPECT_EQ(where.out, settings.string() + "\n");
}

TEST_F(BadInput, training_refuses_bad_motion_and_leaves_no_model) {
    write("labels.tsv",
          "take\trole\tstart\tend\tfigure\tstart_count\tbeats\tconfidence\tsplit\tnote\n"
          "clip\tlead\t1\t11\tbasic\t1\t2\t1\ttrain\t\n");
    const std::filesystem::path data =
        std::filesystem::path(RAKS_SOURCE_DIR) / "tests" / "data" / "bvh";
    const struct {
        const char* file;
        const char* part;
    } cases[] = {
        {"bad/channel_count.bvh", "count does not match"},
        {"bad/nan_row.bvh", "frame 5"},
        {"bad/row_short.bvh", "25 of 30 values"},
        {"odd/two_joints.bvh", "no humanoid"},
    };
    for (const auto& c : cases) {
        write("clip.bvh", read_file(data / c.file).value());
        expect_one_line({"train",
                         "figure",
                         path("clip.bvh"),
                         "--labels",
                         path("labels.tsv"),
                         "-o",
                         path("model.json")},
                        1,
                        c.part);
    }
    EXPECT_EQ(files(), (std::vector<std::string>{"clip.bvh", "labels.tsv"}));
}

/// Someone who stands still for 200 frames.
std::vector<motion::Pose> standing() {
    motion::Pose pose;
    pose.hips_position = motion::mannequin_skeleton().offsets[0];
    return std::vector<motion::Pose>(200, pose);
}

TEST_F(BadInput, training_refuses_bad_labels_in_one_line) {
    ASSERT_TRUE(
        motion::write_bvh(folder_ / "clip.bvh", motion::mannequin_skeleton(), standing(), 60.0));
    const std::string header = "take\trole\tstart\tend\tfigure\tbeats\n";
    const struct {
        const char* rows;
        const char* part;
    } cases[] = {
        {"", "no basic of the lead"},
        {"clip\tlead\t100\t300\tbasic\t8\n", "line 2: end is 300, clip has 200 frames"},
        {"clip\tlead\t-5\t150\tbasic\t8\n", "line 2: start is -5"},
        {"clip\tlead\t10\t150\tbasic\t8\nclip\tlead\t140\t199\tbasic\t8\n",
         "line 3: clip 140-199 overlaps line 2 (10-150)"},
        {"clip\tlead\t10\t11\tbasic\t8\n", "line 2: 1 frames for 8 beats"},
        {"clip\tlead\t10\t150\tbasic\t0\n", "line 2: beats is 0"},
        {"other\tlead\t10\t150\tbasic\t8\n", "no clip named other was given"},
    };
    for (const auto& c : cases) {
        write("labels.tsv", header + c.rows);
        for (const char* command : {"figure", "report"}) {
            expect_one_line({"train",
                             command,
                             path("clip.bvh"),
                             "--labels",
                             path("labels.tsv"),
                             "-o",
                             path("out")},
                            1,
                            c.part);
        }
    }
    EXPECT_EQ(files(), (std::vector<std::string>{"clip.bvh", "labels.tsv"}));
}

TEST_F(BadInput, one_repetition_of_standing_still_is_learnt_but_cannot_be_judged) {
    ASSERT_TRUE(
        motion::write_bvh(folder_ / "clip.bvh", motion::mannequin_skeleton(), standing(), 60.0));
    write("labels.tsv", "take\trole\tstart\tend\tfigure\tbeats\nclip\tlead\t10\t150\tbasic\t8\n");
    const auto arguments = [this](const char* command) {
        return std::vector<std::string>{"train",
                                        command,
                                        path("clip.bvh"),
                                        "--labels",
                                        path("labels.tsv"),
                                        "--scale",
                                        "1",
                                        "-o",
                                        path("out.json")};
    };
    // No joint moves: the floor under the variances keeps the covariances positive definite.
    const ProcessResult learnt = run(arguments("figure"));
    EXPECT_EQ(learnt.exit_code, 0) << learnt.err;
    std::filesystem::remove(folder_ / "out.json");
    expect_one_line(arguments("report"), 1, "1 repeat of one take only");
    EXPECT_EQ(files(), (std::vector<std::string>{"clip.bvh", "labels.tsv"}));
}

TEST_F(BadInput, a_dance_is_learnt_by_its_music_or_the_reason_is_said) {
    ASSERT_TRUE(
        motion::write_bvh(folder_ / "clip.bvh", motion::mannequin_skeleton(), standing(), 60.0));
    write("labels.tsv", "take\trole\tstart\tend\tfigure\nclip\tlead\t10\t170\tbasic\n");
    write_clicks("music.wav", 14.0);  // 180 BPM: 8 beats are 160 frames
    const std::vector<float> silence(48'000 * 4, 0.0F);
    ASSERT_TRUE(audio::write_wav(path("silence.wav"), silence, 1, SampleRate(48'000)));
    const auto arguments = [this](const char* music, const char* offset) {
        return std::vector<std::string>{"train",
                                        "figure",
                                        path("clip.bvh"),
                                        "--labels",
                                        path("labels.tsv"),
                                        "--music",
                                        path(music),
                                        "--offset",
                                        offset,
                                        "--scale",
                                        "1",
                                        "-o",
                                        path("out.json")};
    };
    expect_one_line(arguments("missing.wav", "0"), 1, "missing.wav");
    expect_one_line(arguments("labels.tsv", "0"), 1, "is not audio");
    expect_one_line(arguments("music.wav", "12"), 1, "line 2: ends at 14.8 s of music.wav");
    expect_one_line(arguments("music.wav", "-2"), 1, "line 2: starts 1.8 s before music.wav");
    expect_one_line(arguments("silence.wav", "0"), 1, "line 2: no beats were heard in silence.wav");
    const ProcessResult learnt = run(arguments("music.wav", "7"));
    EXPECT_EQ(learnt.exit_code, 0) << learnt.err;
    EXPECT_NE(learnt.out.find("1 of 1 repeats"), std::string::npos) << learnt.out;
}

TEST_F(BadInput, motion_beyond_all_measure_is_refused) {
    std::vector<motion::Pose> poses = standing();
    poses[77].hips_position.x = 1e30F;
    ASSERT_TRUE(motion::write_bvh(folder_ / "clip.bvh", motion::mannequin_skeleton(), poses, 60.0));
    write("labels.tsv", "take\trole\tstart\tend\tfigure\tbeats\nclip\tlead\t10\t150\tbasic\t8\n");
    for (const char* command : {"figure", "report"}) {
        expect_one_line(
            {"train", command, path("clip.bvh"), "--labels", path("labels.tsv"), "-o", path("out")},
            1,
            "frame 7");
    }
}

TEST_F(BadInput, a_model_of_another_version_or_with_nan_is_refused) {
    write_clicks("music.wav");
    const std::filesystem::path trained = folder_ / "data" / "models" / "trained";
    std::filesystem::create_directories(trained.parent_path());
    std::filesystem::copy(std::filesystem::path(RAKS_SOURCE_DIR) / "models" / "trained",
                          trained,
                          std::filesystem::copy_options::recursive);
    const std::string model = read_file(std::filesystem::path(RAKS_SOURCE_DIR) / "models" /
                                        "trained" / "salsa_basic_lead.json")
                                  .value();
    const std::pair<const char*, const char*> cases[] = {{"\"version\": 1", "\"version\": 99"},
                                                         {"\"net_turn\": ", "\"net_turn\": nan"}};
    for (const auto& [from, to] : cases) {
        std::string changed = model;
        const std::size_t at = changed.find(from);
        ASSERT_NE(at, std::string::npos) << from;
        changed.replace(at, std::string(from).size(), to);
        ASSERT_TRUE(write_file(trained / "salsa_basic_lead.json", changed));
        ProcessPlan with_data =
            plan({"dance", path("music.wav"), "--dance", "salsa", "-o", path("x.bvh")});
        with_data.environment.emplace_back("RAKS_DATA", (folder_ / "data").string());
        const ProcessResult result = run_process(with_data);
        EXPECT_EQ(result.exit_code, 1) << to;
        EXPECT_TRUE(is_one_error_line(result.err)) << result.err;
    }
    EXPECT_EQ(files(), (std::vector<std::string>{"data", "music.wav"}));
}

TEST_F(BadInput, a_device_that_does_not_exist_is_said) {
    expect_one_line({"live", "--headless", "--device", "no such thing"}, 1, "no such thing");
    write_clicks("music.wav");
    expect_one_line(
        {"play", path("music.wav"), "--headless", "--output", "no such thing"}, 1, "no such thing");
}

TEST_F(BadInput, a_plot_that_cannot_be_made_is_one_line) {
    write_clicks("a.wav", 1.0);
    ASSERT_TRUE(write_file(path("bad.beats"), "1.0\nnoise\n"));
    expect_one_line({"analyze", path("a.wav"), "--plot", path("none/a.svg")}, 1, "none");
    expect_one_line({"analyze", path("a.wav"), "--plot", path("a.png")}, 1, ".svg");
    expect_one_line(
        {"analyze", path("a.wav"), "--plot", path("a.svg"), "--reference", path("bad.beats")},
        1,
        "line 2: 'noise'");
    expect_one_line(
        {"analyze", path("a.wav"), "--plot", path("a.svg"), "--reference", path("no.beats")},
        1,
        "no.beats");
    expect_one_line({"analyze", path("a.wav"), "--reference", path("bad.beats")}, 2, "--plot");
    expect_one_line({"analyze", path("a.wav"), "--beat", "guess"}, 2, "guess");
    EXPECT_EQ(files(), (std::vector<std::string>{"a.wav", "bad.beats"}));
}

}  // namespace
}  // namespace raks::test
