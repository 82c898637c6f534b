#include "audio/beat/training/training_batches.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <optional>

#include "audio/beat/network/network_input.hpp"

namespace raks::audio {
namespace {

constexpr std::size_t kBands = NetworkInput::kBands;
constexpr std::size_t kOutputs = BeatNetwork::kOutputs;
constexpr double kHopsPerSecond = 100.0;
constexpr std::size_t kWarmUpHops = 120;  // what came before is not known yet
constexpr float kWarmUpWeight = 0.2F;
// Downbeats are learnt last: they take counting.
constexpr float kDownbeatWeight = 2.0F;
constexpr float kHalfWeight = 0.7F;

// Where in a chunk another piece may begin.
constexpr double kEarliestCut = 0.25;  // of the chunk
constexpr double kLatestCut = 0.6;

using Bands = std::array<float, kBands>;

/// Hops of a chunk that one excerpt fills.
struct Span {
    std::size_t begin = 0;
    std::size_t end = 0;
};

/// How one chunk is heard.
struct Hearing {
    double first_hop = 0.0;  // in the excerpt
    double stretch = 1.0;    // hops of the excerpt a hop of the chunk
    Bands gain{};
    float noise = 0.0F;  // share of the excerpt's mean magnitude, on every band
};

Hearing draw_hearing(const TrainingExcerpt& excerpt, std::size_t hops, Dice& dice) {
    Hearing hearing;
    hearing.stretch = dice.chance(0.7) ? std::exp(dice.uniform(-0.16, 0.16)) : 1.0;
    const double span = static_cast<double>(hops) * hearing.stretch;
    const double room = static_cast<double>(excerpt.hops()) - span;
    hearing.first_hop = dice.uniform(0.0, std::max(0.0, room));
    // A smooth curve over the bands, sd 0.45 in the logarithm.
    std::array<double, 4> waves{};
    for (double& wave : waves) {
        wave = dice.normal(0.32);
    }
    const double overall = dice.normal(0.5);
    for (std::size_t band = 0; band < kBands; ++band) {
        double log_gain = overall;
        for (std::size_t wave = 0; wave < waves.size(); ++wave) {
            const double angle = std::numbers::pi * static_cast<double>((wave + 1) * band) / kBands;
            log_gain += waves[wave] * std::cos(angle);
        }
        hearing.gain[band] = static_cast<float>(std::exp(log_gain));
    }
    if (dice.chance(0.3)) {
        const auto first = static_cast<std::size_t>(dice.whole(0, kBands - 1));
        const auto end = std::min(kBands, first + static_cast<std::size_t>(dice.whole(3, 14)));
        const auto damping = static_cast<float>(dice.uniform(0.02, 0.5));
        for (std::size_t band = first; band < end; ++band) {
            hearing.gain[band] *= damping;
        }
    }
    for (float& gain : hearing.gain) {
        gain = dice.chance(0.03) ? 0.0F : gain;
    }
    hearing.noise = dice.chance(0.3) ? static_cast<float>(dice.log_uniform(0.01, 0.4)) : 0.0F;
    return hearing;
}

/// Mel magnitudes at a place between hops.
Bands magnitudes_at(const TrainingExcerpt& excerpt, double hop) {
    const double last = static_cast<double>(excerpt.hops()) - 1.0;
    const double clamped = std::clamp(hop, 0.0, last);
    const auto low = static_cast<std::size_t>(clamped);
    const std::size_t high = std::min(low + 1, excerpt.hops() - 1);
    const auto share = static_cast<float>(clamped - static_cast<double>(low));
    Bands bands{};
    for (std::size_t band = 0; band < kBands; ++band) {
        const float before = excerpt.mel[low * kBands + band];
        bands[band] = before + share * (excerpt.mel[high * kBands + band] - before);
    }
    return bands;
}

float mean_magnitude(const TrainingExcerpt& excerpt) {
    double sum = 0.0;
    for (const float value : excerpt.mel) {
        sum += static_cast<double>(value);
    }
    return static_cast<float>(sum /
                              static_cast<double>(std::max<std::size_t>(1, excerpt.mel.size())));
}

class BatchWriter {
 public:
    BatchWriter(std::size_t chunks, std::size_t hops, int lookahead) : lookahead_(lookahead) {
        batch_.steps = hops;
        batch_.chunks = chunks;
        batch_.inputs.resize(hops * chunks * NetworkInput::kSize);
        batch_.targets.resize(hops * chunks * kOutputs);
        batch_.weights.resize(hops * chunks * kOutputs);
    }

    void write(std::size_t chunk,
               const Span& span,
               const TrainingExcerpt& excerpt,
               const Hearing& hearing,
               NetworkInput& input,
               Dice* dice) {
        const float floor = hearing.noise > 0.0F ? hearing.noise * mean_magnitude(excerpt) : 0.0F;
        for (std::size_t t = span.begin; t < span.end; ++t) {
            const double hop =
                hearing.first_hop + static_cast<double>(t - span.begin) * hearing.stretch;
            Bands bands = magnitudes_at(excerpt, hop);
            for (std::size_t band = 0; band < kBands; ++band) {
                const float hiss = floor > 0.0F && dice != nullptr
                                       ? floor * static_cast<float>(dice->uniform(0.5, 1.5))
                                       : 0.0F;
                bands[band] = bands[band] * hearing.gain[band] + hiss;
            }
            const NetworkInput::Frame frame = input.next(bands);
            std::copy(frame.begin(),
                      frame.end(),
                      batch_.inputs.begin() +
                          static_cast<std::ptrdiff_t>((t * batch_.chunks + chunk) * frame.size()));
        }
        write_targets(chunk, span, excerpt, hearing);
    }
    TrainingBatch finish() { return std::move(batch_); }

 private:
    void write_targets(std::size_t chunk,
                       const Span& span,
                       const TrainingExcerpt& excerpt,
                       const Hearing& hearing) {
        const auto hop_of = [&](double seconds) {
            return static_cast<double>(span.begin) + lookahead_ +
                   (seconds * kHopsPerSecond - hearing.first_hop) / hearing.stretch;
        };
        const std::vector<PlayedBeat>& beats = excerpt.beats;
        double known_until = 0.0;
        for (std::size_t i = 0; i < beats.size(); ++i) {
            const double at = hop_of(beats[i].time);
            mark(chunk, span, at, 0);
            if (beats[i].bar_position == 1) {
                mark(chunk, span, at, 1);
            }
            if (i + 1 < beats.size()) {
                const double next = hop_of(beats[i + 1].time);
                mark(chunk, span, 0.5 * (at + next), 2);
                known_until = next + 0.4 * (next - at);
            }
        }
        for (std::size_t t = span.begin; t < span.end; ++t) {
            const std::size_t since = t - span.begin;
            const bool is_known = (beats.empty() || static_cast<double>(t) < known_until) &&
                                  hearing.first_hop + static_cast<double>(since) * hearing.stretch <
                                      static_cast<double>(excerpt.hops());
            const float weight = !is_known ? 0.0F : since < kWarmUpHops ? kWarmUpWeight : 1.0F;
            float* const weights = &batch_.weights[(t * batch_.chunks + chunk) * kOutputs];
            weights[0] = weight;
            weights[1] = kDownbeatWeight * weight;
            weights[2] = kHalfWeight * weight;
        }
    }
    /// 1 on the hop, falling to 0 two hops beside it.
    void mark(std::size_t chunk, const Span& span, double at, std::size_t output) {
        for (auto t = static_cast<std::ptrdiff_t>(std::floor(at)) - 1;
             t <= static_cast<std::ptrdiff_t>(std::floor(at)) + 2;
             ++t) {
            if (t < static_cast<std::ptrdiff_t>(span.begin) ||
                t >= static_cast<std::ptrdiff_t>(span.end)) {
                continue;
            }
            const auto index = (static_cast<std::size_t>(t) * batch_.chunks + chunk) * kOutputs;
            const auto value = static_cast<float>(
                std::max(0.0, 1.0 - 0.5 * std::abs(static_cast<double>(t) - at)));
            batch_.targets[index + output] = std::max(batch_.targets[index + output], value);
        }
    }

    int lookahead_;
    TrainingBatch batch_;
};

}  // namespace

TrainingBatch draw_batch(const std::vector<const TrainingExcerpt*>& from,
                         std::size_t chunks,
                         std::size_t hops,
                         int lookahead,
                         double cut_chance,
                         Dice& dice) {
    BatchWriter writer(chunks, hops, lookahead);
    for (std::size_t chunk = 0; chunk < chunks; ++chunk) {
        std::vector<Span> spans = {{0, hops}};
        if (cut_chance > 0.0) {
            const double length = static_cast<double>(hops);
            const std::size_t cut = dice.chance(cut_chance)
                                        ? static_cast<std::size_t>(dice.uniform(
                                              kEarliestCut * length, kLatestCut * length))
                                        : hops;
            spans = {{0, cut}, {cut, hops}};  // the second is empty where nothing is cut
        }
        NetworkInput input;
        for (const Span& span : spans) {
            const TrainingExcerpt& excerpt =
                *dice.pick(std::span<const TrainingExcerpt* const>(from));
            const Hearing hearing = draw_hearing(excerpt, span.end - span.begin, dice);
            writer.write(chunk, span, excerpt, hearing, input, &dice);
        }
    }
    return writer.finish();
}

TrainingBatch plain_batch(const std::vector<const TrainingExcerpt*>& excerpts,
                          std::size_t hops,
                          int lookahead) {
    BatchWriter writer(excerpts.size(), hops, lookahead);
    Hearing hearing;
    hearing.gain.fill(1.0F);
    for (std::size_t chunk = 0; chunk < excerpts.size(); ++chunk) {
        NetworkInput input;
        writer.write(chunk, {0, hops}, *excerpts[chunk], hearing, input, nullptr);
    }
    return writer.finish();
}

}  // namespace raks::audio
