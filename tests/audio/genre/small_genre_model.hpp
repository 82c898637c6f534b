#pragma once

#include "audio/genre/genre_model.hpp"
#include "base/random.hpp"

namespace raks::audio::test {

/// A valid model of salsa and house with made-up numbers: one state, two Gaussians, four units.
/// House is loud in C0, salsa soft; rhythm knows nothing (all chances alike).
inline GenreModel small_genre_model() {
    GenreModel model;
    model.genres = {"salsa", "house"};
    const auto hmm = [](double mean, double variance) {
        models::GaussianHmm made;
        made.initial = Eigen::VectorXd::Ones(1);
        made.transition = Eigen::MatrixXd::Ones(1, 1);
        made.means = Eigen::MatrixXd::Zero(2, kMfccFeatures);
        made.means.col(0).setConstant(mean);
        made.weights = Eigen::MatrixXd::Constant(1, 2, 0.5);
        made.covariances.assign(2, Eigen::MatrixXd::Constant(kMfccFeatures, 1, variance));
        return made;
    };
    model.mfcc = {hmm(-4.0, 4.0), hmm(4.0, 4.0)};
    model.background = hmm(0.0, 60.0);
    PatternNetwork& network = model.rhythm;
    const CounterRandom random(7);
    network.units = 4;
    network.classes = 3;
    network.mean.assign(PatternNetwork::kInputs, 0.1F);
    network.deviation.assign(PatternNetwork::kInputs, 0.7F);
    for (std::size_t i = 0; i < network.units * PatternNetwork::kInputs; ++i) {
        network.hidden_weights.push_back(static_cast<float>(0.05 * random.normal(i)));
    }
    network.hidden_bias.assign(network.units, 0.25F);
    network.output_weights.assign(network.classes * network.units, 0.0F);
    network.output_bias.assign(network.classes, 0.0F);
    model.sound = network;
    model.networks = {models::RecurrentNetwork({NetworkInput::kSize, 4, 1, 3})};
    for (GenreFusion& fusion : model.fusion) {
        fusion = {{.mfcc = 1.0F}, {.mfcc = 1.0F}, {}};
    }
    model.made_with = "by hand";
    return model;
}

}  // namespace raks::audio::test
