#pragma once

#include <memory>

#include "audio/io/device_stream.hpp"

namespace raks::audio {

/// A client of the JACK server with ports `out_0`, ... or `in_0`, ..., connected to those of the
/// device; the client is named `raks` where it plays and `raks-in` where it listens. The callback
/// runs on JACK's own thread. When the client that it listens to leaves, the stream stays, silent,
/// and connects itself when that client is back (DeviceEvent). `device` has channels in that
/// direction. Errors: why not, as the end of a line.
[[nodiscard]] Expected<std::unique_ptr<DeviceStream>> open_jack_stream(
    DeviceStream::Direction direction, const AudioDevice& device, const StreamConfig& config);

}  // namespace raks::audio
