#include "tests/support/pulse_server.hpp"

#include <csignal>
#include <filesystem>
#include <fstream>
#include <sstream>
#include <utility>

#include "tests/support/run_program.hpp"
#include "tests/support/server_start.hpp"

namespace raks::test {
namespace {

// Arguments of module-null-sink.
std::vector<std::string> sink(const std::string& name, const std::string& description, int rate) {
    return {"module-null-sink",
            "sink_name=" + name,
            "rate=" + std::to_string(rate),
            "channels=2",
            "sink_properties=\"device.description='" + description + "'\""};
}

}  // namespace

PulseServer::PulseServer(std::string description, int rate) : description_(std::move(description)) {
    std::ofstream(folder_ / "asound.conf") << "</usr/share/alsa/alsa.conf>\n"
                                              "pcm.!default { type pulse }\n"
                                              "ctl.!default { type pulse }\n"
                                              "pcm.pulse { type pulse }\n";
    set_variable("PULSE_RUNTIME_PATH", folder_.path().string());
    set_variable("XDG_RUNTIME_DIR", folder_.path().string());
    set_variable("HOME", folder_.path().string());
    set_variable("ALSA_CONFIG_PATH", (folder_ / "asound.conf").string());
    set_variable("PULSE_SERVER", "unix:" + (folder_ / "native").string());
    set_variable("JACK_NO_START_SERVER", "1");
    start(rate);
}

std::unique_ptr<ChildProcess> PulseServer::server(
    const std::string& socket, const std::vector<std::string>& first_sink) const {
    std::string module;
    for (const std::string& word : first_sink) {
        module += (module.empty() ? "" : " ") + word;
    }
    return std::make_unique<ChildProcess>(
        std::vector<std::string>{
            "pulseaudio",
            "-n",
            "--daemonize=no",
            "--exit-idle-time=-1",
            "--realtime=no",
            "--high-priority=no",
            "--disable-shm=yes",
            "--use-pid-file=no",
            "-L",
            "module-native-protocol-unix auth-anonymous=1 socket=" + (folder_ / socket).string(),
            "-L",
            module},
        (folder_ / (socket + ".log")).string());
}

void PulseServer::start(int rate) {
    process_ = server("native", sink("raks_null", description_, rate));
    if (!wait_for_answer([] { return pactl({"info"}); })) {
        problem_ = "pulseaudio does not start (are pulseaudio and pulseaudio-utils installed?)";
        return;
    }
    set_default_sink("raks_null");
}

void PulseServer::add_slow_sink() {
    far_ = server("far", sink("far", "Far", 48'000));
    const std::string address = "unix:" + (folder_ / "far").string();
    if (!wait_for_answer([&] {
            return pactl({"--server=" + address, "info"});
        }) ||
        !pactl({"load-module",
                "module-tunnel-sink",
                "server=" + address,
                "sink=far",
                "latency_msec=300"})) {
        problem_ = "the second server does not start";
    }
}

bool PulseServer::pactl(std::vector<std::string> arguments) {
    arguments.insert(arguments.begin(), "pactl");
    return exit_code_of(arguments) == 0;
}

void PulseServer::add_sink(const std::string& name, const std::string& description, int rate) {
    std::vector<std::string> arguments = sink(name, description, rate);
    arguments.insert(arguments.begin(), "load-module");
    static_cast<void>(pactl(arguments));
}

// A module has no name but its arguments: "12\tmodule-null-sink\tsink_name=raks_null ...".
void PulseServer::remove_sink(const std::string& name) {
    std::istringstream modules(run_program({"pactl", "list", "short", "modules"}));
    for (std::string line; std::getline(modules, line);) {
        if (line.find("sink_name=" + name + " ") != std::string::npos) {
            static_cast<void>(pactl({"unload-module", line.substr(0, line.find('\t'))}));
        }
    }
}

void PulseServer::set_default_sink(const std::string& name) {
    static_cast<void>(pactl({"set-default-sink", name}));
}

void PulseServer::kill() { process_->end(SIGKILL); }

// The socket of a killed server is in the way.
void PulseServer::restart(int rate) {
    std::filesystem::remove(folder_ / "native");
    start(rate);
}

void PulseServer::freeze(bool is_frozen) const { process_->send(is_frozen ? SIGSTOP : SIGCONT); }

}  // namespace raks::test
