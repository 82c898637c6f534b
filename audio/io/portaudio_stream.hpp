#pragma once

#include <memory>

#include "audio/io/device_stream.hpp"

namespace raks::audio {

/// A stream of PortAudio, for ALSA, OSS and what else it knows. PortAudio chooses the block size.
/// `device` has channels in that direction. Errors: why not, as the end of a line.
[[nodiscard]] Expected<std::unique_ptr<DeviceStream>> open_portaudio_stream(
    DeviceStream::Direction direction, const AudioDevice& device, const StreamConfig& config);

}  // namespace raks::audio
