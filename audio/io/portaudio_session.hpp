#pragma once

#include <string>
#include <vector>

#include "audio/io/devices.hpp"
#include "base/expected.hpp"

namespace raks::audio {

/// A count of PortAudio's users in this process: the first acquire_portaudio() initializes it, the
/// last release_portaudio() terminates it. After leak_portaudio() it is never terminated, as that
/// call would not return.
/// Threads: one. Real-time: no.
/// One user more. Errors: PortAudio cannot be initialized; ALSA's settings cannot be used, with
/// which it would end the program.
[[nodiscard]] Expected<void> acquire_portaudio();
/// One user fewer; once for each successful acquire_portaudio().
void release_portaudio() noexcept;
/// Never terminate PortAudio in this process: a stream was left running.
void leak_portaudio() noexcept;
/// Whether leak_portaudio() was called.
[[nodiscard]] bool is_portaudio_leaked() noexcept;

/// Redirects stderr to /dev/null while it lives: sound libraries print about 100 lines when they
/// probe for devices. Anything else that this process writes there is lost, too, so keep it short.
class SilentStderr {
 public:
    /// Redirects.
    SilentStderr() noexcept;
    /// Restores stderr.
    ~SilentStderr();
    /// Not copyable: one object restores what it saved.
    SilentStderr(const SilentStderr&) = delete;
    /// As above.
    SilentStderr& operator=(const SilentStderr&) = delete;

 private:
    int saved_;
};

/// All devices of PortAudio, as found when it was initialized: it knows no hot-plug. Needs a user.
[[nodiscard]] std::vector<AudioDevice> list_portaudio_devices();

/// Text for a PortAudio error number: "Device unavailable", or what the host API below says.
[[nodiscard]] std::string portaudio_reason(int error);

}  // namespace raks::audio
