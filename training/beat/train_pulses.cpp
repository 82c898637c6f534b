#include "training/beat/train_pulses.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>
#include <thread>

#include "audio/beat/analyzer_command.hpp"
#include "base/time.hpp"
#include "training/networks/network_descent.hpp"

namespace raks::audio {
namespace {

constexpr int kReportPulsesEvery = 100;        // steps
constexpr std::size_t kKeepPulsesEvery = 16;   // every such excerpt is for validation
constexpr std::size_t kPulseChunks = 48;       // of a batch
constexpr std::size_t kPulseBeats = 64;        // of a chunk
constexpr std::size_t kFewestPulseBeats = 12;  // of the music in a piece
constexpr double kMostPulseStretch = 0.15;     // ln of the time stretch
constexpr double kPulseCopyShare = 0.8;        // of a piece that an augmented version covers
constexpr double kPulseError = 0.8;            // hops: standard deviation of the tracking error
constexpr double kPulseDropped = 0.1;          // dropout: share of the inputs set to 0
constexpr std::size_t kUnsettled = 6;          // beats from which the pulse cannot be told
constexpr float kUnsettledWeight = 0.3F;       // how much they weigh
constexpr double kMostUneven = 0.25;           // of an interval between beats against its neighbour

// How often a pulse is the beat while another is followed, by kind.
constexpr std::array<double, kRivalKinds> kShareOfKind = {
    0.06,   // twice
    0.16,   // half: slow songs are followed at twice their tempo
    0.08,   // off_beat
    0.04,   // third_off
    0.04,   // quarter_off
    0.06,   // three_for_two
    0.15,   // two_for_three: dotted beats are followed as quarters
    0.02,   // thrice
    0.06};  // one_for_three
constexpr double kShareOfRight = 0.33;

std::size_t draw_pulse(Dice& dice) {
    std::array<double, PulseNetwork::kOutputs> shares{kShareOfRight};
    std::array<int, kRivalKinds> of_kind{};
    for (const RivalPulse& rival : kRivalPulses) {
        ++of_kind[static_cast<std::size_t>(rival.kind)];
    }
    double sum = kShareOfRight;
    for (std::size_t i = 0; i < kRivalPulses.size(); ++i) {
        const auto kind = static_cast<std::size_t>(kRivalPulses[i].kind);
        shares[1 + i] = kShareOfKind[kind] / of_kind[kind];
        sum += shares[1 + i];
    }
    double left = dice.uniform() * sum;
    for (std::size_t i = 0; i < shares.size(); ++i) {
        left -= shares[i];
        if (left < 0.0) {
            return i;
        }
    }
    return 0;
}

// Enough beats, and none much longer than its neighbour, as in additive metres?
bool has_even_beats(const TrainingExcerpt& excerpt) {
    const auto& beats = excerpt.beats;
    if (excerpt.hops() == 0 || beats.size() < kFewestPulseBeats) {
        return false;
    }
    int uneven = 0;
    for (std::size_t i = 2; i < beats.size(); ++i) {
        const double ratio =
            (beats[i].time - beats[i - 1].time) / (beats[i - 1].time - beats[i - 2].time);
        uneven += std::abs(std::log(std::max(1e-3, ratio))) > kMostUneven ? 1 : 0;
    }
    return uneven * 20 < static_cast<int>(beats.size());
}

// Seconds between two beats in the middle of the piece.
double usual_interval(const std::vector<PlayedBeat>& beats) {
    return (beats.back().time - beats.front().time) / static_cast<double>(beats.size() - 1);
}

// Time of a place between the beats of the music, in seconds; nothing beyond them.
std::optional<double> time_at(const std::vector<PlayedBeat>& beats, double position) {
    const double whole = std::floor(position + 1e-9);
    if (whole < 0.0 || whole + 1.0 >= static_cast<double>(beats.size())) {
        return std::nullopt;
    }
    const auto i = static_cast<std::size_t>(whole);
    return beats[i].time + (position - whole) * (beats[i + 1].time - beats[i].time);
}

/// Beats of the pulse that is followed.
struct Followed {
    std::vector<double> moments;      // hops of the augmented sound
    std::vector<std::size_t> places;  // of the beat of the music
};

Followed follow(const std::vector<PlayedBeat>& beats,
                std::size_t pulse,
                int shift,
                const MelAugmentation& augmentation,
                Dice* dice) {
    Followed followed;
    const RivalPulse seen = pulse_at(pulse);
    const long end = std::lround(std::ceil(static_cast<double>(beats.size()) / seen.rate)) + 1;
    double error = 0.0;
    for (long n = -3 - shift; n < end; ++n) {
        const auto time = time_at(beats, seen.rate * static_cast<double>(n) + seen.offset + shift);
        if (!time) {
            continue;
        }
        // Errors change slowly, as a tracker's do.
        error = dice != nullptr ? 0.8 * error + dice->normal(0.6 * kPulseError) : 0.0;
        followed.moments.push_back(
            (*time * kHopsPerSecond - augmentation.first_hop) / augmentation.stretch + error);
        followed.places.push_back(place_at(pulse, n));
    }
    return followed;
}

bool is_possible(const TrainingExcerpt& excerpt, std::size_t pulse, double stretch) {
    const double interval = usual_interval(excerpt.beats) / stretch;
    return is_followed(Bpm(60.0 / interval / pulse_at(pulse).rate));
}

/// Sequences of each excerpt in several versions; of those for validation fewer.
class PulseCorpus {
 public:
    PulseCorpus(const std::vector<TrainingExcerpt>& corpus, const PulsePlan& plan) {
        std::vector<std::vector<PulseSequence>> sequences(corpus.size());
        {
            std::vector<std::jthread> workers;
            workers.reserve(static_cast<std::size_t>(plan.threads));
            for (int n = 0; n < plan.threads; ++n) {
                workers.emplace_back([&, n] {
                    for (auto i = static_cast<std::size_t>(n); i < corpus.size();
                         i += static_cast<std::size_t>(plan.threads)) {
                        sequences[i] = versions_of(corpus[i], i, plan);
                    }
                });
            }
        }
        for (std::size_t i = 0; i < sequences.size(); ++i) {
            auto& to = i % kKeepPulsesEvery == 0 ? validation : training;
            std::move(sequences[i].begin(), sequences[i].end(), std::back_inserter(to));
        }
    }
    std::vector<PulseSequence> training;
    std::vector<PulseSequence> validation;

 private:
    static std::vector<PulseSequence> versions_of(const TrainingExcerpt& excerpt,
                                                  std::size_t number,
                                                  const PulsePlan& plan) {
        std::vector<PulseSequence> versions;
        if (!has_even_beats(excerpt)) {
            return versions;
        }
        Dice dice(plan.seed, 700'000 + number);
        const auto covered =
            static_cast<std::size_t>(kPulseCopyShare * static_cast<double>(excerpt.hops()));
        for (int n = 0; n < plan.copies; ++n) {
            const auto augmentation =
                MelAugmentation::draw(excerpt.hops(), covered, kMostPulseStretch, dice);
            std::size_t pulse = draw_pulse(dice);
            for (int tries = 0; !is_possible(excerpt, pulse, augmentation.stretch) && tries < 20;
                 ++tries) {
                pulse = draw_pulse(dice);
            }
            const int shift = dice.whole(0, 5);
            PulseSequence sequence =
                make_pulse_sequence(excerpt, pulse, shift, augmentation, &dice);
            if (!sequence.frames.empty()) {
                versions.push_back(std::move(sequence));
            }
        }
        return versions;
    }
};

TrainingBatch empty_pulse_batch(std::size_t chunks) {
    TrainingBatch batch;
    batch.loss = TrainingBatch::Loss::softmax;
    batch.steps = kPulseBeats;
    batch.chunks = chunks;
    batch.inputs.resize(batch.steps * chunks * PulseInput::kSize);
    batch.targets.resize(batch.steps * chunks * PulseNetwork::kOutputs);
    batch.weights.resize(batch.targets.size());
    return batch;
}

// Copies one sequence to a chunk from step `t` on; returns the step after the last.
std::size_t put_pulses(const PulseSequence& sequence,
                       std::size_t chunk,
                       std::size_t t,
                       TrainingBatch& batch,
                       Dice* dice) {
    for (std::size_t i = 0; i < sequence.frames.size() && t < batch.steps; ++i, ++t) {
        const std::size_t frame = t * batch.chunks + chunk;
        float* const inputs = &batch.inputs[frame * PulseInput::kSize];
        for (std::size_t k = 0; k < PulseInput::kSize; ++k) {
            inputs[k] =
                dice != nullptr && dice->chance(kPulseDropped) ? 0.0F : sequence.frames[i][k];
        }
        const std::size_t row = frame * PulseNetwork::kOutputs;
        batch.targets[row + sequence.places[i]] = 1.0F;
        std::fill_n(batch.weights.begin() + static_cast<std::ptrdiff_t>(row),
                    PulseNetwork::kOutputs,
                    i >= kUnsettled   ? 1.0F
                    : dice != nullptr ? kUnsettledWeight
                                      : 0.0F);
    }
    return t;
}

TrainingBatch draw_pulse_batch(const std::vector<PulseSequence>& from,
                               std::size_t chunks,
                               Dice& dice) {
    TrainingBatch batch = empty_pulse_batch(chunks);
    for (std::size_t chunk = 0; chunk < chunks; ++chunk) {
        for (std::size_t t = 0; t < kPulseBeats;) {
            t = put_pulses(dice.pick(std::span(from)), chunk, t, batch, &dice);
        }
    }
    return batch;
}

}  // namespace

PulseSequence make_pulse_sequence(const TrainingExcerpt& excerpt,
                                  std::size_t pulse,
                                  int shift,
                                  const MelAugmentation& augmentation,
                                  Dice* dice) {
    const Followed followed = follow(excerpt.beats, pulse, shift, augmentation, dice);
    const double hops =
        (static_cast<double>(excerpt.hops()) - augmentation.first_hop) / augmentation.stretch;
    PulseInput input;
    PulseSequence sequence;
    std::size_t next = 0;  // followed beat
    const auto take_hop = [&](std::size_t t, const auto& bands) {
        const double now = static_cast<double>(t) + PulseInput::kAheadHops;
        const auto begin_of = [&](std::size_t beat) {
            const double length = beat + 1 < followed.moments.size()
                                      ? followed.moments[beat + 1] - followed.moments[beat]
                                      : followed.moments[beat] - followed.moments[beat - 1];
            return followed.moments[beat] - PulseInput::kEarlier * length;
        };
        for (; next < followed.moments.size() && now >= begin_of(next); ++next) {
            if (next == 0 || t == 0) {
                continue;
            }
            const PulseInput::Frame frame = input.next_beat();
            if (begin_of(next - 1) > PulseInput::kAheadHops) {
                sequence.frames.push_back(frame);
                sequence.places.push_back(followed.places[next - 1]);
            }
        }
        if (next > 0 && next < followed.moments.size()) {
            const double begin = begin_of(next - 1);
            input.add_hop(bands, (now - begin) / (begin_of(next) - begin));
        }
    };
    if (followed.moments.size() > 2) {
        augment_bands(excerpt.mel,
                      augmentation,
                      static_cast<std::size_t>(std::max(0.0, hops)),
                      dice,
                      take_hop);
    }
    return sequence;
}

PulseNetwork train_pulses(
    const std::vector<TrainingExcerpt>& corpus,
    const PulsePlan& plan,
    const std::function<void(const NetworkProgress&, const PulseNetwork&)>& report) {
    const PulseCorpus sequences(corpus, plan);
    PulseNetwork network(plan.units, plan.layers);
    initialize(network, plan.seed);
    if (sequences.training.empty()) {
        return network;
    }
    std::vector<TrainingBatch> validation{empty_pulse_batch(sequences.validation.size())};
    for (std::size_t i = 0; i < sequences.validation.size(); ++i) {
        put_pulses(sequences.validation[i], i, 0, validation.front(), nullptr);
    }
    NetworkDescent descent(network, plan.threads);
    double loss = 0.0;
    int since = 0;
    for (int step = 0; step < plan.steps; ++step) {
        constexpr std::size_t kShards = NetworkDescent::kShards;
        loss += descent.step(rate_at(plan.rate, step, plan.steps), [&](std::size_t shard) {
            Dice dice(plan.seed, 1000 + static_cast<std::uint64_t>(step) * kShards + shard);
            return draw_pulse_batch(sequences.training, kPulseChunks / kShards, dice);
        });
        ++since;
        if ((step + 1) % kReportPulsesEvery == 0 || step + 1 == plan.steps) {
            report({step + 1, plan.steps, loss / since, descent.loss_of(validation)}, network);
            loss = 0.0;
            since = 0;
        }
    }
    return network;
}

}  // namespace raks::audio
