#pragma once

#include "audio/io/device_stream.hpp"
#include "base/expected.hpp"

namespace raks::audio {

/// Connects output port n of a stream of ours to input port n of another, inside the JACK server,
/// and takes all other connections of these ports away: for measuring. Returns how many pairs were
/// connected, >= 1.
///
/// JACK passes the samples on in the same cycle, as it calls the client that listens after the one
/// that plays. The loop contains neither the driver's buffers nor converters.
/// Errors: the streams are not JACK's; the server does not answer. Threads: main. Real-time: no.
[[nodiscard]] Expected<int> connect_jack_loop(const DeviceStream& output,
                                              const DeviceStream& input);

}  // namespace raks::audio
