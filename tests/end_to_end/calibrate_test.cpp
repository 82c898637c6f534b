// Latencies as a person meets them: measured, kept for each device, shown and danced to.
#include <fcntl.h>
#include <gtest/gtest.h>
#include <sys/stat.h>
#include <unistd.h>

#include <cmath>
#include <filesystem>
#include <fstream>
#include <optional>
#include <string>
#include <vector>

#include "base/file.hpp"
#include "tests/end_to_end/program_fixture.hpp"
#include "tests/support/jack_delay.hpp"
#include "tests/support/jack_server.hpp"
#include "tests/support/pulse_server.hpp"
#include "tests/support/stall_watch.hpp"

namespace raks::test {
namespace {

/// A JACK server with a client of a known delay between what is played to it and what it gives.
class Calibrate : public ProgramTest {
 protected:
    static constexpr std::size_t kDelay = 14'400;  // 300 ms

    void SetUp() override {
        ASSERT_EQ(jack_.problem(), "");
        delay_.emplace("delay", kDelay);
        ASSERT_TRUE(delay_->is_running());
    }
    void TearDown() override { delay_.reset(); }
    [[nodiscard]] ProcessPlan with_jack(std::vector<std::string> arguments) const {
        ProcessPlan result = plan(std::move(arguments));
        std::erase_if(result.environment,
                      [](const auto& pair) { return pair.first == "JACK_DEFAULT_SERVER"; });
        return result;
    }
    [[nodiscard]] ProcessResult run_with_jack(std::vector<std::string> arguments) const {
        return run_process(with_jack(std::move(arguments)));
    }
    [[nodiscard]] std::string offsets_file() const { return path("state/raks/devices.toml"); }

    JackServer jack_;
    std::optional<JackDelay> delay_;
};

/// The number in "offset_ms = 300.021".
double offset_in(const std::string& toml) {
    const std::size_t at = toml.find("offset_ms = ");
    return at == std::string::npos ? std::nan("") : std::stod(toml.substr(at + 12));
}

TEST_F(Calibrate, a_loop_of_known_length_is_measured_kept_shown_and_forgotten) {
    ProcessResult result;
    // A server on a machine that stands still drops blocks.
    for (int go = 0; go < 3; ++go) {
        const StallWatch watch;
        result = run_with_jack({"calibrate", "--loop", "--output", "delay", "--device", "delay"});
        if (result.exit_code == 0 || !watch.is_machine_slow()) {
            break;
        }
    }
    ASSERT_EQ(result.exit_code, 0) << result.err;
    EXPECT_NE(result.out.find("'delay' (JACK) is heard 300"), std::string::npos) << result.out;
    const auto kept = read_file(offsets_file());
    ASSERT_TRUE(kept) << kept.error().message;
    EXPECT_NEAR(offset_in(*kept), 300.0, 1.0) << *kept;
    EXPECT_NE(run_with_jack({"devices"}).out.find("'delay' (JACK), heard 300"), std::string::npos);
    EXPECT_EQ(run_with_jack({"calibrate", "--forget", "--output", "delay"}).exit_code, 0);
    EXPECT_EQ(run_with_jack({"devices"}).out.find("heard"), std::string::npos);
}

TEST_F(Calibrate, taps_on_the_clicks_are_measured) {
    const std::string taps = path("taps");
    ASSERT_EQ(mkfifo(taps.c_str(), 0600), 0);
    const int descriptor = open(taps.c_str(), O_RDWR | O_CLOEXEC);
    ASSERT_GE(descriptor, 0);
    delay_->tap_into(descriptor);
    ProcessPlan shell = with_jack({});
    shell.command = {
        "sh",
        "-c",
        "exec '" + shell.command.front() + "' calibrate --tap --output delay <'" + taps + "'"};
    const ProcessResult result = run_process(shell);
    delay_->tap_into(-1);
    close(descriptor);
    ASSERT_EQ(result.exit_code, 0) << result.err;
    const std::string kept = read_file(offsets_file()).value_or("");
    // Taps are seen by a thread that is not real-time.
    EXPECT_NEAR(offset_in(kept), 0.0, 30.0) << kept;
    EXPECT_NE(kept.find("measured = \"tap\""), std::string::npos) << kept;
}

TEST_F(Calibrate, taps_that_nobody_makes_are_missed_in_one_line) {
    const ProcessResult result = run_with_jack({"calibrate", "--tap", "--output", "delay"});
    EXPECT_EQ(result.exit_code, 1);
    EXPECT_NE(result.err.find("standard input has ended"), std::string::npos) << result.err;
    EXPECT_FALSE(is_there(offsets_file())) << "nothing was measured";
}

TEST_F(Calibrate, what_is_kept_and_cannot_be_read_is_said_and_not_written_over) {
    const std::string mangled = "format = \"raks-device-offsets\"\nversion = 7\n";
    std::filesystem::create_directories(path("state/raks"));
    std::ofstream(offsets_file()) << mangled;
    const ProcessResult refused =
        run_with_jack({"calibrate", "--loop", "--output", "delay", "--device", "delay"});
    EXPECT_EQ(refused.exit_code, 1);
    EXPECT_TRUE(is_one_error_line(refused.err)) << refused.err;
    EXPECT_NE(refused.err.find("version 7 is not known"), std::string::npos);
    EXPECT_EQ(read_file(offsets_file()).value_or(""), mangled);
    const ProcessResult listed = run_with_jack({"devices"});
    EXPECT_EQ(listed.exit_code, 0);
    EXPECT_NE(listed.err.find("no device's offset is shown"), std::string::npos);
    const ProcessResult danced = run_with_jack({"live", "--headless", "--duration", "0.5"});
    EXPECT_EQ(danced.exit_code, 0) << danced.err;
    EXPECT_NE(danced.err.find("no device's offset is used"), std::string::npos) << danced.err;
}

TEST_F(Calibrate, needs_one_way_to_measure) {
    expect_one_line({"calibrate"}, 2, "--loop");
    expect_one_line({"calibrate", "--loop", "--tap"}, 2, "--tap");
}

class CalibrateOnPulse : public ProgramTest {
 protected:
    /// What is measured by the monitor, in milliseconds: the difference of two reports of the same
    /// server. In one of three goes, as a machine that stands still loses sound.
    [[nodiscard]] double offset_of(const std::string& output) const {
        ProcessPlan calibrate = plan({"calibrate", "--loop", "--output", output});
        std::erase_if(calibrate.environment,
                      [](const auto& pair) { return pair.first == "PULSE_SERVER"; });
        ProcessResult result;
        for (int go = 0; go < 3 && result.exit_code != 0; ++go) {
            result = run_process(calibrate);
        }
        EXPECT_EQ(result.exit_code, 0) << result.err;
        return offset_in(read_file(path("state/raks/devices.toml")).value_or(""));
    }

    PulseServer pulse_{"Speakers"};
};

TEST_F(CalibrateOnPulse, a_monitor_is_heard_when_its_slow_loudspeaker_plays) {
    pulse_.add_slow_sink();
    ASSERT_EQ(pulse_.problem(), "");
    // Without the sink's 300 ms it would be that much earlier.
    EXPECT_NEAR(offset_of("Far"), 0.0, 80.0);
}

}  // namespace
}  // namespace raks::test
