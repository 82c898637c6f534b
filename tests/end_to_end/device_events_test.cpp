// What happens to a desktop's sound while the program runs: another default, a loudspeaker that is
// unplugged, a server that ends and comes back. Real PulseAudio servers with null sinks.
#include <gtest/gtest.h>

#include <algorithm>
#include <csignal>
#include <string>
#include <tuple>
#include <vector>

#include "audio/music/generator/music_generator.hpp"
#include "tests/end_to_end/program_fixture.hpp"
#include "tests/support/child_process.hpp"
#include "tests/support/pulse_server.hpp"
#include "tests/support/run_program.hpp"
#include "tests/support/text.hpp"

namespace raks::test {
namespace {

/// Two sinks, "Speakers" (the default) and "Headphones" at another rate.
class DeviceEvents : public ProgramTest {
 protected:
    void SetUp() override {
        ASSERT_EQ(pulse_.problem(), "");
        pulse_.add_sink("headphones", "Headphones", 44'100);
        audio::MusicPlan plan;
        plan.style = audio::Style::drums;
        plan.tempo = {{0.0, 128.0}};
        plan.seconds = 60.0;
        write_music("drums.wav", plan);
    }
    [[nodiscard]] ProcessPlan with_pulse(std::vector<std::string> arguments) const {
        ProcessPlan result = plan(std::move(arguments));
        std::erase_if(result.environment,
                      [](const auto& pair) { return pair.first == "PULSE_SERVER"; });
        return result;
    }
    [[nodiscard]] ProcessPlan live(std::vector<std::string> more = {}) const {
        more.insert(more.begin(), {"live", "--headless"});
        return with_pulse(std::move(more));
    }
    [[nodiscard]] ProcessPlan play(std::vector<std::string> more = {}) const {
        more.insert(more.begin(), {"play", path("drums.wav"), "--headless"});
        return with_pulse(std::move(more));
    }
    /// Another program's music on a sink, for as long as this object lives.
    [[nodiscard]] ChildProcess music_on(const std::string& sink) const {
        return ChildProcess({"paplay", "--device=" + sink, path("drums.wav")}, "/dev/null");
    }
    static void expect_good_end(CapturedProcess& raks) {
        raks.send(SIGINT);
        const ProcessResult result = raks.wait();
        EXPECT_EQ(result.exit_code, 130) << result.err;
    }

    PulseServer pulse_{"Speakers"};
};

TEST_F(DeviceEvents, live_follows_the_default_and_back) {
    CapturedProcess raks(live());
    ASSERT_TRUE(raks.wait_for_output("listening to 'Monitor of Speakers' (PulseAudio): it is"));
    pulse_.set_default_sink("headphones");
    ASSERT_TRUE(raks.wait_for_output("listening to 'Monitor of Headphones' (PulseAudio) now"));
    pulse_.set_default_sink("raks_null");
    ASSERT_TRUE(raks.wait_for_output("listening to 'Monitor of Speakers' (PulseAudio) now"));
    expect_good_end(raks);
}

TEST_F(DeviceEvents, the_line_of_the_terminal_names_what_is_heard_now_and_that_it_is_gone) {
    ProcessPlan in_terminal = live();
    in_terminal.terminal_columns = 120;
    CapturedProcess raks(in_terminal);
    ASSERT_TRUE(raks.wait_for_output("\033[KMonitor of Speakers ["));
    pulse_.set_default_sink("headphones");
    ASSERT_TRUE(raks.wait_for_output("\033[KMonitor of Headphones ["));
    pulse_.kill();
    ASSERT_TRUE(raks.wait_for_output("\033[KMonitor of Headphones (the device is gone) ["));
    pulse_.restart(48'000);
    ASSERT_TRUE(raks.wait_for_output("listening to 'Monitor of Speakers' (PulseAudio) now"));
    const std::size_t so_far = raks.output().err.size();
    ASSERT_TRUE(raks.wait_until([&](const ProcessResult& read) {
        return read.err.find("\033[KMonitor of Speakers [", so_far) != std::string::npos;
    }));
    expect_good_end(raks);
}

TEST_F(DeviceEvents, live_stays_where_the_person_named_it) {
    CapturedProcess raks(live({"--device", "Monitor of Speakers", "--duration", "4"}));
    ASSERT_TRUE(raks.wait_for_output("listening to"));
    pulse_.set_default_sink("headphones");
    const ProcessResult result = raks.wait();
    EXPECT_EQ(result.exit_code, 0);
    EXPECT_EQ(result.err.find("Headphones"), std::string::npos) << result.err;
}

TEST_F(DeviceEvents, live_waits_for_the_named_monitor_and_takes_no_microphone) {
    // A microphone, which the server would move a recording to.
    ASSERT_TRUE(PulseServer::pactl({"load-module",
                                    "module-sine-source",
                                    "source_name=mic",
                                    "source_properties=device.description=Microphone"}));
    CapturedProcess raks(live({"--device", "Headphones"}));
    ASSERT_TRUE(raks.wait_for_output("listening to 'Monitor of Headphones'"));
    pulse_.remove_sink("headphones");
    ASSERT_TRUE(raks.wait_for_output("Monitor of Headphones: the device is gone; dancing on"));
    pulse_.add_sink("headphones", "Headphones", 96'000);
    ASSERT_TRUE(raks.wait_for_output("listening to 'Monitor of Headphones' (PulseAudio) again"));
    EXPECT_EQ(raks.output().err.find("Microphone"), std::string::npos) << raks.output().err;
    expect_good_end(raks);
}

TEST_F(DeviceEvents, live_follows_to_the_new_default_when_its_loudspeaker_is_unplugged) {
    CapturedProcess raks(live());
    ASSERT_TRUE(raks.wait_for_output("listening to 'Monitor of Speakers'"));
    pulse_.remove_sink("raks_null");
    ASSERT_TRUE(raks.wait_for_output("listening to 'Monitor of Headphones' (PulseAudio) now"));
    expect_good_end(raks);
}

TEST_F(DeviceEvents, live_listens_again_when_the_server_is_back_and_finds_the_beat) {
    CapturedProcess raks(live({"--duration", "20"}));
    ASSERT_TRUE(raks.wait_for_output("listening to"));
    pulse_.kill();
    ASSERT_TRUE(raks.wait_for_output("Monitor of Speakers: the device is gone; dancing on"));
    pulse_.restart(44'100);
    const ChildProcess music = music_on("raks_null");
    ASSERT_TRUE(raks.wait_for_output("listening to 'Monitor of Speakers' (PulseAudio) again"));
    const ProcessResult result = raks.wait();
    EXPECT_EQ(result.exit_code, 0) << result.err;
    EXPECT_NE(result.err.find("tempo 12"), std::string::npos) << result.err;
}

TEST_F(DeviceEvents, live_says_which_other_monitor_has_sound) {
    const ChildProcess music = music_on("headphones");
    CapturedProcess raks(live());
    ASSERT_TRUE(raks.wait_for_output(
        "nothing is heard from 'Monitor of Speakers', but 'Monitor of Headphones' has sound: "
        "--device \"Monitor of Headphones\" listens there"));
    expect_good_end(raks);
}

TEST_F(DeviceEvents, a_suspended_loudspeaker_is_silence_and_not_the_end) {
    CapturedProcess raks(live({"--duration", "5"}));
    ASSERT_TRUE(raks.wait_for_output("listening to"));
    EXPECT_TRUE(PulseServer::pactl({"suspend-sink", "raks_null", "1"}));
    const ProcessResult result = raks.wait();
    EXPECT_EQ(result.exit_code, 0) << "stream time goes on: " << result.err;
    EXPECT_EQ(result.err.find("gone"), std::string::npos) << result.err;
}

TEST_F(DeviceEvents, live_that_was_stopped_goes_on) {
    CapturedProcess raks(live({"--duration", "6"}));
    ASSERT_TRUE(raks.wait_for_output("listening to"));
    raks.send(SIGSTOP);
    static_cast<void>(run_program({"sleep", "3"}));
    raks.send(SIGCONT);
    const ProcessResult result = raks.wait();
    EXPECT_EQ(result.exit_code, 0) << result.err;
    EXPECT_FALSE(result.timed_out);
}

TEST_F(DeviceEvents, play_follows_the_default_and_where_the_mixer_moves_it) {
    CapturedProcess raks(play());
    ASSERT_TRUE(raks.wait_for_output("sound goes to 'Speakers' (PulseAudio): the default output"));
    ASSERT_TRUE(raks.wait_for_output("playing"));
    pulse_.set_default_sink("headphones");
    ASSERT_TRUE(raks.wait_for_output("sound goes to 'Headphones' (PulseAudio) now"));
    const std::string inputs = run_program({"pactl", "list", "short", "sink-inputs"});
    EXPECT_TRUE(
        PulseServer::pactl({"move-sink-input", inputs.substr(0, inputs.find('\t')), "raks_null"}));
    ASSERT_TRUE(raks.wait_for_output("sound goes to 'Speakers' (PulseAudio) now"));
    expect_good_end(raks);
}

TEST_F(DeviceEvents, a_buffer_that_grew_stays_so_for_the_songs_that_follow) {
    audio::MusicPlan plan;
    plan.style = audio::Style::drums;
    plan.seconds = 5.0;
    write_music("one.wav", plan);
    write_music("two.wav", plan);
    CapturedProcess raks(with_pulse({"play", path("one.wav"), path("two.wav"), "--headless"}));
    // Stopped for longer than its buffer lasts, in each song.
    for (const char* song : {"one.wav", "two.wav"}) {
        ASSERT_TRUE(raks.wait_for_output("playing " + path(song)));
        static_cast<void>(run_program({"sleep", "1"}));
        raks.send(SIGSTOP);
        static_cast<void>(run_program({"sleep", "1"}));
        raks.send(SIGCONT);
    }
    const ProcessResult result = raks.wait();
    EXPECT_EQ(result.exit_code, 0) << result.err;
    // In the second song it begins with what it had grown to: it grows beyond, or not at all.
    EXPECT_EQ(count_of("the sound had a gap: its buffer is longer from now on, 80 ms", result.err),
              1)
        << result.err;
}

TEST_F(DeviceEvents, a_song_begins_where_the_one_before_was_sent) {
    audio::MusicPlan plan;
    plan.style = audio::Style::drums;
    plan.seconds = 5.0;
    write_music("one.wav", plan);
    write_music("two.wav", plan);
    CapturedProcess raks(with_pulse({"play", path("one.wav"), path("two.wav"), "--headless"}));
    ASSERT_TRUE(raks.wait_for_output("playing " + path("one.wav")));
    pulse_.set_default_sink("headphones");
    const std::string moved = "sound goes to 'Headphones' (PulseAudio) now";
    ASSERT_TRUE(raks.wait_for_output(moved));
    const ProcessResult result = raks.wait();
    EXPECT_EQ(result.exit_code, 0) << result.err;
    EXPECT_NE(result.err.find("playing " + path("two.wav")), std::string::npos) << result.err;
    EXPECT_EQ(count_of(moved, result.err), 1) << "it was there already: " << result.err;
}

TEST_F(DeviceEvents, play_waits_for_the_named_loudspeaker) {
    CapturedProcess raks(play({"--output", "Headphones", "--duration", "8"}));
    ASSERT_TRUE(raks.wait_for_output("playing"));
    pulse_.remove_sink("headphones");
    ASSERT_TRUE(raks.wait_for_output("Headphones: the device is gone; pausing until it is back"));
    pulse_.add_sink("headphones", "Headphones", 48'000);
    ASSERT_TRUE(raks.wait_for_output("sound goes to 'Headphones' (PulseAudio) again"));
    EXPECT_EQ(raks.wait().exit_code, 0) << "all is well at the end";
}

TEST_F(DeviceEvents, play_goes_to_the_other_loudspeaker_when_its_own_is_unplugged) {
    CapturedProcess raks(play());
    ASSERT_TRUE(raks.wait_for_output("playing"));
    pulse_.remove_sink("raks_null");
    ASSERT_TRUE(raks.wait_for_output("sound goes to 'Headphones' (PulseAudio) now"));
    expect_good_end(raks);
}

TEST_F(DeviceEvents, play_pauses_while_the_server_is_away) {
    CapturedProcess raks(play({"--duration", "6"}));
    ASSERT_TRUE(raks.wait_for_output("playing"));
    pulse_.kill();
    ASSERT_TRUE(raks.wait_for_output("Speakers: the device is gone; pausing until it is back"));
    pulse_.restart(96'000);
    ASSERT_TRUE(raks.wait_for_output("sound goes to 'Speakers' (PulseAudio) again"));
    EXPECT_EQ(raks.wait().exit_code, 0);
}

TEST_F(DeviceEvents, without_its_device_at_the_end_the_work_has_failed) {
    CapturedProcess raks(live({"--duration", "4"}));
    ASSERT_TRUE(raks.wait_for_output("listening to"));
    pulse_.kill();
    const ProcessResult result = raks.wait();
    EXPECT_EQ(result.exit_code, 1) << result.err;
}

TEST_F(DeviceEvents, a_name_that_fits_two_devices_is_refused_in_one_line) {
    const ProcessResult result = run_process(live({"--device", "Monitor"}));
    EXPECT_EQ(result.exit_code, 1);
    EXPECT_TRUE(is_one_error_line(result.err)) << result.err;
    EXPECT_NE(result.err.find("'Monitor' fits several inputs: 'Monitor of Speakers' (PulseAudio), "
                              "'Monitor of Headphones' (PulseAudio)"),
              std::string::npos)
        << result.err;
}

TEST_F(DeviceEvents, a_server_that_never_answers_is_given_up_in_one_line) {
    pulse_.freeze(true);
    for (const char* command : {"live", "devices"}) {
        ProcessPlan plan = with_pulse({command});
        const ProcessResult result = run_process(plan);
        EXPECT_EQ(result.exit_code, 1) << command;
        EXPECT_TRUE(is_one_error_line(result.err)) << result.err;
        EXPECT_NE(result.err.find("accepts but does not answer"), std::string::npos) << result.err;
    }
    pulse_.freeze(false);
}

TEST_F(DeviceEvents, a_system_that_does_not_run_is_said_in_one_line) {
    for (const auto& [system, exit_code, part] :
         {std::tuple{"jack", 1, "no JACK server is running"},
          std::tuple{"pipewire", 2, "audio.audio_system \"pipewire\" is unknown"}}) {
        const ProcessResult result = run_process(live({"--audio-system", system}));
        EXPECT_EQ(result.exit_code, exit_code) << system;
        EXPECT_TRUE(is_one_error_line(result.err)) << result.err;
        EXPECT_NE(result.err.find(part), std::string::npos) << result.err;
    }
}

TEST_F(DeviceEvents, portaudio_plays_by_alsa_when_asked_for_and_prints_nothing) {
    const ProcessResult result = run_process(
        play({"--audio-system", "portaudio", "--output", "default", "--duration", "2"}));
    EXPECT_EQ(result.exit_code, 0) << result.err;
    EXPECT_EQ(result.err,
              "raks: sound goes to 'default' (ALSA): as asked for\nraks: playing " +
                  path("drums.wav") + "\n");
}

}  // namespace
}  // namespace raks::test
