// Names and files as they should not be given: pipes, devices, line breaks, outputs that are
// inputs.
#include <gtest/gtest.h>
#include <sys/stat.h>

#include <filesystem>
#include <string>
#include <vector>

#include "audio/io/audio_file.hpp"
#include "audio/music/generator/music_generator.hpp"
#include "base/file.hpp"
#include "base/pending_file.hpp"
#include "tests/end_to_end/program_fixture.hpp"
#include "tests/support/shared_data.hpp"

namespace raks::test {
namespace {

namespace fs = std::filesystem;

class OddFiles : public ProgramTest {};

TEST_F(OddFiles, a_pipe_is_refused_instead_of_waited_for) {
    write_clicks("music.wav", 1.0);
    for (const char* name : {"pipe", "pipe.bvh", "pipe.toml", "index.tsv"}) {
        ASSERT_EQ(mkfifo(path(name).c_str(), 0600), 0);
    }
    const std::string music = path("music.wav");
    const std::string refused = "is not a plain file";
    expect_one_line({"dance", path("pipe"), "-o", path("x.bvh")}, 1, refused);
    expect_one_line({"stick", path("pipe.bvh"), "-o", path("x.png")}, 1, refused);
    expect_one_line({"stick", path("pipe.toml"), "-o", path("x.png")}, 1, refused);
    expect_one_line(
        {"analyze", music, "--plot", path("x.svg"), "--reference", path("pipe")}, 1, refused);
    expect_one_line(
        {"train", "figure", path("x.bvh"), "--labels", path("pipe"), "-o", path("x.json")},
        1,
        refused);
    expect_one_line({"eval", "beats", folder_.path().string()}, 1, refused);
    fs::create_directories(folder_ / "config" / "raks");
    ASSERT_EQ(mkfifo((folder_ / "config" / "raks" / "config.toml").c_str(), 0600), 0);
    expect_one_line({"devices"}, 2, refused);
}

TEST_F(OddFiles, devices_are_not_replaced_by_files) {
    write_clicks("music.wav", 1.0);
    fs::create_symlink("/dev/full", folder_ / "full.bvh");
    expect_one_line({"dance", path("music.wav"), "-o", path("full.bvh")}, 1, "is not a plain file");
    EXPECT_TRUE(fs::is_character_file(folder_ / "full.bvh"));
}

TEST_F(OddFiles, line_breaks_and_other_bytes_in_names_do_not_break_the_line) {
    expect_one_line({"analyze", path("a\nb\x1b[31m.wav")}, 1, "a?b?[31m.wav: cannot be opened");
    expect_one_line({"play", "--headless", path("a\xff.wav")}, 1, "a?.wav: cannot be opened");
    expect_one_line({"dance\n"}, 2, "\"dance?\"");
    write_clicks("a\xff.wav", 1.0);
    const ProcessResult heard = run({"analyze", path("a\xff.wav"), "--json"});
    EXPECT_EQ(heard.exit_code, 0) << heard.err;
}

TEST_F(OddFiles, what_is_read_is_not_written_over) {
    write_clicks("music.bvh", 1.0);  // told by content: it is music
    const std::string before = read_file(path("music.bvh")).value();
    fs::create_symlink("music.bvh", folder_ / "other.bvh");
    const std::string refused = "is what is to be read";
    expect_one_line({"dance", path("music.bvh"), "-o", path("other.bvh")}, 1, refused);
    fs::copy_file(path("music.bvh"), path("music.mp4"));
    expect_one_line({"render", path("music.mp4"), "-o", path("music.mp4")}, 1, refused);
    fs::copy_file(path("music.bvh"), path("a.wav"));
    ASSERT_TRUE(write_file(path("index.tsv"), "name\tclass\na\tclicks\n"));
    ASSERT_TRUE(write_file(path("a.beats"), "0.1\n0.5\n"));
    expect_one_line({"eval", "beats", folder_.path().string(), "--out", path(".")}, 1, refused);
    EXPECT_EQ(read_file(path("music.bvh")).value(), before);
    EXPECT_EQ(read_file(path("music.mp4")).value(), before);
    EXPECT_EQ(read_file(path("a.beats")).value(), "0.1\n0.5\n");
}

TEST_F(OddFiles, a_full_disk_behind_standard_output_is_a_failure) {
    ProcessPlan full = plan({});
    full.command = {"/bin/sh", "-c", "exec \"$0\" config show > /dev/full", RAKS_PROGRAM};
    const ProcessResult result = run_process(full);
    EXPECT_EQ(result.exit_code, 1);
    EXPECT_TRUE(is_one_error_line(result.err)) << result.err;
    EXPECT_NE(result.err.find("standard output"), std::string::npos) << result.err;
}

TEST_F(OddFiles, numbers_that_are_none_are_wrong_usage) {
    const std::string out = path("x.wav");
    for (const char* number : {"nan", "inf", "-inf", "1e999", "", "1,5", "120bpm"}) {
        expect_one_line({"synth", "-o", out, std::string("--bpm=") + number}, 2, "--bpm");
    }
    expect_one_line({"render", "-o", path("x.mp4"), "--duration=nan"}, 2, "--duration");
    expect_one_line({"render", "-o", path("x.mp4"), "--fps=nan"}, 2, "fps");
    expect_one_line({"synth", "-o", path("x.mp3")}, 1, "known: .wav");
    EXPECT_FALSE(fs::exists(out));
}

TEST_F(OddFiles, what_is_misspelt_names_the_nearest) {
    expect_one_line({"dnace"}, 2, "command \"dnace\" is unknown; did you mean \"dance\"?");
    expect_one_line({"render", "--sed=5", "-o", path("x.mp4")}, 2, "did you mean \"--seed\"?");
    expect_one_line({"train", "genres"}, 2, "did you mean \"genre\"?");
    expect_one_line({"eval", "dance", "--role", "folow"}, 2, "did you mean \"follow\"?");
    expect_one_line({"render", "-o", path("x.mp4"), "--quality", "hgih"}, 2, "\"high\"");
    expect_one_line({"devices", "now"}, 2, "\"now\" is a word too many");
}

TEST_F(OddFiles, tables_of_spreadsheets_are_read) {
    write_clicks("a.wav", 1.0);
    ASSERT_TRUE(write_file(path("a.beats"),
                           "\xef\xbb\xbf"
                           "0.1\r0.5\r"));
    ASSERT_TRUE(write_file(path("index.tsv"), "\xef\xbb\xbfname\tclass\r\na\tclicks\r\n"));
    const ProcessResult scored = run({"eval", "beats", folder_.path().string()});
    EXPECT_EQ(scored.exit_code, 0) << scored.err;
    const std::string utf16("\xff\xfen\0a\0m\0e\0", 10);
    ASSERT_TRUE(write_file(path("index.tsv"), utf16));
    expect_one_line({"eval", "beats", folder_.path().string()}, 1, "UTF-16 text; save it as UTF-8");
}

// Seeking in them ended libvorbis, and the program with it.
TEST_F(OddFiles, a_song_that_ends_its_decoder_is_one_line_and_the_next_one_plays) {
    const fs::path hostile = shared_data() / "data/cases/hostile";
    if (!fs::exists(hostile)) {
        GTEST_SKIP() << "no hostile files in " << shared_data();
    }
    write_clicks("next.wav", 3.0);
    for (const char* name : {"seek-crash-1.ogg", "seek-crash-2.ogg"}) {
        const std::string song = (hostile / name).string();
        const std::vector<std::string> how = {
            "--headless", "--no-sound", "--start", "2.5", "--duration", "0.2"};
        std::vector<std::string> alone = {"play", song};
        alone.insert(alone.end(), how.begin(), how.end());
        expect_one_line(alone, 1, name);
        std::vector<std::string> both = {"play", song, path("next.wav")};
        both.insert(both.end(), how.begin(), how.end());
        const ProcessResult played = run(both);
        EXPECT_EQ(played.exit_code, 3) << played.err;
        EXPECT_NE(played.err.find("next.wav"), std::string::npos) << played.err;
    }
}

}  // namespace
}  // namespace raks::test
