#include "audio/genre/genre_model.hpp"

#include <algorithm>
#include <cmath>
#include <span>

#include "audio/genre/genre_scorer.hpp"

#include <fmt/format.h>

namespace raks::audio {
namespace {

// Limits of what runs in real time: SlidingScore costs states^3 a block.
constexpr Eigen::Index kMostStates = 16;
constexpr Eigen::Index kMostMixtures = 64;

// An HMM of a model: valid, of the features' dimension, within the limits.
Expected<void> check_hmm(const models::GaussianHmm& hmm, int dimension, const std::string& name) {
    if (auto valid = models::validate(hmm); !valid) {
        return fail(name + "." + valid.error().message);
    }
    if (hmm.dimension() != dimension) {
        return fail(fmt::format(
            "{} is of {} features, the definition has {}", name, hmm.dimension(), dimension));
    }
    if (hmm.states() > kMostStates || hmm.mixtures() > kMostMixtures) {
        return fail(fmt::format("{} has {} states of {} mixtures, at most {} of {} are run",
                                name,
                                hmm.states(),
                                hmm.mixtures(),
                                kMostStates,
                                kMostMixtures));
    }
    // A window ends anywhere in a piece, so an exit distribution would be wrong.
    if (hmm.exit.size() > 0) {
        return fail(name + ".exit must be empty: music may end anywhere");
    }
    return {};
}

// As many numbers as the shape needs, none of them NaN or huge.
Expected<void> check_numbers(std::span<const float> numbers,
                             std::size_t size,
                             const std::string& name) {
    if (numbers.size() != size) {
        return fail(fmt::format("{} has {} numbers, must have {}", name, numbers.size(), size));
    }
    for (std::size_t i = 0; i < numbers.size(); ++i) {
        // Larger weights would make infinities of sums; a NaN fails the comparison.
        if (!(std::abs(numbers[i]) < 1e6F)) {
            return fail(fmt::format("{}[{}] is not below 1e6", name, i));
        }
    }
    return {};
}

// A pattern network: sizes by its units and classes.
Expected<void> check_network(const PatternNetwork& network,
                             std::size_t classes,
                             const std::string& name) {
    if (network.units > PatternNetwork::kMaxUnits) {
        return fail(fmt::format(
            "{}.units is {}, must be 0 to {}", name, network.units, PatternNetwork::kMaxUnits));
    }
    if (network.classes != classes) {
        return fail(fmt::format("{} has {} classes, must have {}: the genres and none",
                                name,
                                network.classes,
                                classes));
    }
    constexpr std::size_t kInputs = PatternNetwork::kInputs;
    const std::size_t last = network.last_inputs();
    const auto parts = {
        check_numbers(network.mean, kInputs, name + ".mean"),
        check_numbers(network.deviation, kInputs, name + ".deviation"),
        check_numbers(network.hidden_weights, network.units * kInputs, name + ".hidden_weights"),
        check_numbers(network.hidden_bias, network.units, name + ".hidden_bias"),
        check_numbers(network.output_weights, classes * last, name + ".output_weights"),
        check_numbers(network.output_bias, classes, name + ".output_bias")};
    for (const Expected<void>& part : parts) {
        if (!part) {
            return part;
        }
    }
    // Inputs are divided by the deviations.
    const auto worst = std::min_element(network.deviation.begin(), network.deviation.end());
    if (!(*worst > 0.0F)) {
        return fail(fmt::format("{}.deviation[{}] is {}, must be > 0",
                                name,
                                worst - network.deviation.begin(),
                                static_cast<double>(*worst)));
    }
    return {};
}

// A recurrent network: its input and output sizes; the others follow from its shape.
Expected<void> check_network(const models::RecurrentNetwork& network,
                             std::size_t classes,
                             const std::string& name) {
    if (network.shape().inputs != NetworkInput::kSize || network.outputs() != classes) {
        return fail(fmt::format("{} has {} inputs and {} outputs, must have {} and {}",
                                name,
                                network.shape().inputs,
                                network.outputs(),
                                NetworkInput::kSize,
                                classes));
    }
    // The count is right by construction; this checks the values.
    return check_numbers(network.parameters(), network.parameters().size(), name + ".parameters");
}

// Names of dances, none twice; the number is bounded as classes index fixed arrays.
Expected<void> check_genres(const std::vector<std::string>& genres) {
    if (genres.empty() || genres.size() > kMostGenres) {
        return fail(
            fmt::format("genres has {} entries, must have 1 to {}", genres.size(), kMostGenres));
    }
    for (auto genre = genres.begin(); genre != genres.end(); ++genre) {
        const auto number = genre - genres.begin();
        if (!is_dance_name(*genre)) {
            return fail(fmt::format("genres[{}]: {}", number, why_no_dance_name(*genre)));
        }
        if (std::find(genres.begin(), genre, *genre) != genre) {
            return fail(fmt::format("genres[{}] is {}, which is there before", number, *genre));
        }
    }
    return {};
}

}  // namespace

// The last static of each third (statics, first and second derivatives) is the energy.
void GenreFeatures::select(const MfccVector& vector, std::span<double> out) const noexcept {
    std::size_t at = 0;
    for (std::size_t i = 0; i < vector.size(); ++i) {
        if (energy == Energy::used || i % kMfccStatic != kMfccStatic - 1) {
            out[at++] = static_cast<double>(vector[i]);
        }
    }
}

Expected<void> validate(const GenreModel& model) {
    if (auto ok = check_genres(model.genres); !ok) {
        return ok;
    }
    if (model.mfcc.size() != model.genres.size()) {
        return fail(fmt::format(
            "mfcc has {} models, there are {} genres", model.mfcc.size(), model.genres.size()));
    }
    const int dimension = model.features.dimension();
    for (std::size_t i = 0; i < model.mfcc.size(); ++i) {
        if (auto ok = check_hmm(model.mfcc[i], dimension, fmt::format("mfcc[{}]", i)); !ok) {
            return ok;
        }
    }
    if (auto ok = check_hmm(model.background, dimension, "background"); !ok) {
        return ok;
    }
    if (model.similarity) {
        if (auto ok = check_hmm(*model.similarity, dimension, "similarity"); !ok) {
            return ok;
        }
    }
    if (model.tagger) {
        if (auto ok = validate(*model.tagger, model.classes()); !ok) {
            return ok;
        }
    }
    for (std::size_t i = 0; i < model.fusion.size(); ++i) {
        const GenreFusion& fusion = model.fusion[i];
        // Larger weights would make infinities of sums; a NaN fails the comparison.
        const auto is_sane = [](float number) { return std::abs(number) < 1e3F; };
        const auto are_sane = [&](const EvidenceWeights& weights) {
            return is_sane(weights.mfcc) && is_sane(weights.rhythm) && is_sane(weights.sound) &&
                   is_sane(weights.network);
        };
        if (!are_sane(fusion.dances) || !are_sane(fusion.none) ||
            !std::all_of(fusion.offsets.begin(), fusion.offsets.end(), is_sane)) {
            return fail(fmt::format("fusion[{}] has a number that is not below 1000", i));
        }
    }
    if (auto ok = check_network(model.rhythm, model.classes(), "rhythm"); !ok) {
        return ok;
    }
    if (auto ok = check_network(model.sound, model.classes(), "sound"); !ok) {
        return ok;
    }
    if (model.networks.empty() || model.networks.size() > GenreScorer::kMostNetworks) {
        return fail(fmt::format("networks has {} entries, must have 1 to {}",
                                model.networks.size(),
                                GenreScorer::kMostNetworks));
    }
    for (std::size_t i = 0; i < model.networks.size(); ++i) {
        if (auto ok =
                check_network(model.networks[i], model.classes(), fmt::format("networks[{}]", i));
            !ok) {
            return ok;
        }
    }
    return {};
}

}  // namespace raks::audio
