#include "audio/io/devices.hpp"

#include <algorithm>
#include <array>
#include <iterator>
#include <utility>

#include "audio/io/jack_devices.hpp"
#include "audio/io/portaudio_session.hpp"
#include "audio/io/pulse_devices.hpp"

namespace raks::audio {
namespace {

constexpr std::array<std::pair<AudioSystemKind, std::string_view>, 4> kWords = {{
    {AudioSystemKind::automatic, "auto"},
    {AudioSystemKind::portaudio, "portaudio"},
    {AudioSystemKind::jack, "jack"},
    {AudioSystemKind::pulse, "pulse"},
}};

// Whether devices of `part` belong into a list of `kind`.
bool includes(AudioSystemKind kind, AudioSystemKind part) {
    return kind == part || kind == AudioSystemKind::automatic;
}

}  // namespace

std::string_view name_of(AudioSystemKind kind) noexcept {
    return std::find_if(
               kWords.begin(), kWords.end(), [&](const auto& each) { return each.first == kind; })
        ->second;
}

AudioSystemKind audio_system_of(std::string_view word) noexcept {
    const auto found = std::find_if(
        kWords.begin(), kWords.end(), [&](const auto& each) { return each.second == word; });
    return found == kWords.end() ? AudioSystemKind::automatic : found->first;
}

Expected<AudioSystem> AudioSystem::open(AudioSystemKind kind) {
    AudioSystem system;
    if (auto added = system.add_servers(kind); !added) {
        return fail(added.error());
    }
    if (auto added = system.add_portaudio(kind); !added) {
        return fail(added.error());
    }
    return system;
}

// A server that hangs is an error only where it leaves nothing to choose from: PortAudio would go
// to the same server, and hang.
Expected<void> AudioSystem::add_servers(AudioSystemKind kind) {
    std::optional<Error> problem;
    const auto add = [&](AudioSystemKind part, Expected<std::vector<AudioDevice>> (*list)()) {
        if (!includes(kind, part)) {
            return;
        }
        auto found = list();
        if (!found) {
            problem = found.error();
        } else if (found->empty() && kind == part) {
            problem = Error{std::string("no ") +
                            (part == AudioSystemKind::jack ? "JACK" : "PulseAudio or PipeWire") +
                            " server is running; start it, or leave --audio-system out"};
        } else {
            std::move(found->begin(), found->end(), std::back_inserter(devices_));
        }
    };
    add(AudioSystemKind::jack, list_jack_devices);
    add(AudioSystemKind::pulse, list_pulse_devices);
    return problem && devices_.empty() ? Expected<void>(fail(*problem)) : Expected<void>();
}

// PortAudio's own JACK is left to those who ask for PortAudio by name.
Expected<void> AudioSystem::add_portaudio(AudioSystemKind kind) {
    if (!devices_.empty() || !includes(kind, AudioSystemKind::portaudio)) {
        return {};
    }
    if (auto acquired = acquire_portaudio(); !acquired) {
        return acquired;
    }
    uses_portaudio_ = true;
    devices_ = list_portaudio_devices();
    if (kind == AudioSystemKind::automatic) {
        std::erase_if(devices_,
                      [](const AudioDevice& device) { return device.host_api == "JACK"; });
    }
    return {};
}

AudioSystem::AudioSystem(AudioSystem&& other) noexcept
    : uses_portaudio_(std::exchange(other.uses_portaudio_, false)),
      devices_(std::move(other.devices_)) {}

AudioSystem& AudioSystem::operator=(AudioSystem&& other) noexcept {
    std::swap(uses_portaudio_, other.uses_portaudio_);
    devices_ = std::move(other.devices_);
    return *this;
}

AudioSystem::~AudioSystem() {
    if (uses_portaudio_) {
        release_portaudio();
    }
}

}  // namespace raks::audio
