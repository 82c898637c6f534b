// Annealing: from the costs of particles to their weights, and to the particles that go on.
#pragma once

#include <cstddef>
#include <span>
#include <vector>

namespace raks::capture {

/// Weights exp(-beta (cost - least cost)) of particles, in [0, 1]. `weights`: as long as `costs`.
void weights_of(std::span<const float> costs, float beta, std::span<float> weights);

/// The share of the particles that survive resampling by these weights: (sum w)^2 / (n sum w^2).
/// (Deutscher and Reid 2005, equation 12)
[[nodiscard]] double survival_of(std::span<const float> weights);

/// Sets the weights for which the share `survival` of the particles survives, (0, 1), within 1 %;
/// returns their beta. Where more of them are equally good all of these weigh 1.
float anneal(std::span<const float> costs, double survival, std::span<float> weights);

/// Draws as many particles as there are weights, each as often as its weight says, give or take
/// one: systematic resampling. `start`: where the comb begins, [0, 1). `chosen`: by new particle,
/// the old one, in order.
void resample(std::span<const float> weights, double start, std::vector<std::size_t>& chosen);

}  // namespace raks::capture
