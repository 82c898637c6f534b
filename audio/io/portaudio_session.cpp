#include "audio/io/portaudio_session.hpp"

#include <alsa/asoundlib.h>
#include <fcntl.h>
#include <jack/jack.h>
#include <pa_jack.h>
#include <portaudio.h>
#include <unistd.h>

#include <cstdio>

namespace raks::audio {
namespace {

// Process-wide, as PortAudio is; only the main thread uses them.
int g_users = 0;
bool g_is_leaked = false;

// Message handlers of ALSA and JACK that drop every message.
void ignore_alsa(const char*, int, const char*, int, const char*, ...) {}
void ignore_jack(const char*) {}

// Must run before Pa_Initialize(), which makes these libraries print.
void silence_libraries() {
    snd_lib_error_set_handler(ignore_alsa);
    jack_set_info_function(ignore_jack);
    jack_set_error_function(ignore_jack);  // PortAudio replaces it and keeps the last error
}

}  // namespace

// Works on the file descriptor: the libraries are in C and write past any C++ stream.
SilentStderr::SilentStderr() noexcept : saved_(dup(STDERR_FILENO)) {
    std::fflush(stderr);
    const int nothing = open("/dev/null", O_WRONLY | O_CLOEXEC);
    if (nothing >= 0) {
        dup2(nothing, STDERR_FILENO);
        close(nothing);
    }
}

SilentStderr::~SilentStderr() {
    std::fflush(stderr);
    if (saved_ >= 0) {
        dup2(saved_, STDERR_FILENO);
        close(saved_);
    }
}

Expected<void> acquire_portaudio() {
    // A leaked PortAudio is still initialized.
    if (g_users > 0 || g_is_leaked) {
        ++g_users;
        return {};
    }
    const SilentStderr silence;
    silence_libraries();
    PaJack_SetClientName("raks");
    // On a busy machine JACK may refuse one start without a reason and accept the next.
    constexpr int kTries = 3;
    PaError error = paUnanticipatedHostError;
    for (int i = 0; i < kTries && error == paUnanticipatedHostError; ++i) {
        error = Pa_Initialize();
    }
    if (error != paNoError) {
        return fail("PortAudio cannot be started: " + portaudio_reason(error));
    }
    ++g_users;
    return {};
}

void release_portaudio() noexcept {
    --g_users;
    if (g_users == 0 && !g_is_leaked) {
        const SilentStderr silence;
        Pa_Terminate();
    }
}

void leak_portaudio() noexcept { g_is_leaked = true; }
bool is_portaudio_leaked() noexcept { return g_is_leaked; }

// An unanticipated host error has no text of its own; the host API's last error does.
std::string portaudio_reason(int error) {
    if (error == paUnanticipatedHostError) {
        const PaHostErrorInfo* host = Pa_GetLastHostErrorInfo();
        if (host != nullptr && host->errorText != nullptr && *host->errorText != '\0') {
            return host->errorText;
        }
    }
    return Pa_GetErrorText(error);
}

}  // namespace raks::audio
