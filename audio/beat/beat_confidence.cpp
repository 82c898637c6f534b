#include "audio/beat/beat_confidence.hpp"

#include <algorithm>
#include <cmath>

#include "audio/beat/analyzer_command.hpp"

namespace raks::audio {
namespace {

constexpr float kMarginScale = 8.0F;  // nats at which a margin is mostly told
constexpr float kNoneScale = 15.0F;   // likewise of the margin over no beat
// Nats over no beat: up to here there is none, from there on there surely is one.
constexpr float kNoBeat = 2.0F;
constexpr float kSureBeat = 7.0F;
constexpr float kLeastThere = 0.25F;  // so much of the confidence is left where there is none
constexpr double kUsualBpm = 120.0;
constexpr float kShareScale = 0.3F;  // of a margin: how the rest is shared among rivals

}  // namespace

ConfidenceFeatures confidence_features(const PulseMargins& margins,
                                       float right,
                                       double bpm,
                                       float on_beats) noexcept RAKS_NONBLOCKING {
    constexpr float kNoRival = 99.0F;
    std::array<float, kRivalKinds> least{};  // margin over the best rival of each kind
    least.fill(kNoRival);
    for (std::size_t i = 0; i < kRivalPulses.size(); ++i) {
        const RivalPulse& rival = kRivalPulses[i];
        if (is_followed(Bpm(bpm * rival.rate))) {
            float& of_kind = least[static_cast<std::size_t>(rival.kind)];
            of_kind = std::min(of_kind, margins.margin(i));
        }
    }
    ConfidenceFeatures features{1.0F};
    for (std::size_t kind = 0; kind < kRivalKinds; ++kind) {
        features[1 + kind] = std::tanh(least[kind] / kMarginScale);
    }
    const auto octaves = static_cast<float>(std::log2(bpm / kUsualBpm));
    float* const rest = &features[1 + kRivalKinds];
    rest[0] = std::tanh(margins.over_none() / kNoneScale);
    rest[1] = on_beats;
    rest[2] = octaves;
    rest[3] = octaves * octaves;
    rest[4] = 2.0F * right - 1.0F;
    return features;
}

// Without evidence on the beats there is no beat, whatever fits best; nor where the music fits them
// hardly better than no beat at all, as in noise, speech and single sounds.
BeatVerdict judge_beat(const ConfidenceModel& model,
                       const PulseMargins& margins,
                       float right,
                       double bpm,
                       float on_beats) noexcept RAKS_NONBLOCKING {
    const ConfidenceFeatures features = confidence_features(margins, right, bpm, on_beats);
    float sum = 0.0F;
    for (std::size_t i = 0; i < features.size(); ++i) {
        sum += model.weights[i] * features[i];
    }
    BeatVerdict verdict;
    const float is_there =
        std::clamp((margins.over_none() - kNoBeat) / (kSureBeat - kNoBeat), kLeastThere, 1.0F);
    verdict.confidence = is_there * on_beats / (1.0F + std::exp(-sum));
    float most = 0.0F;
    float shares = 0.0F;
    for (std::size_t i = 0; i < kRivalPulses.size(); ++i) {
        if (!is_followed(Bpm(bpm * kRivalPulses[i].rate))) {
            continue;
        }
        const float share = std::exp(std::clamp(-kShareScale * margins.margin(i), -20.0F, 20.0F));
        shares += share;
        if (share > most) {
            most = share;
            verdict.rival_rate = kRivalPulses[i].rate;
        }
    }
    verdict.rival = shares > 0.0F ? (1.0F - verdict.confidence) * most / shares : 0.0F;
    return verdict;
}

}  // namespace raks::audio
