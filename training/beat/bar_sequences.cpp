#include "training/beat/bar_sequences.hpp"

#include <algorithm>

#include "base/time.hpp"

namespace raks::audio {
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
void put_target(TrainingBatch& batch, std::size_t frame, BarPlace place, float weight) {
    if (place == BarPlace::unknown) {
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

std::vector<BarPlace> places_of(const std::vector<PlayedBeat>& beats) {
    std::vector<BarPlace> places(beats.size(), BarPlace::other);
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
        places[i] = position <= 0   ? BarPlace::unknown
                    : position == 1 ? BarPlace::first
                    : is_middle     ? BarPlace::middle
                                    : BarPlace::other;
    }
    return places;
}

BarSequence make_bar_sequence(const TrainingExcerpt& excerpt,
                              const std::shared_ptr<const BeatNetwork>& network,
                              const MelAugmentation& augmentation,
                              Dice* dice) {
    const std::vector<double> moments = moments_of(excerpt.beats, augmentation, dice);
    const std::vector<BarPlace> places = places_of(excerpt.beats);
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
