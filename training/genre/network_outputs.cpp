#include "training/genre/network_outputs.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <utility>
#include <vector>

namespace raks::audio {
namespace {

// One network with outputs for `genres` and none.
models::RecurrentNetwork widened(const models::RecurrentNetwork& network,
                                 std::span<const std::string> known,
                                 std::span<const std::string> genres) {
    models::RecurrentNetwork::Shape shape = network.shape();
    shape.outputs = genres.size() + 1;
    models::RecurrentNetwork wide(shape);
    // The layers do not depend on the outputs, and come first in the row of parameters.
    const auto from = network.parameters();
    const auto to = wide.parameters();
    std::copy_n(from.begin(), network.output_weights(), to.begin());
    const std::size_t none = known.size();
    // Which old output each new one copies. A genre that is not found gets the index known.size(),
    // which is that of none.
    std::vector<std::size_t> sources;
    for (const std::string& genre : genres) {
        const auto found = std::find(known.begin(), known.end(), genre);
        sources.push_back(static_cast<std::size_t>(found - known.begin()));
    }
    sources.push_back(none);
    // So many outputs share the probability of none: each bias falls by ln of that number.
    const auto shares = static_cast<float>(std::count(sources.begin(), sources.end(), none));
    for (std::size_t output = 0; output < sources.size(); ++output) {
        const std::size_t source = sources[output];
        for (std::size_t unit = 0; unit < network.units(); ++unit) {
            to[wide.output_weights() + unit * wide.outputs() + output] =
                from[network.output_weights() + unit * network.outputs() + source];
        }
        to[wide.output_biases() + output] =
            from[network.output_biases() + source] - (source == none ? std::log(shares) : 0.0F);
    }
    return wide;
}

}  // namespace

std::vector<std::shared_ptr<const models::RecurrentNetwork>> with_outputs(
    std::span<const std::shared_ptr<const models::RecurrentNetwork>> networks,
    std::span<const std::string> known,
    std::span<const std::string> genres) {
    std::vector<std::shared_ptr<const models::RecurrentNetwork>> wide;
    for (const auto& network : networks) {
        wide.push_back(
            std::make_shared<const models::RecurrentNetwork>(widened(*network, known, genres)));
    }
    return wide;
}

}  // namespace raks::audio
