#include "tests/support/pulse_server.hpp"

#include <cstdlib>
#include <ctime>
#include <fstream>

namespace raks::test {
namespace {

void set_variable(const char* name, const std::string& value) {
    setenv(name, value.c_str(), 1);  // NOLINT(concurrency-mt-unsafe)
}

}  // namespace

PulseServer::PulseServer(const std::string& description) {
    std::ofstream(folder_ / "asound.conf") << "</usr/share/alsa/alsa.conf>\n"
                                              "pcm.!default { type pulse }\n"
                                              "ctl.!default { type pulse }\n"
                                              "pcm.pulse { type pulse }\n";
    const std::string socket = (folder_ / "native").string();
    set_variable("PULSE_RUNTIME_PATH", folder_.path().string());
    set_variable("XDG_RUNTIME_DIR", folder_.path().string());
    set_variable("HOME", folder_.path().string());
    set_variable("ALSA_CONFIG_PATH", (folder_ / "asound.conf").string());
    set_variable("PULSE_SERVER", "unix:" + socket);
    set_variable("JACK_NO_START_SERVER", "1");
    process_ = std::make_unique<ChildProcess>(
        std::vector<std::string>{"pulseaudio",
                                 "-n",
                                 "--daemonize=no",
                                 "--exit-idle-time=-1",
                                 "--realtime=no",
                                 "--high-priority=no",
                                 "--disable-shm=yes",
                                 "-L",
                                 "module-native-protocol-unix socket=" + socket,
                                 "-L",
                                 "module-null-sink sink_name=raks_null rate=48000 channels=2 "
                                 "sink_properties=\"device.description='" +
                                     description + "'\""},
        (folder_ / "log").string());
    // The server has no "ready" to wait for but its answer.
    for (int i = 0; i < 100; ++i) {
        if (exit_code_of({"pactl", "info"}) == 0) {
            exit_code_of({"pactl", "set-default-sink", "raks_null"});
            return;
        }
        const timespec pause{0, 50'000'000};
        nanosleep(&pause, nullptr);
    }
    problem_ = "pulseaudio does not start (are pulseaudio and pulseaudio-utils installed?)";
}

}  // namespace raks::test
