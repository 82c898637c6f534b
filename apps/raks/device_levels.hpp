#pragma once

#include <optional>
#include <vector>

#include "audio/io/devices.hpp"

namespace raks::apps {

/// What each device hears, in dBFS (rms of the loudest channel over a third of a second, at least
/// -120); none: it is no input, or cannot be opened beside others. All are listened to at once.
/// PortAudio's are left out, as they may be for one program alone. Threads: main. Real-time: no.
[[nodiscard]] std::vector<std::optional<float>> device_levels(
    const std::vector<audio::AudioDevice>& devices);

}  // namespace raks::apps
