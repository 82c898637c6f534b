#pragma once

#include <memory>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "base/expected.hpp"

namespace raks::audio {

/// A device, or one direction of one, that can be recorded from or played to.
struct AudioDevice {
    int portaudio_index = -1;        ///< what PortAudio opens
    std::string name{};              ///< as the user sees it and may type it
    std::string description{};       ///< the desktop's name where it differs; may be typed, too
    std::string host_api{};          ///< "JACK", "ALSA", "OSS", "PulseAudio monitor"
    int input_channels = 0;          ///< 0: no input
    int output_channels = 0;         ///< 0: no output
    double default_rate = 48'000.0;  ///< hertz, 8,000 to 192,000
    bool is_default_input = false;   ///< PortAudio's default of its host API
    bool is_default_output = false;  ///< the same for output
    /// Not empty: a monitor, which records what the computer plays; opened through ALSA's `pulse`
    /// with PULSE_SOURCE set to this value in this process.
    std::string pulse_source{};

    /// Whether it records what the computer plays.
    [[nodiscard]] bool is_monitor() const noexcept { return !pulse_source.empty(); }
};

/// For messages: "'system' (JACK)", "'x.monitor' (PulseAudio monitor, Monitor of Living Room)".
[[nodiscard]] std::string described(const AudioDevice& device);

/// Keeps PortAudio initialized while it lives, and PortAudio, ALSA and JACK from printing on
/// stderr. Once the stream of a dead device was abandoned, PortAudio is not terminated any more:
/// that call would wait for the dead server and never return.
/// Threads: one (the main thread). Real-time: no.
class AudioSystem {
 public:
    /// Errors: PortAudio cannot be initialized.
    [[nodiscard]] static Expected<AudioSystem> open();
    /// Takes over; the other object holds nothing then.
    AudioSystem(AudioSystem&& other) noexcept;
    /// As above; what this object held ends with the other one.
    AudioSystem& operator=(AudioSystem&& other) noexcept;
    /// Terminates PortAudio with the last user, if no stream was abandoned.
    ~AudioSystem();

    /// All devices, as found when PortAudio was initialized (it knows no hot-plug; a new process
    /// lists them again): JACK's first, then the monitors, then the rest. The index in the list is
    /// the number that users give.
    [[nodiscard]] const std::vector<AudioDevice>& devices() const noexcept { return devices_; }

 private:
    AudioSystem() = default;
    bool is_open_ = false;
    std::vector<AudioDevice> devices_;
};

/// A device and why it was chosen, such as "'raks.monitor' (PulseAudio monitor): it is what this
/// computer plays".
struct DeviceChoice {
    AudioDevice device;  ///< a copy of the list's entry
    std::string reason;  ///< one line for the user, names the device
};

/// The device to record from. `wanted`: a number of the list, a name or description, or a part of
/// one that only one input has (case does not matter); empty: a monitor (the default sink's first),
/// else JACK's `system`, else the default input, else the first.
/// Errors: no such input (the error lists all); several match; no input at all. Pure. Threads: any.
[[nodiscard]] Expected<DeviceChoice> choose_input(std::span<const AudioDevice> devices,
                                                  std::string_view wanted = {});
/// The device to play to, by the same rules without monitors: JACK's `system`, the default, the
/// first.
[[nodiscard]] Expected<DeviceChoice> choose_output(std::span<const AudioDevice> devices,
                                                   std::string_view wanted = {});

}  // namespace raks::audio
