// Tagger classes: what the music tagger's numbers say of the dances.
#pragma once

#include <cstddef>
#include <span>
#include <vector>

#include "audio/genre/genre_fusion.hpp"
#include "audio/genre/tagger_network.hpp"
#include "base/expected.hpp"
#include "base/realtime.hpp"

namespace raks::audio {

/// Logistic regression from an embedding of the tagger (200 numbers) to the classes of a genre
/// model. The tagger has words for some dances and none for others: between those that it does not
/// know it would guess, so they share what it gives to all of them. Immutable while it is used.
struct TaggerClasses {
    std::vector<float> mean;       ///< of each number, in training
    std::vector<float> deviation;  ///< likewise, > 0
    std::vector<float> weights;    ///< classes x kTagFeatures, rows of a class
    std::vector<float> bias;       ///< by class
    std::vector<bool> knows;       ///< by class: whether it is told from all others

    /// ln probabilities of the classes; exp of them sums to 1. `logs`: as many as classes.
    /// Real-time: yes.
    void log_chances(std::span<const float, kTagFeatures> embedding,
                     std::span<float> logs) const noexcept RAKS_NONBLOCKING;
};

/// Checks sizes and numbers. Errors: names the first wrong field.
[[nodiscard]] Expected<void> validate(const TaggerClasses& tagger, std::size_t classes);

}  // namespace raks::audio
