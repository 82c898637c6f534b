#pragma once

#include <string>

#include "base/expected.hpp"

namespace raks::audio {

/// PortAudio's life in this process, counted: initialized by the first acquire, terminated by the
/// last release, never again once leak_portaudio() was called (terminating then hangs).
/// Threads: one. Real-time: no.
[[nodiscard]] Expected<void> acquire_portaudio();
void release_portaudio() noexcept;
void leak_portaudio() noexcept;
[[nodiscard]] bool is_portaudio_leaked() noexcept;

/// Points stderr at nothing while it lives: what sound libraries print when they probe is about
/// 100 lines. Whatever else this process writes there meanwhile is lost, so keep it short.
class SilentStderr {
 public:
    SilentStderr() noexcept;
    ~SilentStderr();
    SilentStderr(const SilentStderr&) = delete;
    SilentStderr& operator=(const SilentStderr&) = delete;

 private:
    int saved_;
};

/// "Device unavailable", or what the host API under PortAudio says.
[[nodiscard]] std::string portaudio_reason(int error);

}  // namespace raks::audio
