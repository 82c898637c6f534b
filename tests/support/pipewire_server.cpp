#include "tests/support/pipewire_server.hpp"

#include <csignal>
#include <filesystem>
#include <fstream>

#include "tests/support/pulse_server.hpp"
#include "tests/support/server_start.hpp"

namespace raks::test {
namespace {

namespace fs = std::filesystem;

const fs::path kRoot = fs::path(RAKS_SOURCE_DIR) / "build" / "pipewire" / "usr";

constexpr const char* kSinks = R"(context.objects = [
  { factory = adapter args = { factory.name = support.null-audio-sink node.name = "speakers"
      node.description = "Speakers" media.class = "Audio/Sink" audio.position = "FL,FR"
      priority.session = 2000 object.linger = true } }
  { factory = adapter args = { factory.name = support.null-audio-sink node.name = "headphones"
      node.description = "Headphones" media.class = "Audio/Sink" audio.position = "FL,FR"
      object.linger = true } }
]
)";

}  // namespace

bool PipeWireServer::is_unpacked() { return fs::exists(kRoot / "bin" / "wireplumber"); }

PipeWireServer::PipeWireServer() {
    const fs::path folder = folder_.path();
    const fs::path config = folder / "config" / "pipewire";
    fs::create_directories(config / "pipewire.conf.d");
    fs::create_directories(folder / "pulse");
    fs::permissions(folder, fs::perms::owner_all);
    for (const auto& file : fs::directory_iterator(kRoot / "share" / "pipewire")) {
        if (file.path().extension() == ".conf") {
            fs::copy_file(file.path(), config / file.path().filename());
        }
    }
    std::ofstream(config / "pipewire.conf.d" / "sinks.conf") << kSinks;
    const fs::path libraries = kRoot / "lib" / "x86_64-linux-gnu";
    set_variable("LD_LIBRARY_PATH", libraries);
    set_variable("SPA_PLUGIN_DIR", libraries / "spa-0.2");
    set_variable("PIPEWIRE_MODULE_DIR", libraries / "pipewire-0.3");
    set_variable("PIPEWIRE_CONFIG_DIR", config);
    set_variable("GST_PLUGIN_PATH", libraries / "gstreamer-1.0");
    set_variable("WIREPLUMBER_MODULE_DIR", libraries / "wireplumber-0.4");
    set_variable("WIREPLUMBER_DATA_DIR", kRoot / "share" / "wireplumber");
    set_variable("WIREPLUMBER_CONFIG_DIR", kRoot / "share" / "wireplumber");
    set_variable("XDG_RUNTIME_DIR", folder);
    set_variable("PIPEWIRE_RUNTIME_DIR", folder);
    set_variable("PULSE_RUNTIME_PATH", folder / "pulse");
    set_variable("PULSE_SERVER", "unix:" + (folder / "pulse" / "native").string());
    set_variable("XDG_STATE_HOME", folder / "state");
    set_variable("HOME", folder);
    set_variable("JACK_NO_START_SERVER", "1");
    const std::string bus = "unix:path=" + (folder / "bus").string();
    set_variable("DBUS_SESSION_BUS_ADDRESS", bus);
    bus_ = std::make_unique<ChildProcess>(
        std::vector<std::string>{"dbus-daemon", "--session", "--nofork", "--address=" + bus},
        (folder_ / "bus.log").string());
    start();
}

void PipeWireServer::start() {
    const std::string server = (kRoot / "bin" / "pipewire").string();
    const std::vector<std::vector<std::string>> commands = {
        {server},
        {(kRoot / "bin" / "wireplumber").string()},
        {server, "-c", "pipewire-pulse.conf"}};
    const fs::path socket = folder_ / "pipewire-0";
    fs::remove(socket);
    for (const std::vector<std::string>& command : commands) {
        programs_.push_back(std::make_unique<ChildProcess>(
            command, (folder_ / ("log" + std::to_string(programs_.size()))).string()));
        // WirePlumber ends where there is no PipeWire yet.
        static_cast<void>(wait_for_answer([&] { return fs::exists(socket); }));
    }
    // Ready when WirePlumber has made the sinks known.
    if (!wait_for_answer([] { return PulseServer::pactl({"set-default-sink", "speakers"}); })) {
        problem_ = "PipeWire does not start (is dbus-daemon installed?)";
    }
}

void PipeWireServer::kill() {
    while (!programs_.empty()) {
        programs_.back()->end(SIGKILL);
        programs_.pop_back();
    }
}

}  // namespace raks::test
