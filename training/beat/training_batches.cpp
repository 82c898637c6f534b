#include "training/beat/training_batches.hpp"

#include <algorithm>
#include <cmath>

#include "audio/beat/network/beat_network.hpp"
#include "training/networks/mel_augmentation.hpp"

namespace raks::audio {
namespace {

constexpr std::size_t kOutputs = BeatNetwork::kOutputs;
constexpr double kHopsPerSecond = 100.0;
constexpr std::size_t kWarmUpHops = 120;  // of a chunk: the network has not seen what came before
constexpr float kWarmUpWeight = 0.2F;
// Downbeats weigh more: to place them the network has to count beats, which it learns last.
constexpr float kDownbeatWeight = 2.0F;
constexpr float kHalfWeight = 0.7F;

constexpr double kMostStretch = 0.16;  // ln of the time stretch

// Where in a chunk another piece may begin.
constexpr double kEarliestCut = 0.25;  // of the chunk
constexpr double kLatestCut = 0.6;

/// Hops [begin, end) of a chunk that one excerpt fills.
struct Span {
    std::size_t begin = 0;
    std::size_t end = 0;
};

// Fills one batch, rows hop-major: hop * chunks + chunk.
class BatchWriter {
 public:
    BatchWriter(std::size_t chunks, std::size_t hops, int lookahead) : lookahead_(lookahead) {
        batch_.steps = hops;
        batch_.chunks = chunks;
        batch_.inputs.resize(hops * chunks * NetworkInput::kSize);
        batch_.targets.resize(hops * chunks * kOutputs);
        batch_.weights.resize(hops * chunks * kOutputs);
    }

    // Inputs and targets of one excerpt in a span of a chunk. `input` carries on from the span
    // before.
    void write(std::size_t chunk,
               const Span& span,
               const TrainingExcerpt& excerpt,
               const MelAugmentation& augmentation,
               NetworkInput& input,
               Dice* dice) {
        const auto put = [&](std::size_t t, const NetworkInput::Frame& frame) {
            const std::size_t row = (span.begin + t) * batch_.chunks + chunk;
            std::copy(frame.begin(),
                      frame.end(),
                      batch_.inputs.begin() + static_cast<std::ptrdiff_t>(row * frame.size()));
        };
        augment_mel(excerpt.mel, augmentation, span.end - span.begin, input, dice, put);
        write_targets(chunk, span, excerpt, augmentation);
    }
    TrainingBatch finish() { return std::move(batch_); }

 private:
    // Outputs: 0 beat, 1 downbeat, 2 half-way between beats. Each is 1 where it happens.
    void write_targets(std::size_t chunk,
                       const Span& span,
                       const TrainingExcerpt& excerpt,
                       const MelAugmentation& augmentation) {
        // Seconds in the piece to a hop in the chunk: shift, stretch, and the network's look-ahead.
        const auto hop_of = [&](double seconds) {
            return static_cast<double>(span.begin) + lookahead_ +
                   (seconds * kHopsPerSecond - augmentation.first_hop) / augmentation.stretch;
        };
        const std::vector<PlayedBeat>& beats = excerpt.beats;
        double known_until = 0.0;  // hop up to which the annotations reach
        for (std::size_t i = 0; i < beats.size(); ++i) {
            const double at = hop_of(beats[i].time);
            mark(chunk, span, at, 0);
            if (beats[i].bar_position == 1) {
                mark(chunk, span, at, 1);
            }
            if (i + 1 < beats.size()) {
                const double next = hop_of(beats[i + 1].time);
                mark(chunk, span, 0.5 * (at + next), 2);
                // A little past the last beat; further on there may be beats that are not
                // annotated.
                known_until = next + 0.4 * (next - at);
            }
        }
        for (std::size_t t = span.begin; t < span.end; ++t) {
            // No weight after the annotations or after the end of the excerpt. Without any beat the
            // whole excerpt counts as having none.
            const std::size_t since = t - span.begin;
            const bool is_known =
                (beats.empty() || static_cast<double>(t) < known_until) &&
                augmentation.first_hop + static_cast<double>(since) * augmentation.stretch <
                    static_cast<double>(excerpt.hops());
            const float weight = !is_known ? 0.0F : since < kWarmUpHops ? kWarmUpWeight : 1.0F;
            float* const weights = &batch_.weights[(t * batch_.chunks + chunk) * kOutputs];
            weights[0] = weight;
            weights[1] = kDownbeatWeight * weight;
            weights[2] = kHalfWeight * weight;
        }
    }
    /// Marks an output at a fractional hop: a triangle, 1 at the hop, 0 from two hops away.
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
        // Without a chance of a cut nothing is drawn for it, so older seeds give the same batches.
        std::vector<Span> spans = {{0, hops}};
        if (cut_chance > 0.0) {
            const double length = static_cast<double>(hops);
            const std::size_t cut = dice.chance(cut_chance)
                                        ? static_cast<std::size_t>(dice.uniform(
                                              kEarliestCut * length, kLatestCut * length))
                                        : hops;
            spans = {{0, cut}, {cut, hops}};  // the second is empty where nothing is cut
        }
        // One input for the whole chunk: its level and history carry over the cut.
        NetworkInput input;
        for (const Span& span : spans) {
            const TrainingExcerpt& excerpt =
                *dice.pick(std::span<const TrainingExcerpt* const>(from));
            const MelAugmentation augmentation =
                MelAugmentation::draw(excerpt.hops(), span.end - span.begin, kMostStretch, dice);
            writer.write(chunk, span, excerpt, augmentation, input, &dice);
        }
    }
    return writer.finish();
}

TrainingBatch plain_batch(const std::vector<const TrainingExcerpt*>& excerpts,
                          std::size_t hops,
                          int lookahead) {
    BatchWriter writer(excerpts.size(), hops, lookahead);
    const MelAugmentation augmentation = MelAugmentation::plain();
    for (std::size_t chunk = 0; chunk < excerpts.size(); ++chunk) {
        NetworkInput input;
        writer.write(chunk, {0, hops}, *excerpts[chunk], augmentation, input, nullptr);
    }
    return writer.finish();
}

}  // namespace raks::audio
