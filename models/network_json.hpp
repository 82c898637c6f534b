#pragma once

#include <cstddef>

#include "models/json_fields.hpp"
#include "models/recurrent_network.hpp"

/// A recurrent network as part of a JSON document: an object with the fields `units`, `layers` and
/// `parameters`. What its inputs and outputs are follows from the model that it belongs to.
namespace raks::models {

/// Size of a network as a file gives it.
struct NetworkSize {
    std::size_t units = 1;   ///< of a layer, 1 to RecurrentNetwork::kMaxUnits
    std::size_t layers = 1;  ///< 1 to RecurrentNetwork::kMaxLayers
};

/// Reads `units` and `layers`. Both are bounded, so a wrong file cannot ask for a huge network.
[[nodiscard]] NetworkSize read_network_size(const JsonDocument::Field& object);

/// Reads `parameters` into a network. Notes a fault where their number is not the network's, or one
/// is 1e6 or more: sums of larger weights would become infinite.
void read_network_parameters(const JsonDocument::Field& object, RecurrentNetwork& network);

/// Whether all parameters are numbers below 1e6, as read_network_parameters() demands.
[[nodiscard]] bool is_sound(const RecurrentNetwork& network) noexcept;

}  // namespace raks::models
