#pragma once

#include "base/expected.hpp"

namespace raks::audio {

/// Connects what this process plays to what it records, inside the JACK server: output port n to
/// input port n, and nothing else to that input. For measuring: needs an output stream and an
/// input stream of ours on JACK, both running. Returns how many pairs were connected, >= 1.
///
/// A client's own loop goes round once a period: JACK hands the samples that were written in one
/// cycle to the input in the next. It crosses neither the driver's buffers nor converters.
/// Errors: no JACK server, or no such streams. Threads: main. Real-time: no.
[[nodiscard]] Expected<int> connect_own_outputs_to_inputs();

}  // namespace raks::audio
