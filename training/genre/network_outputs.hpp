#pragma once

#include <memory>
#include <span>
#include <vector>

#include "base/music_state.hpp"
#include "models/recurrent_network.hpp"

namespace raks::audio {

/// The networks with an output for each of `genres` and for none of them. `known`: their own, all
/// among `genres`. A genre that is new begins with half of the chance of none of them.
[[nodiscard]] std::vector<std::shared_ptr<const models::RecurrentNetwork>> with_outputs(
    std::span<const std::shared_ptr<const models::RecurrentNetwork>> networks,
    std::span<const std::string> known,
    std::span<const std::string> genres);

}  // namespace raks::audio
