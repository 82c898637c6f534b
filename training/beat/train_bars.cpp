#include "training/beat/train_bars.hpp"

#include <algorithm>
#include <array>
#include <thread>

#include "base/time.hpp"
#include "training/networks/network_descent.hpp"

namespace raks::audio {
namespace {

constexpr int kReportBarsEvery = 100;       // steps
constexpr std::size_t kKeepBarsEvery = 16;  // every such excerpt is for validation
constexpr std::size_t kChunks = 48;         // of a batch
constexpr std::size_t kBeats = 96;          // of a chunk
constexpr std::size_t kFewestBeats = 8;     // of a piece: fewer do not show its bars
constexpr double kMostBarStretch = 0.1;     // ln of the time stretch
// Share of a piece that an augmented version covers, so that it fits at any stretch.
constexpr double kCopyShare = 0.75;

// Has the excerpt sound, enough beats and annotated bar positions?
bool has_bars(const TrainingExcerpt& excerpt) {
    const bool is_told = std::any_of(excerpt.beats.begin(),
                                     excerpt.beats.end(),
                                     [](const PlayedBeat& beat) { return beat.bar_position > 0; });
    return excerpt.hops() > 0 && excerpt.beats.size() >= kFewestBeats && is_told;
}

/// Features of each excerpt in several augmented versions; of those for validation only the plain
/// one. Excerpts without bars are left out.
class SplitCorpus {
 public:
    SplitCorpus(const std::vector<TrainingExcerpt>& corpus,
                const std::shared_ptr<const BeatNetwork>& beats,
                const BarPlan& plan) {
        // The beat network runs over every version once; the excerpts are dealt to the threads by
        // number, and each has its own slot, so the result does not depend on the threads.
        std::vector<std::vector<BarSequence>> sequences(corpus.size());
        const auto work = [&](std::size_t first) {
            for (std::size_t i = first; i < corpus.size();
                 i += static_cast<std::size_t>(plan.threads)) {
                sequences[i] = sequences_of(corpus[i], i, beats, plan);
            }
        };
        // The scope ends when all workers are done.
        {
            std::vector<std::jthread> workers;
            workers.reserve(static_cast<std::size_t>(plan.threads));
            for (int n = 0; n < plan.threads; ++n) {
                workers.emplace_back(work, static_cast<std::size_t>(n));
            }
        }
        std::vector<BarSequence> kept;
        for (std::size_t i = 0; i < sequences.size(); ++i) {
            if (sequences[i].empty()) {
                continue;
            }
            if (i % kKeepBarsEvery == 0) {
                kept.push_back(std::move(sequences[i].front()));
            } else {
                training.push_back(std::move(sequences[i]));
            }
        }
        validation.push_back(plain_bar_batch(kept, kBeats));
    }

    std::vector<std::vector<BarSequence>> training;
    std::vector<TrainingBatch> validation;

 private:
    static std::vector<BarSequence> sequences_of(const TrainingExcerpt& excerpt,
                                                 std::size_t number,
                                                 const std::shared_ptr<const BeatNetwork>& beats,
                                                 const BarPlan& plan) {
        std::vector<BarSequence> copies;
        // One version, the plain one, for validation.
        const int count = number % kKeepBarsEvery == 0 ? 1 : plan.copies;
        // A stream for each excerpt, apart from those of the batches.
        Dice dice(plan.seed, 500'000 + number);
        const auto hops = static_cast<double>(excerpt.hops());
        for (int n = 0; n < count && has_bars(excerpt); ++n) {
            const auto share = static_cast<std::size_t>(kCopyShare * hops);
            BarSequence sequence =
                n == 0 ? make_bar_sequence(excerpt, beats, MelAugmentation::plain(), nullptr)
                       : make_bar_sequence(
                             excerpt,
                             beats,
                             MelAugmentation::draw(excerpt.hops(), share, kMostBarStretch, dice),
                             &dice);
            if (!sequence.frames.empty()) {
                copies.push_back(std::move(sequence));
            }
        }
        return copies;
    }
};

/// First weights, with output biases at about the log frequencies of the classes.
BarNetwork fresh_network(const BarPlan& plan) {
    BarNetwork network(plan.units, plan.layers);
    initialize(network, plan.seed);
    constexpr std::array kBiases = {-0.3F, -0.7F, 0.5F};
    std::copy(kBiases.begin(),
              kBiases.end(),
              network.parameters().begin() + static_cast<std::ptrdiff_t>(network.output_biases()));
    return network;
}

}  // namespace

BarNetwork train_bars(
    const std::vector<TrainingExcerpt>& corpus,
    const std::shared_ptr<const BeatNetwork>& beats,
    const BarPlan& plan,
    const std::function<void(const NetworkProgress&, const BarNetwork&)>& report) {
    const SplitCorpus sequences(corpus, beats, plan);
    BarNetwork network = fresh_network(plan);
    if (sequences.training.empty()) {
        return network;
    }
    NetworkDescent descent(network, plan.threads);
    double loss = 0.0;
    int since = 0;
    for (int step = 0; step < plan.steps; ++step) {
        // Each shard of each step has its own stream of draws.
        constexpr std::size_t kShards = NetworkDescent::kShards;
        loss += descent.step(rate_at(plan.rate, step, plan.steps), [&](std::size_t shard) {
            Dice dice(plan.seed, 1000 + static_cast<std::uint64_t>(step) * kShards + shard);
            return draw_bar_batch(sequences.training, kChunks / kShards, kBeats, dice);
        });
        ++since;
        if ((step + 1) % kReportBarsEvery == 0 || step + 1 == plan.steps) {
            report({step + 1, plan.steps, loss / since, descent.loss_of(sequences.validation)},
                   network);
            loss = 0.0;
            since = 0;
        }
    }
    return network;
}

namespace {

// Standard deviation of a simulated tracker's beat times, hops: a good and a poor tracker.
constexpr double kSteadyError = 0.6;
constexpr double kLooseError = 1.5;
constexpr double kLeftOut = 0.006;     // share of the beats that are left out
constexpr double kTwice = 0.003;       // share of the beats that come twice
constexpr double kDropped = 0.1;       // dropout: share of the inputs set to 0
constexpr double kLatestStart = 0.33;  // share of a piece within which a sequence begins
// At a piece's first beats the position in the bar cannot be known: they weigh less.
constexpr std::size_t kFirstBeats = 4;
constexpr float kFirstWeight = 0.3F;

/// Time of each beat in hops of the augmented sound, with the simulated tracking error.
std::vector<double> moments_of(const std::vector<PlayedBeat>& beats,
                               const MelAugmentation& augmentation,
                               Dice* dice) {
    const double error = dice == nullptr ? 0.0 : dice->chance(0.5) ? kSteadyError : kLooseError;
    std::vector<double> moments;
    for (const PlayedBeat& beat : beats) {
        // Piece time to augmented time: shift, then stretch.
        const double moment =
            (beat.time * kHopsPerSecond - augmentation.first_hop) / augmentation.stretch;
        moments.push_back(moment + (dice != nullptr ? dice->normal(error) : 0.0));
    }
    // Errors may swap two close beats; times must ascend.
    std::sort(moments.begin(), moments.end());
    return moments;
}

// A batch of zeros: targets without weight count for nothing.
TrainingBatch empty_batch(std::size_t beats, std::size_t chunks) {
    TrainingBatch batch;
    batch.loss = TrainingBatch::Loss::softmax;
    batch.steps = beats;
    batch.chunks = chunks;
    batch.inputs.resize(beats * chunks * BarInput::kSize);
    batch.targets.resize(beats * chunks * BarNetwork::kOutputs);
    batch.weights.resize(batch.targets.size());
    return batch;
}

// One-hot target of one frame.
void put_target(TrainingBatch& batch, std::size_t frame, BarTarget place, float weight) {
    if (place == BarTarget::unknown) {
        return;
    }
    const auto row = static_cast<std::ptrdiff_t>(frame * BarNetwork::kOutputs);
    batch.targets[static_cast<std::size_t>(row) + static_cast<std::size_t>(place)] = 1.0F;
    std::fill_n(batch.weights.begin() + row, BarNetwork::kOutputs, weight);
}

/// Copies the beats of one sequence to a chunk from step `t` on; returns the step after the last.
std::size_t put_sequence(const BarSequence& sequence,
                         std::size_t chunk,
                         std::size_t t,
                         TrainingBatch& batch,
                         Dice& dice) {
    const auto count = sequence.frames.size();
    const double latest = kLatestStart * static_cast<double>(count);
    std::size_t beats_since_gap = 0;  // beats since the start or the last mistake
    for (auto i = static_cast<std::size_t>(dice.uniform(0.0, latest));
         i < count && t < batch.steps;) {
        // One draw decides both mistakes: small values leave the beat out, large ones repeat it.
        const double draw = dice.uniform();
        if (draw < kLeftOut) {
            ++i;
            beats_since_gap = 0;
            continue;
        }
        const std::size_t frame = t * batch.chunks + chunk;
        float* const inputs = &batch.inputs[frame * BarInput::kSize];
        for (std::size_t k = 0; k < BarInput::kSize; ++k) {
            inputs[k] = dice.chance(kDropped) ? 0.0F : sequence.frames[i][k];
        }
        put_target(
            batch, frame, sequence.places[i], beats_since_gap < kFirstBeats ? kFirstWeight : 1.0F);
        ++t;
        // Repeated: `i` stays, so the same beat follows again, and counting starts anew.
        if (draw > 1.0 - kTwice) {
            beats_since_gap = 0;
        } else {
            ++beats_since_gap;
            ++i;
        }
    }
    return t;
}

}  // namespace

std::vector<BarTarget> places_of(const std::vector<PlayedBeat>& beats) {
    std::vector<BarTarget> places(beats.size(), BarTarget::other);
    int longest = 0;
    for (const PlayedBeat& beat : beats) {
        longest = std::max(longest, beat.bar_position);
    }
    // Backwards, because a bar's length is known at its end: the position before the next first
    // beat. The last bar may be cut short and is taken for the longest.
    int bar = longest;
    for (std::size_t i = beats.size(); i-- > 0;) {
        const int position = beats[i].bar_position;
        if (i + 1 < beats.size() && beats[i + 1].bar_position == 1) {
            bar = position;
        }
        const bool is_middle = (bar == 4 || bar == 6) && position == bar / 2 + 1;
        places[i] = position <= 0   ? BarTarget::unknown
                    : position == 1 ? BarTarget::first
                    : is_middle     ? BarTarget::middle
                                    : BarTarget::other;
    }
    return places;
}

BarSequence make_bar_sequence(const TrainingExcerpt& excerpt,
                              const std::shared_ptr<const BeatNetwork>& network,
                              const MelAugmentation& augmentation,
                              Dice* dice) {
    const std::vector<double> moments = moments_of(excerpt.beats, augmentation, dice);
    const std::vector<BarTarget> places = places_of(excerpt.beats);
    // Hops of augmented sound that the piece fills.
    const double hops =
        (static_cast<double>(excerpt.hops()) - augmentation.first_hop) / augmentation.stretch;
    NetworkInput network_input;
    BeatNetworkStream stream(network);
    BarInput bar_input;
    BarSequence sequence;
    std::size_t next = 0;  // beat
    const auto take_hop = [&](std::size_t t, const auto& bands) {
        const BeatEvidence evidence = stream.next(network_input.next(bands));
        // A sound shows kAheadHops before its moment: half of the window that is centred on it.
        const double now = static_cast<double>(t) + BarInput::kAheadHops;
        for (; next < moments.size() && now >= moments[next]; ++next) {
            if (next == 0 || t == 0) {
                continue;
            }
            // Closes the beat that ends here; frames describe beat next - 1.
            const BarInput::Frame frame = bar_input.next_beat();
            // Its begin lies within the sound.
            if (moments[next - 1] > BarInput::kAheadHops - 1.0) {
                sequence.frames.push_back(frame);
                sequence.places.push_back(places[next - 1]);
            }
        }
        // Adds this hop to the beat under way, at its phase between the two beats.
        if (next > 0 && next < moments.size()) {
            const double length = moments[next] - moments[next - 1];
            bar_input.add_hop(bands, (now - moments[next - 1]) / length, evidence);
        }
    };
    augment_bands(
        excerpt.mel, augmentation, static_cast<std::size_t>(std::max(0.0, hops)), dice, take_hop);
    return sequence;
}

TrainingBatch draw_bar_batch(const std::vector<std::vector<BarSequence>>& from,
                             std::size_t chunks,
                             std::size_t beats,
                             Dice& dice) {
    TrainingBatch batch = empty_batch(beats, chunks);
    for (std::size_t chunk = 0; chunk < chunks; ++chunk) {
        // Pieces follow one another until the chunk is full; the last is cut.
        for (std::size_t t = 0; t < beats;) {
            const auto& copies = dice.pick(std::span(from));
            t = put_sequence(dice.pick(std::span(copies)), chunk, t, batch, dice);
        }
    }
    return batch;
}

TrainingBatch plain_bar_batch(const std::vector<BarSequence>& sequences, std::size_t beats) {
    TrainingBatch batch = empty_batch(beats, sequences.size());
    for (std::size_t chunk = 0; chunk < sequences.size(); ++chunk) {
        // First beats have no weight at all in validation.
        const BarSequence& sequence = sequences[chunk];
        for (std::size_t t = 0; t < std::min(beats, sequence.frames.size()); ++t) {
            const std::size_t frame = t * batch.chunks + chunk;
            std::copy(sequence.frames[t].begin(),
                      sequence.frames[t].end(),
                      &batch.inputs[frame * BarInput::kSize]);
            put_target(batch, frame, sequence.places[t], t < kFirstBeats ? 0.0F : 1.0F);
        }
    }
    return batch;
}

}  // namespace raks::audio
