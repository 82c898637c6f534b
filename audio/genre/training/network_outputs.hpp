#pragma once

#include <span>

#include "audio/network/recurrent_network.hpp"
#include "base/music_state.hpp"

namespace raks::audio {

/// The network with an output for each of `genres` and for none of them. `known`: its own, all
/// among `genres`. A genre that is new begins with half of the chance of none of them.
[[nodiscard]] RecurrentNetwork with_outputs(const RecurrentNetwork& network,
                                            std::span<const Genre> known,
                                            std::span<const Genre> genres);

}  // namespace raks::audio
