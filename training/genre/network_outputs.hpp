#pragma once

#include <memory>
#include <span>
#include <vector>

#include "base/music_state.hpp"
#include "models/recurrent_network.hpp"

namespace raks::audio {

/// Copies of the networks with one output for each of `genres` and one for none of them. `known`:
/// the genres that the networks have outputs for, all among `genres`. Each new genre gets a copy of
/// the output of none; their biases are lowered so that together they have the probability that
/// none had.
[[nodiscard]] std::vector<std::shared_ptr<const models::RecurrentNetwork>> with_outputs(
    std::span<const std::shared_ptr<const models::RecurrentNetwork>> networks,
    std::span<const std::string> known,
    std::span<const std::string> genres);

}  // namespace raks::audio
