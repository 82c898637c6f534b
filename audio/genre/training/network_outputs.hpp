#pragma once

#include <memory>
#include <span>
#include <vector>

#include "audio/network/recurrent_network.hpp"
#include "base/music_state.hpp"

namespace raks::audio {

/// The networks with an output for each of `genres` and for none of them. `known`: their own, all
/// among `genres`. A genre that is new begins with half of the chance of none of them.
[[nodiscard]] std::vector<std::shared_ptr<const RecurrentNetwork>> with_outputs(
    std::span<const std::shared_ptr<const RecurrentNetwork>> networks,
    std::span<const Genre> known,
    std::span<const Genre> genres);

}  // namespace raks::audio
