#include "training/beat/train_bars.hpp"

#include <algorithm>
#include <array>
#include <thread>

#include "training/beat/bar_sequences.hpp"
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

}  // namespace raks::audio
