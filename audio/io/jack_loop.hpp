#pragma once

#include "base/expected.hpp"

namespace raks::audio {

/// Connects this process' output port n to its input port n inside the JACK server, and nothing
/// else to that input: for measuring. Needs an output and an input stream of this process on JACK,
/// both running. Returns how many pairs were connected, >= 1.
///
/// The loop takes one period: JACK passes the samples written in one cycle to the input in the
/// next. It contains neither the driver's buffers nor converters.
/// Errors: no JACK server; no such streams. Threads: main. Real-time: no.
[[nodiscard]] Expected<int> connect_own_outputs_to_inputs();

}  // namespace raks::audio
