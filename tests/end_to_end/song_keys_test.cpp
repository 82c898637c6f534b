// The keys for songs and dances, by what they change in the picture, the files or the last line.
#include <gtest/gtest.h>

#include <filesystem>
#include <string>

#include "base/file.hpp"
#include "tests/end_to_end/keys_fixture.hpp"

namespace raks::test {
namespace {

class SongKeys : public KeysTest {};

TEST_F(SongKeys, n_plays_the_next_file) {
    start("--no-overlay");
    press({"n"});
    EXPECT_TRUE(raks_->wait_for_output("playing " + path("two.wav")));
}

TEST_F(SongKeys, k_keeps_to_the_figure_and_lets_go) {
    start("--no-overlay");
    press({"k"});
    EXPECT_TRUE(raks_->wait_for_output("keeping to this figure"));
    press({"k"});
    EXPECT_TRUE(raks_->wait_for_output("figures as they come"));
}

TEST_F(SongKeys, a_kept_figure_and_a_chosen_dance_go_on_with_the_next_file) {
    start("--no-overlay");
    press({"d"});
    ASSERT_TRUE(raks_->wait_for_output("dancing salsa"));
    press({"k", "n"});
    ASSERT_TRUE(raks_->wait_for_output("playing " + path("two.wav")));
    press({"d"});
    EXPECT_TRUE(raks_->wait_for_output("dancing belly")) << "the one after that which was chosen";
    press({"k"});
    EXPECT_TRUE(raks_->wait_for_output("figures as they come")) << "it was still kept";
}

TEST_F(SongKeys, d_goes_through_the_dances) {
    start("--no-overlay");
    press({"d"});
    EXPECT_TRUE(raks_->wait_for_output("dancing salsa"));
}

TEST_F(SongKeys, u_keeps_the_dance_that_was_chosen_for_this_song) {
    start("--no-overlay");
    press({"u"});
    ASSERT_TRUE(raks_->wait_for_output("no dance is kept: choose one first (D)"));
    press({"d"});
    ASSERT_TRUE(raks_->wait_for_output("dancing salsa"));
    press({"u"});
    ASSERT_TRUE(raks_->wait_for_output("salsa is kept for this song\n"));
    press({"n"});
    ASSERT_TRUE(raks_->wait_for_output("playing " + path("two.wav")));
    press({"d", "u"});
    ASSERT_TRUE(raks_->wait_for_output("belly is kept for this song\n"));
    const std::string folder = std::filesystem::canonical(folder_.path()).string();
    EXPECT_EQ(read_file(folder_ / "state" / "raks" / "dances.tsv").value_or("none"),
              "dance\tartist\tfolder\tsong\nsalsa\t\t" + folder + "\t" + folder +
                  "/one.wav\nbelly\t\t" + folder + "\t" + folder + "/two.wav\n");
    raks_.reset();
    start({"play", "--no-sound", "--no-overlay", "--as-live"});
    EXPECT_TRUE(raks_->wait_for_output("salsa, as you said"));
}

TEST_F(SongKeys, b_goes_back_to_the_file_before) {
    start("--no-overlay");
    press({"n"});
    ASSERT_TRUE(raks_->wait_for_output("playing " + path("two.wav")));
    press({"b"});
    EXPECT_TRUE(raks_->wait_until([&](const ProcessResult& result) {
        return count_of("playing " + path("one.wav"), result.err) == 2;
    }));
}

TEST_F(SongKeys, b_goes_to_the_start_of_a_file_that_has_played_for_a_while) {
    start_and_pause("--overlay");
    press({"Left", "Left", "Left", "Left", "Left", "Left", "Left", "Left"});
    const std::string beginning = lower(still_picture());
    const std::string on = changed_by("shift+Right", beginning);
    EXPECT_TRUE(changed_by("b", on) == beginning);
    EXPECT_EQ(count_of("playing ", raks_->output().err), 1);
}

}  // namespace
}  // namespace raks::test
