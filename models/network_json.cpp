#include "models/network_json.hpp"

#include <algorithm>
#include <cmath>
#include <span>
#include <vector>

#include <fmt/format.h>

namespace raks::models {
namespace {

// A NaN fails the comparison.
bool is_sound_weight(double weight) noexcept { return std::abs(weight) < 1e6; }

}  // namespace

NetworkSize read_network_size(const JsonDocument::Field& object) {
    const int units = object["units"].whole(1, static_cast<int>(RecurrentNetwork::kMaxUnits));
    const int layers = object["layers"].whole(1, static_cast<int>(RecurrentNetwork::kMaxLayers));
    return {static_cast<std::size_t>(units), static_cast<std::size_t>(layers)};
}

void read_network_parameters(const JsonDocument::Field& object, RecurrentNetwork& network) {
    const JsonDocument::Field field = object["parameters"];
    const std::vector<double> values = field.numbers();
    const std::span<float> parameters = network.parameters();
    if (values.size() != parameters.size()) {
        field.complain(fmt::format("has {} numbers, {} units in {} layers need {}",
                                   values.size(),
                                   network.units(),
                                   network.layers().size(),
                                   parameters.size()));
        return;
    }
    for (std::size_t i = 0; i < values.size(); ++i) {
        if (!is_sound_weight(values[i])) {
            field[i].complain("is not below 1e6");
            return;
        }
        parameters[i] = static_cast<float>(values[i]);
    }
}

bool is_sound(const RecurrentNetwork& network) noexcept {
    const std::span<const float> parameters = network.parameters();
    return std::all_of(parameters.begin(), parameters.end(), [](float weight) {
        return is_sound_weight(static_cast<double>(weight));
    });
}

}  // namespace raks::models
