// MIDI on a JACK server of our own: a clock by the samples at which it comes, and what a knob box
// asks for.
#include <gtest/gtest.h>

#include <chrono>
#include <cmath>
#include <csignal>
#include <filesystem>

#include "base/pending_file.hpp"
#include "base/time.hpp"
#include "engine/midi/midi_port.hpp"
#include "tests/end_to_end/program_fixture.hpp"
#include "tests/support/jack_midi_peer.hpp"
#include "tests/support/jack_server.hpp"
#include "tests/support/server_start.hpp"

namespace raks::test {
namespace {

using engine::MidiClock;
using std::chrono::seconds;

constexpr double kRate = 48'000.0;

/// One start, a stop at the end, and clocks at an even tempo: off by a sample at most, as is the
/// interval itself by a fifth. Returns the sample of the start.
std::int64_t expect_even_clock(const std::vector<JackMidiPeer::Byte>& bytes, double bpm) {
    EXPECT_GE(bytes.size(), 100U);
    EXPECT_EQ(bytes.back().byte, MidiClock::kStop);
    const double ideal = kRate * 60.0 / bpm / 24.0;
    std::size_t starts = 0;
    std::int64_t start = 0;
    std::int64_t last = 0;
    for (const auto& [sample, byte] : bytes) {
        if (byte == MidiClock::kStart) {
            ++starts;
            start = sample;
        } else if (byte == MidiClock::kClock) {
            if (starts > 0 && last > 0) {
                EXPECT_NEAR(static_cast<double>(sample - last), ideal, 1.25);
            }
            last = sample;
        }
    }
    EXPECT_EQ(starts, 1U);
    return start;
}

TEST(MidiOnJack, a_held_clock_ticks_to_the_sample_and_starts_on_count_1) {
    JackServer jack;
    ASSERT_EQ(jack.problem(), "");
    JackMidiPeer peer("probe");
    ASSERT_TRUE(peer.is_running());
    auto port = engine::open_midi_clock_port("probe", 24);
    ASSERT_TRUE(port) << port.error().message;
    engine::MidiClockBeats beats;
    beats.anchor = host_now() + std::chrono::milliseconds(700);
    beats.beats_per_second = 121.3 / 60.0;
    beats.is_followed = beats.is_held = true;
    const double before = peer.sample_at(beats.anchor);
    for (int turn = 0; turn < 10 && peer.bytes().size() < 300; ++turn) {
        (*port)->follow(beats);
        static_cast<void>(peer.wait_for_bytes(300, seconds(1)));
    }
    const double one = peer.sample_at(beats.anchor);
    port->reset();
    // A server without a device may be slower than the beats' own clock.
    if (peer.xruns() > 0 || std::abs(one - before) > 0.5e-3 * kRate) {
        GTEST_SKIP() << "the server lost time";
    }
    const auto start = expect_even_clock(peer.bytes(), 121.3);
    const double bar = 4.0 * kRate / beats.beats_per_second;
    EXPECT_NEAR(std::remainder(static_cast<double>(start) - one, bar) / kRate, 0.0, 1e-3);
}

TEST(MidiOnJack, a_knob_box_is_heard_also_when_it_comes_later) {
    JackServer jack;
    ASSERT_EQ(jack.problem(), "");
    auto port = engine::open_midi_input_port("BOX");
    ASSERT_TRUE(port) << port.error().message;
    EXPECT_EQ((*port)->device(), "");
    JackMidiPeer box("knobbox");
    ASSERT_TRUE(box.is_running());
    ASSERT_TRUE(box.wait_for_listener(seconds(10)));
    const HostTime before = host_now();
    box.send({0xB0, 21, 64});
    box.send({0x99, 36, 100});
    engine::MidiMessage message;
    std::vector<engine::MidiMessage> heard;
    EXPECT_TRUE(wait_for_answer([&] {
        while ((*port)->take(message)) {
            heard.push_back(message);
        }
        return heard.size() >= 2;
    }));
    ASSERT_EQ(heard.size(), 2U);
    EXPECT_EQ(heard[0].kind, engine::MidiMessage::Kind::control);
    EXPECT_EQ(heard[0].number, 21);
    EXPECT_EQ(heard[0].value, 64);
    EXPECT_EQ(heard[1].kind, engine::MidiMessage::Kind::note);
    EXPECT_EQ(heard[1].channel, 10);
    EXPECT_NEAR(to_seconds(heard[0].came - before), 0.0, 0.1);
    EXPECT_EQ((*port)->device(), "knobbox:out");
}

class MidiProgram : public ProgramTest {};

TEST_F(MidiProgram, takes_a_tempo_from_a_pad_and_gives_it_as_a_clock) {
    JackServer jack;
    ASSERT_EQ(jack.problem(), "");
    JackMidiPeer box("box");
    ASSERT_TRUE(box.is_running());
    std::filesystem::create_directories(path("state/raks"));
    ASSERT_TRUE(
        write_file(path("state/raks/midi.toml"),
                   "format = \"raks-midi\"\nversion = 1\n[[control]]\ndevice = \"box:out\"\n"
                   "message = \"note\"\nchannel = 1\nnumber = 36\naction = \"tempo\"\n"
                   "by = \"press\"\nvalue = 1\n"));
    ProcessPlan server = plan({"live", "--no-avatar", "--device", "system"});
    server.command.insert(server.command.end(), {"--midi-clock", "BOX", "--midi-in", "box"});
    std::erase_if(server.environment,
                  [](const auto& pair) { return pair.first == "JACK_DEFAULT_SERVER"; });
    CapturedProcess raks(server);
    ASSERT_TRUE(raks.wait_for_output("MIDI is heard from box:out"));
    box.send({0x90, 36, 100});
    ASSERT_TRUE(raks.wait_for_output("tempo held at 121.0 BPM"));
    ASSERT_TRUE(box.wait_for_bytes(200, seconds(20)));
    raks.send(SIGINT);
    const ProcessResult result = raks.wait();
    EXPECT_EQ(result.exit_code, 130) << result.err;
    if (box.xruns() > 0) {
        GTEST_SKIP() << "the server lost samples";
    }
    expect_even_clock(box.bytes(), 121.0);
}

TEST_F(MidiProgram, says_in_one_line_that_nothing_here_has_midi) {
    if (std::filesystem::exists("/dev/snd/seq")) {
        GTEST_SKIP() << "ALSA has MIDI here";
    }
    write_clicks("clicks.wav", 1.0);
    for (const char* option : {"--midi-clock", "--midi-in"}) {
        expect_one_line({"play", "--no-sound", "--headless", path("clicks.wav"), option, "box"},
                        1,
                        std::string(option) + " box: no JACK server runs");
    }
}

TEST_F(MidiProgram, says_what_is_wrong_with_what_was_taught) {
    std::filesystem::create_directories(path("state/raks"));
    ASSERT_TRUE(write_file(path("state/raks/midi.toml"), "format = \"raks-midi\"\nversion = 7\n"));
    expect_one_line(
        {"play", "--no-sound", "--headless", "--midi-in", "box"}, 1, "midi.toml: version");
}

}  // namespace
}  // namespace raks::test
