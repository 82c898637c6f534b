#include "apps/raks/commands.hpp"

#include <cmath>
#include <optional>
#include <utility>
#include <vector>

#include "apps/raks/device_levels.hpp"
#include "apps/terminal/say.hpp"
#include "audio/io/devices.hpp"
#include "base/json.hpp"
#include "base/printable.hpp"
#include "engine/setup/device_offsets.hpp"

#include <fmt/format.h>

namespace raks::apps {
namespace {

// Numbers are those that --device and --output take.
std::string to_json(const std::vector<audio::AudioDevice>& devices,
                    const engine::DeviceOffsets& offsets,
                    const std::vector<std::optional<float>>& levels) {
    Json document = {{"format", "raks-devices"}, {"version", 2}};
    auto& list = document["devices"] = Json::array();
    for (std::size_t i = 0; i < devices.size(); ++i) {
        const audio::AudioDevice& device = devices[i];
        Json entry = {
            {"number", i},
            {"name", device.name},
            {"id", device.id},
            {"host_api", device.host_api},
            {"inputs", device.input_channels},
            {"outputs", device.output_channels},
            {"rate", device.default_rate},
            {"monitor", device.is_monitor},
            {"monitor_of", device.monitor_of},
            {"default", device.is_default_input || device.is_default_output},
            {"offset_ms",
             1e3 * to_seconds(offsets.of(device.name, device.monitor_of).value_or(Nanos(0)))}};
        if (i < levels.size() && levels[i]) {
            entry["level_dbfs"] = std::round(10.0 * static_cast<double>(*levels[i])) / 10.0;
        }
        list.push_back(std::move(entry));
    }
    return document.text(2) + "\n";
}

// A table, and the devices that live and play would choose, with the reasons.
std::string to_text(const std::vector<audio::AudioDevice>& devices,
                    const engine::DeviceOffsets& offsets) {
    if (devices.empty()) {
        return "no audio devices: no sound card, JACK or PulseAudio server was found\n";
    }
    std::string text = "   #  in out   rate  name\n";
    for (std::size_t i = 0; i < devices.size(); ++i) {
        const audio::AudioDevice& device = devices[i];
        const auto offset = offsets.of(device.name, device.monitor_of);
        text += fmt::format("{:4} {:3} {:3} {:6.0f}  {}{}{}\n",
                            i,
                            device.input_channels,
                            device.output_channels,
                            device.default_rate,
                            printable(audio::described(device)),
                            device.is_monitor ? ": what this computer plays" : "",
                            offset ? ", heard " + engine::in_words(*offset) : "");
    }
    if (const auto input = audio::choose_input(devices)) {
        text += "live  " + input->reason + "\n";
    }
    if (const auto output = audio::choose_output(devices)) {
        text += "play  " + output->reason + "\n";
    }
    return text;
}

}  // namespace

ExitCode devices(const DevicesArguments& arguments) {
    const auto system =
        audio::AudioSystem::open(audio::audio_system_of(arguments.settings.audio_system));
    if (!system) {
        return fail(system.error());
    }
    // For scripts: nothing is printed.
    if (arguments.asks_for_output) {
        return audio::choose_output(system->devices()) ? kExitDone : kExitFailed;
    }
    auto offsets = engine::DeviceOffsets::load();
    if (!offsets) {
        complain(offsets.error().message + "; no device's offset is shown");
        offsets = engine::DeviceOffsets();
    }
    if (arguments.as_json) {
        const auto levels = arguments.has_levels ? device_levels(system->devices())
                                                 : std::vector<std::optional<float>>();
        print_json(to_json(system->devices(), *offsets, levels));
    } else {
        print_text(to_text(system->devices(), *offsets));
    }
    return kExitDone;
}

}  // namespace raks::apps
