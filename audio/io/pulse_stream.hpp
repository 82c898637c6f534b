#pragma once

#include <memory>

#include "audio/io/device_stream.hpp"

namespace raks::audio {

/// A stream of the PulseAudio or PipeWire server. libpulse's thread only moves samples through a
/// ring; a thread of ours runs the callback, real-time where that is allowed.
///
/// An output's buffer is `latency_seconds` long (40 ms when 0) and doubles, up to 320 ms, when it
/// runs dry (StreamConfig::may_grow). Unless it `stays`, the server may move an output, and it goes
/// where the person or the desktop sends it. An input is never moved: a monitor that disappears
/// must not become a microphone; it dies instead.
/// `device` has channels in that direction. Errors: why not, as the end of a line.
[[nodiscard]] Expected<std::unique_ptr<DeviceStream>> open_pulse_stream(
    DeviceStream::Direction direction, const AudioDevice& device, const StreamConfig& config);

}  // namespace raks::audio
