// Programs of others are told of the music, and obey: QLC+ by OS2L and OSC, liblo's oscdump, npm's
// osc and os2l, a light of WLED and a marionette of VMC in Python. Others ask for actions: npm's
// ws, Chromium. A program that is missing skips its test; with RAKS_RECEIVERS=required it fails.
#include <gtest/gtest.h>

#include <chrono>
#include <cmath>
#include <cstdlib>
#include <filesystem>
#include <nlohmann/json.hpp>
#include <optional>
#include <set>
#include <sstream>

#include "audio/io/wav_writer.hpp"
#include "base/file.hpp"
#include "tests/end_to_end/program_fixture.hpp"
#include "tests/support/jack_server.hpp"
#include "tests/support/peers.hpp"
#include "tests/support/xvfb.hpp"

namespace raks::test {
namespace {

const std::string kFolder = std::string(RAKS_SOURCE_DIR) + "/tests/receivers/";

class Receivers : public ProgramTest {
 protected:
    /// False: the test ends, as the program is not here.
    [[nodiscard]] static bool has(const std::string& program) {
        ProcessPlan plan;
        plan.command = {"which", program};
        if (run_process(plan).exit_code == 0) {
            return true;
        }
        const char* const wanted = std::getenv("RAKS_RECEIVERS");  // NOLINT(concurrency-mt-unsafe)
        EXPECT_TRUE(wanted == nullptr || std::string(wanted) != "required")
            << program << " is not installed";
        return false;
    }
    void write_drums(double seconds) const {
        audio::MusicPlan plan;
        plan.style = audio::Style::drums;
        plan.tempo = {{0.0, 120.0}};
        plan.seconds = seconds;
        write_music("drums.wav", plan);
    }
    void write_silence(const std::string& name, double seconds) const {
        const auto samples = static_cast<std::size_t>(seconds * 16'000.0);
        const auto written = audio::write_wav(
            path(name), std::vector<float>(samples, 0.0F), 1, SampleRate(16'000.0));
        ASSERT_TRUE(written) << written.error().message;
    }
    [[nodiscard]] std::vector<std::string> play(std::vector<std::string> more) const {
        std::vector<std::string> words{
            "play", "--no-sound", "--headless", "--quit", path("drums.wav"), "--lines", "-"};
        words.insert(words.end(), more.begin(), more.end());
        return words;
    }
    /// The folder of our scripts with the packages of npm that they need; nothing: they cannot be
    /// had.
    [[nodiscard]] static std::optional<std::string> fetch_npm() {
        namespace fs = std::filesystem;
        if (!has("node") || !has("npm")) {
            return std::nullopt;
        }
        const fs::path packages = fs::path(RAKS_BINARY_DIR) / "tests" / "receivers" / "packages";
        fs::create_directories(packages);
        for (const char* name : {"package.json",
                                 "package-lock.json",
                                 "npm_receivers.mjs",
                                 "remote_hand.mjs",
                                 "remote_page.mjs"}) {
            fs::copy_file(kFolder + name, packages / name, fs::copy_options::overwrite_existing);
        }
        ProcessPlan fetch;
        fetch.command = {
            "npm", "ci", "--ignore-scripts", "--omit=optional", "--no-audit", "--no-fund"};
        fetch.folder = packages.string();
        fetch.timeout = std::chrono::seconds(200);
        return run_process(fetch).exit_code == 0 ? std::optional(packages.string()) : std::nullopt;
    }
    static std::size_t beats_in(const std::string& lines) {
        std::istringstream stream(lines);
        std::size_t beats = 0;
        for (std::string line; std::getline(stream, line);) {
            beats += nlohmann::json::parse(line)["do"] == "beat" ? 1U : 0U;
        }
        return beats;
    }
};

// "#  clock:    993.75 samples   ..": only that it reads our clock's tempo.
TEST_F(Receivers, jack_mclk_dump_reads_the_tempo_of_the_clock) {
    if (!has("jack_mclk_dump")) {
        GTEST_SKIP() << "jack_mclk_dump (jack-midi-clock) is not installed";
    }
    JackServer jack;
    ASSERT_EQ(jack.problem(), "");
    write_drums(60.0);
    const auto on_jack = [&](std::vector<std::string> words) {
        ProcessPlan program = plan(std::move(words));
        std::erase_if(program.environment,
                      [](const auto& pair) { return pair.first == "JACK_DEFAULT_SERVER"; });
        return program;
    };
    ProcessPlan dump;
    dump.command = {"stdbuf", "-oL", "jack_mclk_dump", "-n"};
    CapturedProcess listener(dump);
    CapturedProcess player(
        on_jack({"play", path("drums.wav"), "--headless", "--midi-clock", "mclk_in"}));
    EXPECT_TRUE(listener.wait_for_output("120.0"));
    player.send(SIGINT);
    EXPECT_EQ(player.wait().exit_code, 130);
    listener.send(SIGTERM);
    static_cast<void>(listener.wait());
}

TEST_F(Receivers, oscdump_reads_every_message) {
    if (!has("oscdump")) {
        GTEST_SKIP() << "oscdump (liblo-tools) is not installed";
    }
    write_drums(8.0);
    const std::string port = std::to_string(UdpReceiver().port());
    ProcessPlan dump;
    dump.command = {"oscdump", "-L", port};
    CapturedProcess listener(dump);
    // It says nothing when it listens: what is sent to nobody is refused, so that it is heard when
    // nothing was lost.
    ProcessResult played;
    for (int go = 0; go < 3; ++go) {
        played = run(play({"--osc", "127.0.0.1:" + port + ",rate=5"}));
        if (played.err.find("nobody listens there") == std::string::npos) {
            break;
        }
    }
    EXPECT_EQ(played.exit_code, 0) << played.err;
    ASSERT_TRUE(listener.wait_for_output("/raks/goodbye i 1"));
    listener.send(SIGTERM);
    const std::string said = listener.wait().out;
    std::set<std::string> kinds;
    std::size_t beats = 0;
    std::istringstream lines(said);
    for (std::string time, address, types, line; std::getline(lines, line);) {
        std::istringstream words(line);
        words >> time >> address >> types;
        address.append(" ").append(types);
        kinds.insert(address);
        address.resize(address.find(' '));
        beats += address == "/raks/beat" ? 1U : 0U;
    }
    for (const char* kind : {"/raks/beat iiff",
                             "/raks/trigger/beat f",
                             "/raks/trigger/bar f",
                             "/raks/trigger/phrase f",
                             "/raks/trigger/entry f",
                             "/raks/bpm f",
                             "/raks/energy f",
                             "/raks/part s",
                             "/raks/lock i",
                             "/raks/silence i",
                             "/raks/genre sf",
                             "/raks/figure si",
                             "/raks/phase ff",
                             "/raks/level f",
                             "/raks/bands fff",
                             "/raks/goodbye i"}) {
        EXPECT_TRUE(kinds.contains(kind)) << kind << "\n" << said;
    }
    EXPECT_GE(beats, beats_in(played.out));
}

TEST_F(Receivers, a_light_of_wled_has_50_packets_a_second_and_a_peak_a_beat) {
    if (!has("python3")) {
        GTEST_SKIP() << "python3 is not installed";
    }
    write_drums(8.0);
    const std::string port = std::to_string(UdpReceiver().port());
    ProcessPlan plan;
    plan.command = {"python3", kFolder + "wled_light.py", port, "14"};
    CapturedProcess light(plan);
    ASSERT_TRUE(light.wait_for_output("ready"));
    const ProcessResult played = run(play({"--wled", "127.0.0.1:" + port}));
    EXPECT_EQ(played.exit_code, 0) << played.err;
    const std::string out = light.wait().out;
    const auto said = nlohmann::json::parse(out.substr(out.find('{')));
    EXPECT_EQ(said["wrong"], 0);
    EXPECT_GE(said["packets"], 200);
    EXPECT_EQ(said["loudest"], 255);
    EXPECT_EQ(said["peaks"], beats_in(played.out));
}

TEST_F(Receivers, a_marionette_of_vmc_dances_what_raks_writes_as_bvh) {
    if (!has("python3")) {
        GTEST_SKIP() << "python3 is not installed";
    }
    write_drums(12.0);
    ProcessPlan trial = plan({});
    trial.command = {"python3", kFolder + "vmc_marionette.py", RAKS_PROGRAM, path("drums.wav")};
    trial.timeout = std::chrono::seconds(150);
    const ProcessResult result = run_process(trial);
    ASSERT_EQ(result.exit_code, 0) << result.err;
    const auto said = nlohmann::json::parse(result.out);
    EXPECT_GE(said["frames"], 300);
    EXPECT_EQ(said["bones"], 52);
    EXPECT_EQ(said["right"], true) << "types, and places that are not zero";
    EXPECT_LE(said["longest"], 1'200);
    EXPECT_LE(said["joints_mm"]["worst"], 1.0) << result.out;
    EXPECT_EQ(said["end"]["ok"], 0);
    EXPECT_EQ(said["end"]["faces"], 0.0);
}

TEST_F(Receivers, npm_osc_and_npm_os2l_take_every_beat) {
    const auto packages = fetch_npm();
    if (!has("unshare") || !packages) {
        GTEST_SKIP() << "node, npm or their packages are not here";
    }
    write_drums(10.0);
    ProcessPlan trial = plan({});
    trial.command = {"unshare", "-n", "node", "npm_receivers.mjs", RAKS_PROGRAM, path("drums.wav")};
    trial.folder = *packages;
    const ProcessResult result = run_process(trial);
    ASSERT_EQ(result.exit_code, 0) << result.err;
    const auto said = nlohmann::json::parse(result.out);
    EXPECT_GE(said["lines"], 10);
    EXPECT_EQ(said["beats"], said["lines"]) << "os2l: one read is one object";
    EXPECT_EQ(said["messages"]["/raks/beat iiff"], said["lines"]);
    EXPECT_EQ(said["messages"]["/raks/trigger/beat f"], said["lines"]);
    EXPECT_EQ(said["bundles"], said["lines"]);
    EXPECT_EQ(said["warnings"], 0);
}

// In a network of its own, with a display. The taps come 30 +- 10 ms late.
TEST_F(Receivers, npm_ws_asks_for_every_action_and_taps_a_tempo) {
    const auto packages = fetch_npm();
    if (!has("unshare") || !packages) {
        GTEST_SKIP() << "node, npm or their packages are not here";
    }
    write_drums(20.0);
    write_silence("silence.wav", 60.0);
    const Xvfb screen;
    ProcessPlan trial = plan({});
    trial.command = {"unshare",
                     "-n",
                     "sh",
                     "-c",
                     "ip link set lo up && exec node remote_hand.mjs \"$@\"",
                     "sh",
                     RAKS_PROGRAM,
                     path("drums.wav"),
                     path("silence.wav")};
    trial.folder = *packages;
    std::erase(trial.unset, "DISPLAY");
    trial.timeout = std::chrono::seconds(150);
    const ProcessResult result = run_process(trial);
    ASSERT_EQ(result.exit_code, 0) << result.err;
    const auto said = nlohmann::json::parse(result.out);
    EXPECT_GE(said["http"].size(), 40U);
    for (const auto& [name, code] : said["http"].items()) {
        // 202: it is still on its way where the processors are busy.
        EXPECT_TRUE(code == 200 || code == 202) << name << " " << code;
        EXPECT_EQ(said["page"][name], true) << name;
    }
    EXPECT_EQ(said["refused"]["quit"], 400);
    EXPECT_EQ(said["refused"]["path"], 400);
    EXPECT_EQ(said["refused"]["origin"], 403);
    EXPECT_EQ(said["refused"]["handshake"], 403);
    EXPECT_LE(said["clockErrorMs"], 15.0);
    for (const char* way : {"osc", "http", "page"}) {
        EXPECT_LE(said["taps"][way]["off"], 0.005) << way << " " << said["taps"][way];
    }
    EXPECT_LE(std::abs(said["taps"]["page"]["lateMs"].get<double>()), 15.0);
}

TEST_F(Receivers, chromium_shows_the_page_of_a_phone_and_its_buttons_work) {
    const auto packages = fetch_npm();
    if (!has("chromium") || !packages) {
        GTEST_SKIP() << "chromium, node, npm or their packages are not here";
    }
    write_drums(30.0);
    const Xvfb screen;
    ProcessPlan trial = plan({});
    trial.command = {"unshare",
                     "-n",
                     "sh",
                     "-c",
                     "ip link set lo up && exec node remote_page.mjs \"$@\"",
                     "sh",
                     "chromium",
                     RAKS_PROGRAM,
                     path("drums.wav"),
                     (std::filesystem::path(RAKS_BINARY_DIR) / "remote_page.png").string()};
    trial.folder = *packages;
    std::erase(trial.unset, "DISPLAY");
    trial.timeout = std::chrono::seconds(150);
    const ProcessResult result = run_process(trial);
    ASSERT_EQ(result.exit_code, 0) << result.err;
    const auto said = nlohmann::json::parse(result.out);
    EXPECT_TRUE(said["faults"].empty()) << said["faults"];
    EXPECT_EQ(said["outside"], false) << "nothing is fetched from elsewhere";
    EXPECT_EQ(said["size"], "390x844") << "all of it is seen without scrolling";
    EXPECT_EQ(said["flashesUnasked"], 0.0);
    EXPECT_GE(said["flashes"], 2);
    EXPECT_GE(said["quickest"], 500.0) << "at most twice a second";
}

TEST_F(Receivers, qlcplus_obeys_every_beat_by_os2l_and_by_osc) {
    if (!has("qlcplus") || !has("python3") || !has("unshare")) {
        GTEST_SKIP() << "qlcplus is not installed";
    }
    write_drums(14.0);
    const Xvfb screen;
    ProcessPlan trial = plan({});
    trial.command = {
        "unshare", "-n", "python3", kFolder + "light_desk.py", RAKS_PROGRAM, path("drums.wav")};
    std::erase(trial.unset, "DISPLAY");
    trial.timeout = std::chrono::seconds(150);
    const ProcessResult result = run_process(trial);
    ASSERT_EQ(result.exit_code, 0) << result.err;
    const auto said = nlohmann::json::parse(result.out);
    const int beats = said["beats"];
    EXPECT_GE(beats, 20);
    for (const char* protocol : {"os2l", "osc"}) {
        EXPECT_EQ(said[protocol]["obeyed"], beats) << protocol << ": " << result.out;
        EXPECT_EQ(said[protocol]["changes"], beats) << protocol << ": none twice";
    }
}

TEST_F(Receivers, mpv_and_playerctl_say_what_plays_and_pauses) {
    for (const char* program : {"mpv", "playerctl", "pulseaudio", "dbus-daemon", "ffmpeg"}) {
        if (!has(program)) {
            GTEST_SKIP() << program << " is not installed";
        }
    }
    if (run({"live", "--now-playing", "--duration", "0.1", "--headless"})
            .err.find("built without") != std::string::npos) {
        GTEST_SKIP() << "this raks asks no players";
    }
    ProcessPlan trial = plan({});
    trial.command = {"python3", kFolder + "mpv_songs.py", RAKS_PROGRAM, "hands"};
    trial.timeout = std::chrono::seconds(120);
    const ProcessResult result = run_process(trial);
    ASSERT_EQ(result.exit_code, 0) << result.err;
    const auto said = nlohmann::json::parse(result.out);
    // mpv names a file by its own name until it has read its tags.
    const std::set<std::string> titles = said["titles"];
    EXPECT_TRUE(titles.contains("Song 0") && titles.contains("Song 1")) << said["titles"];
    EXPECT_LT(said["pause"], 1'000) << "ms from playerctl's start to the stop";
}

}  // namespace
}  // namespace raks::test
