// The program on PipeWire, by its PulseAudio server: what most desktops run.
#include <gtest/gtest.h>

#include <csignal>
#include <optional>
#include <string>
#include <vector>

#include "audio/music/generator/music_generator.hpp"
#include "tests/end_to_end/program_fixture.hpp"
#include "tests/support/child_process.hpp"
#include "tests/support/pipewire_server.hpp"
#include "tests/support/pulse_server.hpp"

namespace raks::test {
namespace {

class OnPipeWire : public ProgramTest {
 protected:
    void SetUp() override {
        if (!PipeWireServer::is_unpacked()) {
            GTEST_SKIP() << "scripts/unpack_pipewire.sh has not put PipeWire into build/pipewire";
        }
        pipewire_.emplace();
        ASSERT_EQ(pipewire_->problem(), "");
        audio::MusicPlan plan;
        plan.style = audio::Style::drums;
        plan.tempo = {{0.0, 128.0}};
        plan.seconds = 60.0;
        write_music("drums.wav", plan);
    }
    [[nodiscard]] ProcessPlan with_server(std::vector<std::string> arguments) const {
        ProcessPlan result = plan(std::move(arguments));
        std::erase_if(result.environment,
                      [](const auto& pair) { return pair.first == "PULSE_SERVER"; });
        return result;
    }
    static void expect_good_end(CapturedProcess& raks) {
        raks.send(SIGINT);
        const ProcessResult result = raks.wait();
        EXPECT_EQ(result.exit_code, 130) << result.err;
    }

    std::optional<PipeWireServer> pipewire_;
};

TEST_F(OnPipeWire, live_hears_what_the_computer_plays) {
    const ChildProcess music({"paplay", path("drums.wav")}, "/dev/null");
    const ProcessResult heard =
        run_process(with_server({"live", "--headless", "--duration", "12"}));
    EXPECT_EQ(heard.exit_code, 0);
    EXPECT_NE(heard.err.find("listening to 'Monitor of Speakers' (PipeWire): it is what"),
              std::string::npos)
        << heard.err;
    EXPECT_NE(heard.err.find("tempo 12"), std::string::npos) << heard.err;
}

TEST_F(OnPipeWire, live_follows_the_default_and_back) {
    CapturedProcess raks(with_server({"live", "--headless"}));
    ASSERT_TRUE(raks.wait_for_output("listening to 'Monitor of Speakers'"));
    PulseServer::set_default_sink("headphones");
    ASSERT_TRUE(raks.wait_for_output("listening to 'Monitor of Headphones' (PipeWire) now"))
        << raks.output().err;
    PulseServer::set_default_sink("speakers");
    ASSERT_TRUE(raks.wait_for_output("listening to 'Monitor of Speakers' (PipeWire) now"))
        << raks.output().err;
    expect_good_end(raks);
}

TEST_F(OnPipeWire, live_listens_again_when_the_server_is_back) {
    CapturedProcess raks(with_server({"live", "--headless"}));
    ASSERT_TRUE(raks.wait_for_output("listening to"));
    pipewire_->kill();
    ASSERT_TRUE(raks.wait_for_output("Monitor of Speakers: the device is gone; dancing on"));
    pipewire_->start();
    ASSERT_TRUE(raks.wait_for_output("listening to 'Monitor of Speakers' (PipeWire) again"))
        << raks.output().err;
    expect_good_end(raks);
}

TEST_F(OnPipeWire, play_follows_the_default_and_waits_while_the_server_is_away) {
    CapturedProcess raks(with_server({"play", path("drums.wav"), "--headless"}));
    ASSERT_TRUE(raks.wait_for_output("sound goes to 'Speakers' (PipeWire)"));
    PulseServer::set_default_sink("headphones");
    ASSERT_TRUE(raks.wait_for_output("sound goes to 'Headphones' (PipeWire) now"))
        << raks.output().err;
    pipewire_->kill();
    ASSERT_TRUE(raks.wait_for_output("the device is gone; pausing until it is back"));
    pipewire_->start();
    ASSERT_TRUE(raks.wait_for_output("sound goes to 'Speakers' (PipeWire) now"))
        << raks.output().err;
    expect_good_end(raks);
}

/// What GStreamer gets of the stream "Dancer": pictures of 4 bytes a pixel.
ProcessResult received(int pictures, const std::string& caps) {
    ProcessPlan plan;
    plan.command = {"timeout",
                    "20",
                    "gst-launch-1.0",
                    "-q",
                    "pipewiresrc",
                    "target-object=Dancer",
                    "num-buffers=" + std::to_string(pictures),
                    "!",
                    caps,
                    "!",
                    "fdsink"};
    return run_process(plan);
}

class PicturesOnPipeWire : public OnPipeWire {
 protected:
    [[nodiscard]] ProcessPlan dancer() const {
        return with_server({"play",
                            path("drums.wav"),
                            "--no-sound",
                            "--headless",
                            "--video-out",
                            "pipewire:Dancer",
                            "--backdrop",
                            "transparent",
                            "--size",
                            "160x96"});
    }
    static constexpr std::size_t kPicture = 160 * 96 * 4;
    static constexpr const char* kCaps = "video/x-raw,format=RGBA,width=160,height=96";
};

TEST_F(PicturesOnPipeWire, reach_others_with_their_alpha) {
    CapturedProcess raks(dancer());
    ASSERT_TRUE(raks.wait_for_output("the pictures are there as \"Dancer\"")) << raks.output().err;
    const ProcessResult result = received(30, kCaps);
    ASSERT_EQ(result.out.size(), 30 * kPicture) << result.err;
    const std::string last = result.out.substr(29 * kPicture);
    EXPECT_EQ(last.substr(0, 4), std::string(4, '\0'));
    std::size_t opaque = 0;
    for (std::size_t i = 0; i < kPicture; i += 4) {
        const auto alpha = static_cast<unsigned char>(last[i + 3]);
        opaque += alpha == 255 ? 1 : 0;
        ASSERT_LE(static_cast<unsigned char>(last[i]), alpha + 1) << "not premultiplied";
    }
    EXPECT_GT(opaque, 200U);
    EXPECT_NE(last, result.out.substr(0, kPicture)) << "nothing moves";
    expect_good_end(raks);
}

TEST_F(PicturesOnPipeWire, outlive_readers_that_leave_or_want_another_size) {
    CapturedProcess raks(dancer());
    ASSERT_TRUE(raks.wait_for_output("the pictures are there as \"Dancer\"")) << raks.output().err;
    EXPECT_EQ(received(5, kCaps).out.size(), 5 * kPicture);
    EXPECT_TRUE(received(5, "video/x-raw,width=320").out.empty());
    EXPECT_EQ(received(5, kCaps).out.size(), 5 * kPicture);
    expect_good_end(raks);
}

TEST_F(PicturesOnPipeWire, go_on_when_the_server_is_back) {
    CapturedProcess raks(dancer());
    ASSERT_TRUE(raks.wait_for_output("the pictures are there as \"Dancer\"")) << raks.output().err;
    EXPECT_EQ(received(5, kCaps).out.size(), 5 * kPicture);
    pipewire_->kill();
    ASSERT_TRUE(raks.wait_for_output("PipeWire is gone; no pictures go there"));
    pipewire_->start();
    ASSERT_TRUE(raks.wait_until([](const ProcessResult& result) {
        const std::string_view said = result.err;
        return said.find("the pictures are there", said.find("is gone")) != said.npos;
    }));
    EXPECT_EQ(received(5, kCaps).out.size(), 5 * kPicture);
    expect_good_end(raks);
}

}  // namespace
}  // namespace raks::test
