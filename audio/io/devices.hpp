#pragma once

#include <memory>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "base/expected.hpp"

namespace raks::audio {

/// One thing that can be listened to or played on.
struct AudioDevice {
    int portaudio_index = -1;   ///< what PortAudio opens
    std::string name{};         ///< as the user sees it and may type it
    std::string description{};  ///< what desktops call it, where that differs; may be typed too
    std::string host_api{};     ///< "JACK", "ALSA", "OSS", "PulseAudio monitor"
    int input_channels = 0;
    int output_channels = 0;
    double default_rate = 48'000.0;
    bool is_default_input = false;  ///< PortAudio's default of its host API
    bool is_default_output = false;
    /// Not empty: a monitor of what the computer plays; opened through ALSA's `pulse` with
    /// PULSE_SOURCE set to this in our own process.
    std::string pulse_source{};

    [[nodiscard]] bool is_monitor() const noexcept { return !pulse_source.empty(); }
};

/// "'system' (JACK)", "'x.monitor' (PulseAudio monitor, Monitor of Living Room)".
[[nodiscard]] std::string described(const AudioDevice& device);

/// PortAudio, initialized as long as one of these lives. Keeps PortAudio, ALSA and JACK from
/// printing on stderr. Once a stream of a dead device was abandoned, PortAudio is never terminated
/// any more (that hangs for ever: it waits for the dead server).
/// Threads: one (the main thread). Real-time: no.
class AudioSystem {
 public:
    /// Errors: PortAudio cannot be initialized.
    [[nodiscard]] static Expected<AudioSystem> open();
    AudioSystem(AudioSystem&& other) noexcept;
    AudioSystem& operator=(AudioSystem&& other) noexcept;
    ~AudioSystem();

    /// All devices, as found when PortAudio was initialized (it knows no hot-plug: list again in
    /// a new process): JACK's first, then the monitors, then the rest. The place in the list is
    /// the number that users give.
    [[nodiscard]] const std::vector<AudioDevice>& devices() const noexcept { return devices_; }

 private:
    AudioSystem() = default;
    bool is_open_ = false;
    std::vector<AudioDevice> devices_;
};

/// A device and why it is this one, for the user: "listens to raks.monitor (PulseAudio monitor):
/// it is what this computer plays".
struct DeviceChoice {
    AudioDevice device;
    std::string reason;
};

/// What to listen to. `wanted`: a number of the list, a name or description, or a part of one that
/// only one input has (case does not matter); empty: a monitor (the default sink's first), else
/// JACK's `system`, else the default input, else the first.
/// Errors: no such input (the error lists what there is), several match, no input at all.
/// Pure. Threads: any.
[[nodiscard]] Expected<DeviceChoice> choose_input(std::span<const AudioDevice> devices,
                                                  std::string_view wanted = {});
/// What to play on; the same rules without monitors: JACK's `system`, the default, the first.
[[nodiscard]] Expected<DeviceChoice> choose_output(std::span<const AudioDevice> devices,
                                                   std::string_view wanted = {});

}  // namespace raks::audio
