#pragma once

#include <string>

#include "engine/live/live_graph.hpp"

namespace raks::engine {

/// What was lost while the music ran, for people: "2 gaps in the sound, 1 pause to read the file".
/// What did not happen is left out; empty: nothing was lost.
[[nodiscard]] std::string losses_in_words(const LiveCounters& lost);

}  // namespace raks::engine
