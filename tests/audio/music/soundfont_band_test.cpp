// Soundfonts are played by another program: the same samples as here, and whatever a damaged one
// does to it is one line.
#include "audio/music/instruments/soundfont_band.hpp"

#include <fcntl.h>
#include <gtest/gtest.h>
#include <sys/wait.h>

#include <algorithm>
#include <cstdlib>
#include <filesystem>
#include <string>
#include <vector>

#include "audio/music/instruments/soundfont_player.hpp"
#include "base/descriptor.hpp"
#include "base/file.hpp"
#include "base/pending_file.hpp"
#include "base/talking_child.hpp"
#include "tests/support/temporary_folder.hpp"

namespace raks::audio {
namespace {

namespace fs = std::filesystem;

/// A soundfont of one tone.
const fs::path kTiny = fs::path(RAKS_SOURCE_DIR) / "tests/fuzz/corpus/soundfont/tiny.sf2";

Performance two_notes() {
    Performance performance;
    performance.notes = {{.time = 0.0, .length = 0.3, .channel = 0, .key = 60},
                         {.time = 0.2, .length = 0.3, .channel = kDrumChannel, .key = 36}};
    performance.seconds = 0.7;
    return performance;
}

class SoundfontBand : public testing::Test {
 protected:
    ~SoundfontBand() override { setenv("RAKS_SOUNDFONT", program_.c_str(), 1); }

    /// Another program takes the place of raks-soundfont.
    void replace(const std::string& script) const {
        const fs::path program = folder_ / "player";
        EXPECT_TRUE(write_file(program, "#!/bin/bash\n" + script));
        fs::permissions(program, fs::perms::owner_all);
        setenv("RAKS_SOUNDFONT", program.c_str(), 1);
    }

    static Expected<std::vector<float>> play(const std::vector<fs::path>& soundfonts) {
        Dice dice(1, 2);
        return play_with(soundfonts, two_notes(), {.size = 0.5, .level = 0.5}, dice);
    }
    static std::string message(const fs::path& soundfont) {
        const auto samples = play({soundfont});
        return samples ? "" : samples.error().message;
    }

    const std::string program_ = std::getenv("RAKS_SOUNDFONT");
    const raks::test::TemporaryFolder folder_;
};

TEST_F(SoundfontBand, plays_the_same_samples_as_in_this_process) {
    const Descriptor file(::open(kTiny.c_str(), O_RDONLY | O_CLOEXEC));
    const SoundfontFile one{.name = kTiny.string(), .descriptor = file.number};
    SoundfontPlayer player;
    ASSERT_TRUE(player.load({&one, 1}));
    const std::vector<float> here = player.play(two_notes(), {.size = 0.5, .level = 0.5});
    const auto there = play({kTiny});
    ASSERT_TRUE(there) << there.error().message;
    EXPECT_EQ(*there, here);
    EXPECT_GT(*std::max_element(there->begin(), there->end()), 0.3F);
    Dice dice(1, 2);
    const std::vector<SoundfontFile> two = {one, one};
    SoundfontPlayer band;
    ASSERT_TRUE(band.load(two));
    const std::vector<float> band_here =
        band.play(two_notes(), {.size = 0.5, .level = 0.5}, draw_band(2, dice));
    const auto band_there = play({kTiny, kTiny});
    ASSERT_TRUE(band_there) << band_there.error().message;
    EXPECT_EQ(*band_there, band_here);
}

TEST_F(SoundfontBand, says_which_soundfont_cannot_be_played) {
    const fs::path none = folder_ / "none.sf2";
    EXPECT_EQ(message(none), none.string() + ": cannot be opened: No such file or directory");
    const fs::path cut = folder_ / "cut.sf2";
    ASSERT_TRUE(write_file(cut, read_file(kTiny).value().substr(0, 700)));
    EXPECT_EQ(message(cut), cut.string() + ": is not a soundfont that FluidSynth can load");
}

TEST_F(SoundfontBand, whose_player_breaks_off_or_says_nonsense_is_one_line) {
    replace("kill -SEGV $$\n");
    EXPECT_EQ(message(kTiny),
              kTiny.string() +
                  ": its reader ended too soon (killed by SIGSEGV): it is damaged, or too large");
    replace("head -c 100000 /dev/urandom >&3\nsleep 100\n");
    EXPECT_EQ(message(kTiny), kTiny.string() + ": its reader sent a broken answer and was ended");
    // Samples that are no numbers.
    replace(
        "printf '\\x01\\0AR\\1\\0\\0\\0\\1\\0\\0\\0\\0\\0\\0\\0' >&3\n"
        "head -c 200000 /dev/zero | tr '\\0' '\\377' >&3\nsleep 100\n");
    EXPECT_EQ(message(kTiny), kTiny.string() + ": its reader sent a broken answer and was ended");
    EXPECT_EQ(::waitpid(-1, nullptr, WNOHANG), -1);  // no child of ours is left
}

TEST_F(SoundfontBand, whose_player_has_no_cage_is_noted) {
    ASSERT_TRUE(play({kTiny}));
    EXPECT_FALSE(is_any_child_uncaged());
    replace(
        "printf '\\x01\\0AR\\1\\0\\0\\0\\0\\0\\0\\0\\0\\0\\0\\0' >&3\n"
        "head -c 200000 /dev/zero >&3\nsleep 100\n");
    EXPECT_TRUE(play({kTiny}));
    EXPECT_TRUE(is_any_child_uncaged());
}

}  // namespace
}  // namespace raks::audio
