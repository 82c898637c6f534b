#include "audio/io/portaudio_session.hpp"

#include <alsa/asoundlib.h>
#include <fcntl.h>
#include <jack/jack.h>
#include <pa_jack.h>
#include <portaudio.h>
#include <unistd.h>

#include <atomic>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <string>

namespace raks::audio {
namespace {

// Process-wide, as PortAudio is; one thread at a time opens devices.
int g_users = 0;
std::atomic<bool> g_is_leaked{false};

// Message handlers of ALSA and JACK that drop every message.
void ignore_alsa(const char*, int, const char*, int, const char*, ...) {}
void ignore_jack(const char*) {}

// Must run before Pa_Initialize(), which makes these libraries print.
void silence_libraries() {
    snd_lib_error_set_handler(ignore_alsa);
    jack_set_info_function(ignore_jack);
    jack_set_error_function(ignore_jack);  // PortAudio replaces it and keeps the last error
}

// PortAudio ends the program where ALSA's settings name no device at all: it is not asked then.
Expected<void> check_alsa() {
    const int updated = snd_config_update();
    snd_config_t* devices = nullptr;
    if (updated >= 0 && snd_config != nullptr &&
        snd_config_search(snd_config, "pcm", &devices) == 0) {
        return {};
    }
    const char* const file = std::getenv("ALSA_CONFIG_PATH");  // NOLINT(concurrency-mt-unsafe)
    return fail(std::string("ALSA's settings (") +
                (file != nullptr ? file : "/usr/share/alsa/alsa.conf, ~/.asoundrc") +
                (updated < 0 ? ") cannot be read" : ") name no device") +
                "; mend them, or start JACK, PulseAudio or PipeWire");
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
    if (auto checked = check_alsa(); !checked) {
        return checked;
    }
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

namespace {

// PortAudio's names are longer ("JACK Audio Connection Kit"); users see and type these.
std::string api_name(PaHostApiIndex index) {
    const PaHostApiInfo* info = Pa_GetHostApiInfo(index);
    if (info == nullptr) {
        return "unknown";
    }
    switch (info->type) {
        case paJACK:
            return "JACK";
        case paALSA:
            return "ALSA";
        case paOSS:
            return "OSS";
        default:
            return info->name;
    }
}

}  // namespace

// A rate that cannot be meant becomes 48 kHz.
std::vector<AudioDevice> list_portaudio_devices() {
    const SilentStderr silence;
    std::vector<AudioDevice> devices;
    const PaDeviceIndex default_input = Pa_GetDefaultInputDevice();
    const PaDeviceIndex default_output = Pa_GetDefaultOutputDevice();
    for (PaDeviceIndex i = 0; i < Pa_GetDeviceCount(); ++i) {
        const PaDeviceInfo* info = Pa_GetDeviceInfo(i);
        if (info == nullptr) {
            continue;
        }
        const double rate = info->defaultSampleRate;
        const bool is_sane = std::isfinite(rate) && rate >= 8'000.0 && rate <= 192'000.0;
        devices.push_back({.portaudio_index = i,
                           .name = info->name,
                           .id = info->name,
                           .host_api = api_name(info->hostApi),
                           .input_channels = info->maxInputChannels,
                           .output_channels = info->maxOutputChannels,
                           .default_rate = is_sane ? rate : 48'000.0,
                           .is_default_input = i == default_input,
                           .is_default_output = i == default_output});
    }
    return devices;
}

}  // namespace raks::audio
