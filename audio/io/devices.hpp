#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "base/expected.hpp"

namespace raks::audio {

/// By which library a device is opened.
enum class AudioSystemKind : std::uint8_t {
    automatic,  ///< for asking only: JACK's and PulseAudio's devices, or PortAudio's where neither
    portaudio,  ///< ALSA, OSS, and JACK by PortAudio's own way
    jack,       ///< libjack; PipeWire serves it, too
    pulse,      ///< libpulse; PipeWire serves it, too
};
/// The word of `--audio-system`: "auto", "portaudio", "jack", "pulse".
[[nodiscard]] std::string_view name_of(AudioSystemKind kind) noexcept;
/// Inverse of name_of(); automatic for other words.
[[nodiscard]] AudioSystemKind audio_system_of(std::string_view word) noexcept;

/// A device, or one direction of one, that can be recorded from or played to.
struct AudioDevice {
    AudioSystemKind system = AudioSystemKind::portaudio;  ///< never automatic
    int portaudio_index = -1;        ///< what PortAudio opens; -1 with the others
    std::string name{};              ///< as the desktop shows it and the user may type it
    std::string id{};                ///< the server's own name: "speakers.monitor"; may be typed
    std::string host_api{};          ///< "JACK", "PulseAudio", "PipeWire", "ALSA", "OSS"
    int input_channels = 0;          ///< 0: no input
    int output_channels = 0;         ///< 0: no output
    double default_rate = 48'000.0;  ///< hertz, 8,000 to 192,000
    bool is_default_input = false;   ///< the system's default
    bool is_default_output = false;  ///< the same for output
    bool is_monitor = false;         ///< it records what the computer plays
    std::string monitor_of{};        ///< of a monitor: the name of its loudspeaker
};

/// For messages: "'system' (JACK)", "'Monitor of Living Room' (PulseAudio)".
[[nodiscard]] std::string described(const AudioDevice& device);

/// Asks which devices there are. PortAudio alone stays initialized while this lives, and only where
/// it is needed: it takes 77 ms. No library prints.
/// Threads: one at a time. Real-time: no.
class AudioSystem {
 public:
    /// Errors: a server accepts but does not answer within 2 s; the one asked for does not run;
    /// PortAudio cannot be initialized.
    [[nodiscard]] static Expected<AudioSystem> open(
        AudioSystemKind kind = AudioSystemKind::automatic);
    /// Takes over; the other object holds nothing then.
    AudioSystem(AudioSystem&& other) noexcept;
    /// As above; what this object held ends with the other one.
    AudioSystem& operator=(AudioSystem&& other) noexcept;
    /// Terminates PortAudio with the last user, if no stream was abandoned.
    ~AudioSystem();

    /// All devices: JACK's first, then PulseAudio's monitors, its other devices (the defaults
    /// first), then PortAudio's. The index in the list is the number that users give.
    [[nodiscard]] const std::vector<AudioDevice>& devices() const noexcept { return devices_; }

 private:
    AudioSystem() = default;
    Expected<void> add_servers(AudioSystemKind kind);
    Expected<void> add_portaudio(AudioSystemKind kind);

    bool uses_portaudio_ = false;
    std::vector<AudioDevice> devices_;
};

/// A device and why it was chosen, such as "'Monitor of Speakers' (PulseAudio): it is what this
/// computer plays".
struct DeviceChoice {
    AudioDevice device;  ///< a copy of the list's entry
    std::string reason;  ///< one line for the user, names the device
};

/// The device to record from. `wanted`: a number of the list, a name or id, or a part of one that
/// only one input has (case does not matter); empty: what the desktop plays (the monitor of
/// PulseAudio's or PipeWire's default sink, where that is a real one), else JACK's `system`, else
/// any monitor, else the default input, else the first. Where the desktop is chosen although JACK
/// runs too, the reason says so.
/// Errors: no such input (the error lists all); several match; no input at all. Pure. Threads: any.
[[nodiscard]] Expected<DeviceChoice> choose_input(std::span<const AudioDevice> devices,
                                                  std::string_view wanted = {});
/// The device to play to, by the same rules, so that what it plays is what choose_input() hears:
/// the desktop's default sink, JACK's `system`, the default, the first.
[[nodiscard]] Expected<DeviceChoice> choose_output(std::span<const AudioDevice> devices,
                                                   std::string_view wanted = {});

}  // namespace raks::audio
