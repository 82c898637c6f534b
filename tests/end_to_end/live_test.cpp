// The program on a real JACK server: sound leaves by one process and is heard by another.
#include <gtest/gtest.h>

#include <chrono>
#include <cmath>
#include <csignal>
#include <optional>

#include "audio/io/audio_file.hpp"
#include "audio/synth/music_generator.hpp"
#include "tests/end_to_end/program.hpp"
#include "tests/support/jack_server.hpp"

namespace raks::test {
namespace {

using std::chrono::milliseconds;

class Live : public ProgramTest {
 protected:
    void SetUp() override {
        ProgramTest::SetUp();
        jack_.emplace();
        ASSERT_EQ(jack_->problem(), "");
        audio::MusicPlan plan;
        plan.style = audio::Style::drums;
        plan.tempo = {{0.0, 128.0}};
        plan.seconds = 40.0;
        const auto music = audio::generate(plan);
        ASSERT_TRUE(music);
        ASSERT_TRUE(
            audio::write_wav(path("drums.wav"), music->samples, music->channels, music->rate));
    }
    void TearDown() override {
        jack_.reset();
        ProgramTest::TearDown();
    }

    /// As plan(), but with the JACK server of this test.
    [[nodiscard]] ProcessPlan with_jack(std::vector<std::string> arguments) const {
        ProcessPlan result = plan(std::move(arguments));
        std::erase_if(result.environment,
                      [](const auto& pair) { return pair.first == "JACK_DEFAULT_SERVER"; });
        return result;
    }

    std::optional<JackServer> jack_;
};

/// The number behind "tempo " in what `raks live` says at its end.
double tempo_in(const std::string& text) {
    const std::size_t at = text.find("tempo ");
    return at == std::string::npos ? 0.0 : std::stod(text.substr(at + 6));
}

TEST_F(Live, hears_the_tempo_that_play_plays) {
    CapturedProcess player(with_jack({"play", path("drums.wav"), "--headless"}));
    ASSERT_TRUE(player.wait_for_output("playing"));
    // Every JACK client is an input of the others: the player's own name is listened to.
    CapturedProcess listener(
        with_jack({"live", "--headless", "--device", "raks", "--duration", "14"}));
    const ProcessResult heard = listener.wait(milliseconds(40'000));
    EXPECT_EQ(heard.exit_code, 0) << heard.err;
    EXPECT_NEAR(tempo_in(heard.err), 128.0, 2.0) << heard.err;
    EXPECT_NE(heard.err.find("listening to"), std::string::npos)
        << "says what and why: " << heard.err;
    player.send(SIGINT);
    EXPECT_EQ(player.wait(milliseconds(2'000)).exit_code, 130);
}

TEST_F(Live, survives_the_death_of_its_input_and_still_ends_in_time) {
    for (const auto& [signal, code] : {std::pair{SIGINT, 130}, std::pair{SIGTERM, 143}}) {
        JackServer jack;
        ASSERT_EQ(jack.problem(), "");
        CapturedProcess listener(with_jack({"live", "--headless", "--device", "system"}));
        ASSERT_TRUE(listener.wait_for_output("listening to"));
        jack.kill();
        ASSERT_TRUE(listener.wait_for_output("the device is gone"));
        listener.send(signal);
        const ProcessResult result = listener.wait(milliseconds(2'000));
        EXPECT_FALSE(result.timed_out);
        EXPECT_EQ(result.exit_code, code) << result.err;
    }
}

TEST_F(Live, play_goes_on_without_its_loudspeaker_and_says_so) {
    CapturedProcess player(with_jack({"play", path("drums.wav"), "--headless", "--duration", "6"}));
    ASSERT_TRUE(player.wait_for_output("playing"));
    jack_->kill();
    ASSERT_TRUE(player.wait_for_output("the device is gone"));
    const ProcessResult result = player.wait(milliseconds(20'000));
    EXPECT_FALSE(result.timed_out);
    EXPECT_EQ(result.exit_code, 1) << result.err;
}

}  // namespace
}  // namespace raks::test
