// The choice among devices is a pure function of their list, so that tests need no hardware.
#include <algorithm>
#include <cctype>
#include <charconv>
#include <functional>

#include "audio/io/devices.hpp"

namespace raks::audio {
namespace {

using Devices = std::span<const AudioDevice>;

enum class Direction { input, output };

// Whether the device has channels in that direction.
bool can(const AudioDevice& device, Direction direction) {
    return direction == Direction::input ? device.input_channels > 0 : device.output_channels > 0;
}

// Word for messages.
const char* word_for(Direction direction) {
    return direction == Direction::input ? "input" : "output";
}

// For comparisons without regard to case.
std::string lower(std::string_view text) {
    std::string result(text);
    std::transform(result.begin(), result.end(), result.begin(), [](unsigned char c) {
        return static_cast<char>(std::tolower(c));
    });
    return result;
}

// The devices of one direction with their numbers, for error messages: "there are 0 'system'
// (JACK), 2 'USB Mic' (ALSA)", or that there is none.
std::string list_of(Devices devices, Direction direction) {
    std::string list;
    for (std::size_t i = 0; i < devices.size(); ++i) {
        if (can(devices[i], direction)) {
            list += (list.empty() ? "" : ", ") + std::to_string(i) + " " + described(devices[i]);
        }
    }
    return list.empty() ? std::string("there is none") : "there are " + list;
}

// The choice with its reason as the user reads it.
DeviceChoice chosen(const AudioDevice& device, const std::string& why) {
    return {device, described(device) + ": " + why};
}

using Match = std::function<bool(const AudioDevice&)>;

// All devices of that direction that match, in order of the list.
std::vector<const AudioDevice*> all_that(Devices devices, Direction direction, const Match& match) {
    std::vector<const AudioDevice*> found;
    for (const AudioDevice& device : devices) {
        if (can(device, direction) && match(device)) {
            found.push_back(&device);
        }
    }
    return found;
}

// The number that the whole text spells; nothing for other text.
std::optional<std::size_t> number_in(std::string_view text) {
    std::size_t number = 0;
    const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), number);
    const bool is_whole = error == std::errc() && end == text.data() + text.size();
    return is_whole ? std::optional(number) : std::nullopt;
}

// The first two of several devices that a name fits, by what tells them apart.
std::string several(const std::vector<const AudioDevice*>& fitting,
                    const std::string& name,
                    Direction direction,
                    Devices devices) {
    const auto told_apart = [&](const AudioDevice& device) {
        const bool is_unique =
            std::count_if(fitting.begin(), fitting.end(), [&](const AudioDevice* other) {
                return other->name == device.name;
            }) == 1;
        return is_unique ? described(device) : described(device) + " " + device.id;
    };
    return "'" + name + "' fits several " + word_for(direction) + "s: " + told_apart(*fitting[0]) +
           ", " + told_apart(*fitting[1]) +
           "; name one in full or by number: " + list_of(devices, direction);
}

// The device that the user named: first as a number of the list, then as a full name or
// id, then as a part that only one device has. A number beyond the list may still be a
// part of a name.
Expected<DeviceChoice> choose_named(Devices devices, Direction direction, std::string_view wanted) {
    const std::string name(wanted);
    if (const auto number = number_in(wanted); number && *number < devices.size()) {
        if (!can(devices[*number], direction)) {
            return fail("device " + name + " " + described(devices[*number]) + " is no " +
                        word_for(direction) + "; " + list_of(devices, direction));
        }
        return chosen(devices[*number], "number " + name + ", as asked for");
    }
    const std::string low = lower(wanted);
    const auto same = all_that(devices, direction, [&](const AudioDevice& device) {
        return lower(device.name) == low || lower(device.id) == low;
    });
    if (same.size() == 1) {
        return chosen(*same.front(), "as asked for");
    }
    if (same.size() > 1) {
        return fail(several(same, name, direction, devices));
    }
    const auto similar = all_that(devices, direction, [&](const AudioDevice& device) {
        return lower(device.name).find(low) != std::string::npos ||
               lower(device.id).find(low) != std::string::npos;
    });
    if (similar.size() == 1) {
        return chosen(*similar.front(), "the only name with '" + name + "'");
    }
    if (similar.size() > 1) {
        return fail(several(similar, name, direction, devices));
    }
    return fail(std::string("no ") + word_for(direction) + " '" + name + "'; " +
                list_of(devices, direction));
}

// One rule of the automatic choice, and its reason for the user.
struct Preference {
    Match match;
    std::string why;
};

// `play` goes where `live` listens: both prefer the desktop's sound (PulseAudio, PipeWire), which
// is what this computer plays, to JACK. But a sink that a server makes up where it has no
// loudspeaker is heard by nobody.
bool is_made_up(const AudioDevice& device) {
    return device.id == "auto_null" || device.id == "auto_null.monitor";
}
bool is_monitor(const AudioDevice& device) { return device.is_monitor; }
bool is_desktop_monitor(const AudioDevice& device) {
    return device.is_monitor && !is_made_up(device);
}
bool is_desktop_output(const AudioDevice& device) {
    return device.system == AudioSystemKind::pulse && device.is_default_output &&
           !is_made_up(device);
}
bool is_jack_system(const AudioDevice& device) {
    return device.host_api == "JACK" && device.name == "system";
}
bool is_any(const AudioDevice&) { return true; }

// What the person did not choose is said.
std::string or_jack(const char* why, Devices devices) {
    const bool has_jack = std::any_of(devices.begin(), devices.end(), is_jack_system);
    return std::string(why) + (has_jack ? " (JACK is running too: --audio-system jack)" : "");
}

// The first device of the first rule that any device meets.
Expected<DeviceChoice> choose_best(Devices devices,
                                   Direction direction,
                                   std::span<const Preference> preferences) {
    for (const Preference& preference : preferences) {
        const auto found = all_that(devices, direction, preference.match);
        if (!found.empty()) {
            return chosen(*found.front(), preference.why);
        }
    }
    return fail(
        std::string("no audio ") + word_for(direction) +
        " was found; start a sound server (JACK, PulseAudio, PipeWire) or plug a device in");
}

}  // namespace

std::string described(const AudioDevice& device) {
    return "'" + device.name + "' (" + device.host_api + ")";
}

Expected<DeviceChoice> choose_input(Devices devices, std::string_view wanted) {
    if (!wanted.empty()) {
        return choose_named(devices, Direction::input, wanted);
    }
    const Preference preferences[] = {
        {is_desktop_monitor, or_jack("it is what this computer plays", devices)},
        {is_jack_system, "JACK is running and this is its input"},
        {is_monitor, "it is what this computer plays"},
        {[](const AudioDevice& device) { return device.is_default_input; }, "the default input"},
        {is_any, "the first input there is"}};
    return choose_best(devices, Direction::input, preferences);
}

Expected<DeviceChoice> choose_output(Devices devices, std::string_view wanted) {
    if (!wanted.empty()) {
        return choose_named(devices, Direction::output, wanted);
    }
    const Preference preferences[] = {
        {is_desktop_output, or_jack("the default output", devices)},
        {is_jack_system, "JACK is running and this is its output"},
        {[](const AudioDevice& device) { return device.is_default_output; }, "the default output"},
        {is_any, "the first output there is"}};
    return choose_best(devices, Direction::output, preferences);
}

}  // namespace raks::audio
