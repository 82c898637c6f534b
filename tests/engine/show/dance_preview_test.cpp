// A dance that is being written: shown as saved last, faults told, the last good dance goes on.
#include "engine/show/dance_preview.hpp"

#include <gtest/gtest.h>

#include <chrono>
#include <filesystem>

#include "base/file.hpp"
#include "base/pending_file.hpp"
#include "tests/support/temporary_folder.hpp"

namespace raks::engine {
namespace {

namespace fs = std::filesystem;

const std::string kDance = R"(format = "raks-choreography"
version = 1
dance = "rock"
tempo = [90, 120, 150]
[[figure]]
name = "sway"
beats = 2
body.lean.x = { wave = 8, every = 2, peak = 0 }
[[figure]]
name = "nod"
beats = 4
body.head.tilt = { wave = 8, every = 1, peak = 0 }
)";

class Preview : public testing::Test {
 protected:
    void SetUp() override { save(kDance); }

    /// Each time a second later than the last.
    void save(const std::string& text) {
        ASSERT_TRUE(write_file(path_, text));
        fs::last_write_time(path_, fs::file_time_type() + std::chrono::seconds(++saves_));
    }
    [[nodiscard]] DancePreview preview(const std::string& figure = {}) const {
        auto made = DancePreview::create(path_, figure, std::nullopt);
        EXPECT_TRUE(made) << made.error().message;
        return std::move(*made);
    }

    test::TemporaryFolder folder_;
    fs::path path_ = folder_ / "dance.toml";
    int saves_ = 0;
};

TEST_F(Preview, dances_at_the_written_tempo_round_and_round) {
    DancePreview dance = preview("nod");
    EXPECT_EQ(dance.status(), "nod   120 BPM   beat 0.0 of 4");
    dance.advance(1.25);
    EXPECT_EQ(dance.status(), "nod   120 BPM   beat 2.5 of 4");
    dance.advance(8 * 2.0);  // eight repeats of two seconds
    EXPECT_EQ(dance.status(), "nod   120 BPM   beat 2.5 of 4");
    EXPECT_EQ(dance.sheet(8).size(), 32U);
}

TEST_F(Preview, keys_change_figure_and_tempo_and_pause) {
    DancePreview dance = preview();
    EXPECT_TRUE(dance.handle({Key::right}));
    EXPECT_TRUE(dance.handle({Key::up}));
    EXPECT_TRUE(dance.handle({Key::space}));
    dance.advance(1.0);
    EXPECT_EQ(dance.status(), "nod   124 BPM   beat 0.0 of 4   paused");
    EXPECT_TRUE(dance.handle({Key::left}));
    EXPECT_EQ(dance.figure(), "sway");
    EXPECT_FALSE(dance.handle({Key::escape}));
}

TEST_F(Preview, shows_what_is_saved_and_keeps_the_last_good_dance) {
    DancePreview dance = preview("nod");
    EXPECT_FALSE(dance.refresh());
    const motion::Pose before = dance.pose();
    std::string text = kDance;
    text.replace(text.find("head.tilt"), 9, "head.tlit");
    save(text);
    EXPECT_TRUE(dance.refresh());
    EXPECT_NE(dance.status().find("line 12: figure \"nod\": control \"head.tlit\""),
              std::string::npos)
        << dance.status();
    EXPECT_EQ(dance.pose().local_rotations, before.local_rotations);
    EXPECT_FALSE(dance.refresh());  // told once
    text = kDance;
    text.replace(text.find("wave = 8, every = 1"), 19, "wave = 2, every = 1");
    save(text);
    EXPECT_TRUE(dance.refresh());
    EXPECT_EQ(dance.figure(), "nod");
    EXPECT_EQ(dance.fault(), "");
    EXPECT_NE(dance.pose().local_rotations, before.local_rotations);
}

TEST_F(Preview, a_file_that_is_not_there_or_has_no_such_figure_is_one_line) {
    const auto missing = DancePreview::create("no_such.toml", "", std::nullopt);
    ASSERT_FALSE(missing);
    const auto unknown = DancePreview::create(path_, "swya", std::nullopt);
    ASSERT_FALSE(unknown);
    EXPECT_NE(unknown.error().message.find("did you mean \"sway\"?"), std::string::npos);
}

}  // namespace
}  // namespace raks::engine
