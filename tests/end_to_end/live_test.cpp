// The program on real sound servers: sound leaves by one process and is heard by another.
#include <gtest/gtest.h>
#include <netinet/in.h>
#include <sched.h>
#include <sys/socket.h>

#include <algorithm>
#include <cmath>
#include <csignal>
#include <cstdint>
#include <filesystem>
#include <fstream>
#include <functional>
#include <optional>
#include <sstream>
#include <string>
#include <vector>

#include "audio/io/wav_writer.hpp"
#include "audio/music/generator/music_generator.hpp"
#include "base/descriptor.hpp"
#include "tests/end_to_end/program_fixture.hpp"
#include "tests/support/jack_server.hpp"
#include "tests/support/peers.hpp"
#include "tests/support/pulse_server.hpp"
#include "tests/support/stall_watch.hpp"
#include "tests/support/text.hpp"

#include <nlohmann/json.hpp>

namespace raks::test {
namespace {

/// Drums at 128 BPM; more than two channels repeat the first two.
void write_drums(const std::string& path, double seconds, int rate = 48'000, int channels = 2) {
    audio::MusicPlan plan;
    plan.style = audio::Style::drums;
    plan.tempo = {{0.0, 128.0}};
    plan.seconds = seconds;
    plan.rate = SampleRate(rate);
    plan.channels = std::min(channels, 2);
    const auto music = audio::generate(plan);
    ASSERT_TRUE(music) << music.error().message;
    std::vector<float> samples;
    samples.reserve(static_cast<std::size_t>(music->frames() * channels));
    for (std::size_t frame = 0; frame < static_cast<std::size_t>(music->frames()); ++frame) {
        for (int channel = 0; channel < channels; ++channel) {
            samples.push_back(music->samples[frame * static_cast<std::size_t>(plan.channels) +
                                             static_cast<std::size_t>(channel % plan.channels)]);
        }
    }
    const auto written = audio::write_wav(path, samples, channels, music->rate);
    ASSERT_TRUE(written) << written.error().message;
}

/// The number behind `word` in what `raks live` says at its end.
double number_after(const std::string& word, const std::string& text) {
    const std::size_t at = text.find(word);
    return at == std::string::npos ? std::nan("") : std::stod(text.substr(at + word.size()));
}
/// "tempo 128.0 BPM"
double tempo_in(const std::string& text) { return number_after("tempo ", text); }
/// "level [#####     ]  -18.2 dBFS"
double level_in(const std::string& text) { return number_after("] ", text); }
/// Softest that the music is heard, also where it pauses; silence is -inf.
constexpr double kHeardDb = -70.0;

/// A server may drop a program that stood still with its machine; that alone makes a run void.
bool has_lost_device(const ProcessResult& result) {
    return result.exit_code == 1 && result.err.find("the device is gone") != std::string::npos;
}

/// What `listen` hears has the tempo of the drums. Blocks that a slow machine drops move the beats:
/// there the tempo is only about that (and still tells one sample rate from another), in one of
/// three goes.
void expect_tempo_of_the_drums(const std::function<std::string()>& listen) {
    std::string heard;
    for (int go = 0; go < 3; ++go) {
        const StallWatch watch;
        heard = listen();
        const bool is_slow = watch.is_machine_slow();
        if (std::abs(tempo_in(heard) - 128.0) <= (is_slow ? 9.0 : 2.0)) {
            return;
        }
        if (!is_slow) {
            break;
        }
    }
    ADD_FAILURE() << "not the drums' 128 BPM: " << (heard.empty() ? "the device is gone" : heard);
}

/// The program with the sound servers of this process instead of none.
class Live : public ProgramTest {
 protected:
    [[nodiscard]] ProcessPlan with_server(const std::string& variable,
                                          std::vector<std::string> arguments) const {
        ProcessPlan result = plan(std::move(arguments));
        std::erase_if(result.environment, [&](const auto& pair) { return pair.first == variable; });
        return result;
    }
};

class LiveOnJack : public Live {
 protected:
    void SetUp() override {
        Live::SetUp();
        start_server(48'000);
        write_drums(path("drums.wav"), 60.0);
    }
    void TearDown() override {
        jack_.reset();
        Live::TearDown();
    }
    void start_server(int rate, int period = 256, int priority = 70) {
        jack_.reset();
        jack_.emplace(rate, period, priority);
        ASSERT_EQ(jack_->problem(), "") << rate << " Hz";
    }
    [[nodiscard]] ProcessPlan with_jack(std::vector<std::string> arguments) const {
        return with_server("JACK_DEFAULT_SERVER", std::move(arguments));
    }

    /// What `live` says after listening to a player for so many seconds. (Every JACK client is an
    /// input of the others: the player's own name is listened to.)
    std::string recording_of_the_player(const std::string& seconds) {
        const ProcessResult heard = run_process(
            with_jack({"live", "--headless", "--device", "raks", "--duration", seconds}));
        EXPECT_NE(heard.err.find("listening to"), std::string::npos)
            << "says what and why: " << heard.err;
        if (has_lost_device(heard)) {
            return {};  // no tempo counts
        }
        EXPECT_EQ(heard.exit_code, 0) << heard.err;
        return heard.err;
    }

    std::optional<JackServer> jack_;
};

TEST_F(LiveOnJack, hears_the_tempo_that_play_plays) {
    CapturedProcess player(with_jack({"play", path("drums.wav"), "--headless"}));
    ASSERT_TRUE(player.wait_for_output("playing"));
    expect_tempo_of_the_drums([&] { return recording_of_the_player("14"); });
    player.send(SIGINT);
    EXPECT_EQ(player.wait().exit_code, 130);
}

TEST_F(LiveOnJack, without_a_dancer_beats_of_the_player_are_told) {
    CapturedProcess player(with_jack({"play", path("drums.wav"), "--headless"}));
    ASSERT_TRUE(player.wait_for_output("playing"));
    UdpReceiver osc;
    const ProcessResult heard = run_process(with_jack({"live",
                                                       "--no-avatar",
                                                       "--device",
                                                       "raks",
                                                       "--duration",
                                                       "12",
                                                       "--lines",
                                                       "-",
                                                       "--osc",
                                                       osc.place()}));
    if (has_lost_device(heard)) {
        GTEST_SKIP() << "the server has dropped a program that stood still";
    }
    EXPECT_EQ(heard.exit_code, 0) << heard.err;
    EXPECT_NE(heard.err.find("nobody dances"), std::string::npos) << heard.err;
    std::size_t triggers = 0;
    for (const std::string& packet : osc.take_all()) {
        triggers += packet.starts_with("/raks/trigger/beat") ? 1U : 0U;
    }
    EXPECT_GE(triggers, 8U) << heard.err;
    EXPECT_EQ(triggers, static_cast<std::size_t>(count_of("\"do\":\"beat\"", heard.out)));
    player.send(SIGINT);
    EXPECT_EQ(player.wait().exit_code, 130);
}

TEST_F(LiveOnJack, without_a_dancer_a_tempo_is_taken_by_osc) {
    CapturedProcess player(with_jack({"play", path("drums.wav"), "--headless"}));
    ASSERT_TRUE(player.wait_for_output("playing"));
    const std::string port = std::to_string(UdpReceiver().port());
    CapturedProcess server(
        with_jack({"live", "--no-avatar", "--device", "raks", "--osc-in", port}));
    ASSERT_TRUE(server.wait_for_output("OSC is heard at 127.0.0.1:" + port));
    const std::string packet(
        "/raks/do/set-tempo\0\0,s\0\0"
        "96.5\0\0\0\0",
        32);
    const Descriptor socket(::socket(AF_INET, SOCK_DGRAM | SOCK_CLOEXEC, 0));
    sockaddr_in to{};
    to.sin_family = AF_INET;
    to.sin_addr.s_addr = htonl(INADDR_LOOPBACK);
    to.sin_port = htons(static_cast<std::uint16_t>(std::stoi(port)));
    EXPECT_EQ(sendto(socket.number,
                     packet.data(),
                     packet.size(),
                     0,
                     reinterpret_cast<const sockaddr*>(&to),
                     sizeof(to)),
              static_cast<ssize_t>(packet.size()));
    EXPECT_TRUE(server.wait_for_output("tempo held at 96.5 BPM"));
    server.send(SIGINT);
    EXPECT_EQ(server.wait().exit_code, 130);
    player.send(SIGINT);
    EXPECT_EQ(player.wait().exit_code, 130);
}

/// The death of a device is told in exactly one line. (What `live` says at its very end, the tempo,
/// and the names of what plays are no news about it.)
void expect_one_line_about_the_death(const std::string& err) {
    EXPECT_EQ(count_of("the device is gone", err), 1) << err;
    std::istringstream lines(err);
    int others = 0;
    for (std::string line; std::getline(lines, line);) {
        const auto says = [&](const char* part) { return line.find(part) != std::string::npos; };
        others += says("the device is gone") || says("raks: listening to") ||
                          says("raks: playing") || says("raks: sound goes to") ||
                          says("raks: tempo")
                      ? 0
                      : 1;
    }
    EXPECT_EQ(others, 0) << err;
}

/// Starts raks so beside a server, kills the server, and ends raks by each of the signals.
void expect_end_after_death(const ProcessPlan& plan, const std::string& running) {
    for (const auto& [signal, code] : {std::pair{SIGINT, 130}, std::pair{SIGTERM, 143}}) {
        JackServer jack;
        ASSERT_EQ(jack.problem(), "");
        CapturedProcess raks(plan);
        ASSERT_TRUE(raks.wait_for_output(running));
        jack.kill();
        ASSERT_TRUE(raks.wait_for_output("the device is gone"));
        raks.send(signal);
        const ProcessResult result = raks.wait();
        EXPECT_FALSE(result.timed_out);
        EXPECT_EQ(result.exit_code, code) << result.err;
        expect_one_line_about_the_death(result.err);
    }
}

TEST_F(LiveOnJack, survives_the_death_of_its_input_and_ends_when_told) {
    expect_end_after_death(with_jack({"live", "--headless", "--device", "system"}), "listening to");
}

TEST_F(LiveOnJack, play_ends_when_told_after_the_death_of_its_loudspeaker) {
    expect_end_after_death(with_jack({"play", path("drums.wav"), "--headless"}), "playing");
}

TEST_F(LiveOnJack, play_pauses_without_its_loudspeaker_and_resumes_at_any_rate) {
    CapturedProcess player(with_jack({"play", path("drums.wav"), "--headless", "--duration", "6"}));
    ASSERT_TRUE(player.wait_for_output("playing"));
    jack_->kill();
    ASSERT_TRUE(player.wait_for_output("the device is gone; pausing until it is back"));
    ASSERT_TRUE(jack_->restart(44'100, 512));
    ASSERT_TRUE(player.wait_for_output("sound goes to 'system' (JACK) again"));
    const ProcessResult result = player.wait();
    EXPECT_FALSE(result.timed_out);
    EXPECT_EQ(result.exit_code, 0) << result.err;
}

TEST_F(LiveOnJack, live_dances_on_without_its_server_and_listens_again_at_any_rate) {
    CapturedProcess raks(
        with_jack({"live", "--headless", "--device", "system", "--duration", "9"}));
    ASSERT_TRUE(raks.wait_for_output("listening to"));
    jack_->kill();
    ASSERT_TRUE(raks.wait_for_output("system: the device is gone; dancing on"));
    ASSERT_TRUE(jack_->restart(96'000, 1024));
    ASSERT_TRUE(raks.wait_for_output("listening to 'system' (JACK) again"));
    const ProcessResult result = raks.wait();
    EXPECT_EQ(result.exit_code, 0) << result.err;
}

TEST_F(LiveOnJack, a_client_that_leaves_is_waited_for) {
    const std::vector<std::string> play = {"play", path("drums.wav"), "--headless"};
    std::optional<CapturedProcess> player(std::in_place, with_jack(play));
    ASSERT_TRUE(player->wait_for_output("playing"));
    CapturedProcess raks(with_jack({"live", "--headless", "--device", "raks", "--duration", "16"}));
    ASSERT_TRUE(raks.wait_for_output("listening to"));
    player->send(SIGINT);
    player->wait();
    ASSERT_TRUE(raks.wait_for_output("raks: has left JACK; waiting until it is back"));
    player.emplace(with_jack(play));
    ASSERT_TRUE(player->wait_for_output("playing"));
    ASSERT_TRUE(raks.wait_for_output("listening to 'raks' (JACK) again"));
    const ProcessResult result = raks.wait();
    EXPECT_EQ(result.exit_code, 0) << result.err;
    EXPECT_GT(level_in(result.err), kHeardDb) << "heard again: " << result.err;
}

/// The real-time priorities of a process' threads by their names; 0: an ordinary one.
std::vector<std::pair<std::string, int>> priorities_of(pid_t pid) {
    std::vector<std::pair<std::string, int>> found;
    const std::string tasks = "/proc/" + std::to_string(pid) + "/task";
    for (const auto& task : std::filesystem::directory_iterator(tasks)) {
        sched_param parameters{};
        std::string name;
        std::getline(std::ifstream(task.path() / "comm"), name);
        if (sched_getparam(std::stoi(task.path().filename()), &parameters) == 0) {
            found.emplace_back(name, parameters.sched_priority);
        }
    }
    return found;
}

// Debian starts the server at 10. Whatever Raks does must not hold up another client.
TEST_F(LiveOnJack, no_thread_of_its_own_comes_before_the_clients_of_the_server) {
    if (jack_->scheduling() != "SCHED_FIFO") {
        GTEST_SKIP() << "without the right to SCHED_FIFO";
    }
    for (const int server : {10, 7}) {
        SCOPED_TRACE(server);
        start_server(48'000, 256, server);
        const int clients = server - 5;
        CapturedProcess raks(with_jack({"live", "--headless", "--device", "system"}));
        ASSERT_TRUE(raks.wait_for_output("listening to"));
        int motion = -1;
        int callback = -1;
        // The motion thread is told by the time that this line comes, and obeys 2 ms later.
        ASSERT_TRUE(raks.wait_until([&](const ProcessResult&) {
            motion = -1;
            callback = -1;
            for (const auto& [name, priority] : priorities_of(raks.pid())) {
                motion = name == "raks-motion" ? priority : motion;
                callback = name != "raks-motion" ? std::max(callback, priority) : callback;
            }
            return motion > 0 && motion < clients;
        })) << motion;
        EXPECT_EQ(callback, clients) << "JACK's own thread calls back";
        raks.send(SIGINT);
        EXPECT_EQ(raks.wait().exit_code, 130);
    }
}

nlohmann::json bench_latency_document(const ProcessResult& result) {
    EXPECT_EQ(result.exit_code, 0) << result.err;
    return nlohmann::json::parse(result.out, nullptr, false);
}

void expect_latency_figures(const nlohmann::json& report) {
    ASSERT_TRUE(report.contains("loop_minus_reported_ms")) << "no loop: " << report["loop"];
    ASSERT_TRUE(report.contains("landing_mean_ms")) << report["landing"];
    EXPECT_LT(report.value("callback_p99_share", 1.0), 0.2);
    // JACK calls the client that listens after the one that plays, in the same cycle.
    EXPECT_NEAR(report["loop_latency_ms"].get<double>(), 0.0, 1.0);
    EXPECT_NEAR(report["loop_minus_reported_ms"].get<double>(), 0.0, 1.0);
    EXPECT_NEAR(report["picture_lead_ms"]["p50"].get<double>(), 0.0, 1.0);
    EXPECT_GE(report["beats_back"].get<double>(), 60.0);
    EXPECT_GE(report["landings"].get<double>(), 15.0);
    EXPECT_LE(report["landings_missing"].get<double>(), 2.0);
    EXPECT_NEAR(report["landing_mean_ms"].get<double>(), 0.0, 15.0);
    for (const char* name : {"osc", "os2l"}) {
        const std::string protocol = name;
        EXPECT_EQ(report[protocol + "_beats_arrived"], report[protocol + "_beats_heard"]) << name;
    }
    EXPECT_LE(report["landing_sd_ms"].get<double>(), 25.0);
    EXPECT_GT(report["landing_abs_ms"]["max"].get<double>(), 0.0);
}

// The figures are those of a machine that kept time; one that did not in any of three runs has
// none, and the test says so by skipping them.
TEST_F(LiveOnJack, bench_latency_measures_the_loop_and_the_landing) {
    if (jack_->scheduling() != "SCHED_FIFO") {
        GTEST_SKIP() << "without SCHED_FIFO the server itself drops blocks";
    }
    for (int attempt = 0; attempt < 3; ++attempt) {
        const StallWatch watch;
        const ProcessResult result =
            run_process(with_jack({"bench", "latency", "--json", "--duration", "24"}));
        if (has_lost_device(result) && watch.is_machine_slow()) {
            continue;
        }
        const auto report = bench_latency_document(result);
        ASSERT_TRUE(report.is_object());
        SCOPED_TRACE(report.dump(2));
        EXPECT_EQ(report.value("callback_scheduling", ""), "SCHED_FIFO");
        EXPECT_EQ(report.value("block_frames", 0.0), 256.0);
        if (!watch.is_machine_slow() && report.value("xruns", 0.0) <= 4.0) {
            return expect_latency_figures(report);
        }
    }
    GTEST_SKIP() << "the machine stood still and lost blocks in each of three runs";
}

TEST_F(LiveOnJack, works_at_every_rate_that_a_server_has) {
    for (const int rate : {8'000, 22'050, 192'000}) {
        start_server(rate);
        CapturedProcess player(with_jack({"play", path("drums.wav"), "--headless"}));
        ASSERT_TRUE(player.wait_for_output("playing")) << rate;
        SCOPED_TRACE(rate);
        expect_tempo_of_the_drums([&] { return recording_of_the_player("7"); });
    }
}

TEST_F(LiveOnJack, play_plays_files_of_every_rate_and_channel_count) {
    const struct {
        int rate;
        int channels;
    } cases[] = {{8'000, 1}, {192'000, 2}, {48'000, 8}};
    for (const auto& c : cases) {
        const std::string file = path("drums" + std::to_string(c.channels) + ".wav");
        write_drums(file, 6.0, c.rate, c.channels);
        CapturedProcess player(with_jack({"play", file, "--headless"}));
        ASSERT_TRUE(player.wait_for_output("playing")) << c.rate;
        CapturedProcess listener(
            with_jack({"live", "--headless", "--device", "raks", "--duration", "3"}));
        const ProcessResult heard = listener.wait();
        EXPECT_GT(level_in(heard.err), kHeardDb) << c.rate << heard.err;
        const ProcessResult played = player.wait();
        EXPECT_EQ(played.exit_code, 0) << c.rate << played.err;
    }
}

/// Full places of each level meter "[####    ]" in the text.
std::vector<long> meters_in(const std::string& text) {
    std::vector<long> bars;
    for (std::size_t at = text.find('['); at != std::string::npos; at = text.find('[', at + 1)) {
        const std::size_t end = text.find(']', at);
        if (end == at + 21) {
            bars.push_back(std::count(text.begin() + static_cast<std::ptrdiff_t>(at),
                                      text.begin() + static_cast<std::ptrdiff_t>(end),
                                      '#'));
        }
    }
    return bars;
}

TEST_F(LiveOnJack, shows_a_meter_in_a_terminal_that_rises_and_falls_with_the_level) {
    audio::MusicPlan music_plan;
    music_plan.style = audio::Style::drums;
    music_plan.tempo = {{0.0, 128.0}};
    music_plan.seconds = 40.0;
    music_plan.silences = {{6.0, 14.0}, {20.0, 28.0}, {34.0, 40.0}};
    const auto music = audio::generate(music_plan);
    ASSERT_TRUE(music) << music.error().message;
    ASSERT_TRUE(audio::write_wav(path("pauses.wav"), music->samples, 2, music->rate));
    CapturedProcess player(with_jack({"play", path("pauses.wav"), "--headless"}));
    ASSERT_TRUE(player.wait_for_output("playing"));
    ProcessPlan in_terminal =
        with_jack({"live", "--headless", "--device", "raks", "--duration", "15"});
    in_terminal.terminal_columns = 80;
    const ProcessResult heard = run_process(in_terminal);
    EXPECT_EQ(heard.exit_code, 0) << heard.err;
    const std::vector<long> bars = meters_in(heard.err);
    ASSERT_GT(bars.size(), 20U) << "several a second";
    const auto loudest = std::max_element(bars.begin(), bars.end());
    EXPECT_GE(*loudest, 10) << heard.err;
    EXPECT_LE(*std::min_element(loudest, bars.end()), 4) << "falls in the silence after it";
}

/// What the computer plays, through a PulseAudio sink whose name for people has spaces.
class LiveOnPulse : public Live {
 protected:
    void SetUp() override {
        Live::SetUp();
        ASSERT_EQ(pulse_.problem(), "");
        write_drums(path("drums.wav"), 60.0);
    }
    [[nodiscard]] ProcessPlan with_pulse(std::vector<std::string> arguments) const {
        return with_server("PULSE_SERVER", std::move(arguments));
    }

    PulseServer pulse_{"Living Room Speakers"};
};

TEST_F(LiveOnPulse, hears_what_the_computer_plays_and_says_why_it_listens_there) {
    ProcessPlan other_program;
    other_program.command = {"paplay", path("drums.wav")};
    CapturedProcess player(other_program);
    const ProcessResult heard = run_process(with_pulse({"live", "--headless", "--duration", "6"}));
    EXPECT_EQ(heard.exit_code, 0) << heard.err;
    EXPECT_NE(heard.err.find("listening to 'Monitor of Living Room Speakers' (PulseAudio): it "
                             "is what this computer plays\n"),
              std::string::npos)
        << heard.err;
    EXPECT_GT(level_in(heard.err), kHeardDb) << heard.err;
}

TEST_F(LiveOnPulse, beside_jack_hears_what_play_plays) {
    const JackServer jack;
    ASSERT_EQ(jack.problem(), "");
    const auto with_both = [this](std::vector<std::string> arguments) {
        ProcessPlan result = with_pulse(std::move(arguments));
        std::erase_if(result.environment,
                      [](const auto& pair) { return pair.first == "JACK_DEFAULT_SERVER"; });
        return result;
    };
    CapturedProcess player(with_both({"play", path("drums.wav"), "--headless"}));
    ASSERT_TRUE(player.wait_for_output(
        "sound goes to 'Living Room Speakers' (PulseAudio): the default output "
        "(JACK is running too: --audio-system jack)\n"));
    ASSERT_TRUE(player.wait_for_output("playing"));
    const ProcessResult heard = run_process(with_both({"live", "--headless", "--duration", "6"}));
    EXPECT_EQ(heard.exit_code, 0) << heard.err;
    EXPECT_GT(level_in(heard.err), kHeardDb) << heard.err;
}

TEST_F(LiveOnPulse, hears_play_through_a_monitor_named_by_words_with_spaces) {
    CapturedProcess player(
        with_pulse({"play", path("drums.wav"), "--headless", "--duration", "9"}));
    ASSERT_TRUE(player.wait_for_output("playing"));
    const ProcessResult heard = run_process(
        with_pulse({"live", "--headless", "--device", "of living room speak", "--duration", "6"}));
    EXPECT_EQ(heard.exit_code, 0) << heard.err;
    EXPECT_NE(heard.err.find("the only name with 'of living room speak'"), std::string::npos)
        << heard.err;
    EXPECT_GT(level_in(heard.err), kHeardDb) << heard.err;
    const ProcessResult played = player.wait();
    EXPECT_EQ(played.exit_code, 0) << "its start is no death: " << played.err;
}

}  // namespace
}  // namespace raks::test
