#include "audio/song/song_pulses.hpp"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <span>
#include <utility>

#include "audio/beat/analyzer_command.hpp"
#include "audio/beat/pulse_belief.hpp"
#include "audio/song/song_margins.hpp"

namespace raks::audio {
namespace {

constexpr int kPasses = 2;                   // a corrected pulse may have a better one itself
constexpr std::size_t kBelievedAround = 12;  // beats on either side that are heard together
constexpr std::size_t kFewestOfPulse = 8;    // beats of a sequence that can be judged
constexpr std::size_t kShortestRun = 8;      // beats that another pulse must last
constexpr std::size_t kNotSettled = 5;       // beats that a network hears before it is believed
constexpr float kBetter = 0.6F;              // probability of a rival that is taken

using Evidences = std::vector<PulseEvidence>;

// Beats `first` to `end` of a path, a sequence that follows itself without a restart.
struct Sequence {
    const std::vector<PathBeat>& beats;
    std::size_t first = 0;
    std::size_t end = 0;

    [[nodiscard]] std::size_t size() const { return end - first; }
    // Hops from beat `i` to the next; the last beat is as long as the one before.
    [[nodiscard]] double length(std::size_t i) const {
        const std::size_t at = std::min(i, end - 2);
        return beats[at + 1].hop - beats[at].hop;
    }
};

// What the network says at each beat, as seen from beat number 0 of the path.
Evidences evidences_of(const SongRecording& song,
                       const std::shared_ptr<const PulseNetwork>& network,
                       const Sequence& sequence) {
    PulseNetworkStream stream(network);
    PulseInput input;
    Evidences evidences;
    const auto hops = static_cast<std::int64_t>(song.hops.size());
    for (std::size_t i = sequence.first; i < sequence.end; ++i) {
        const double length = sequence.length(i);
        const double begin =
            sequence.beats[i].hop - PulseInput::kEarlier * length - PulseInput::kAheadHops;
        for (auto hop = std::max<std::int64_t>(0, std::llround(std::ceil(begin)));
             static_cast<double>(hop) < begin + length && hop < hops;
             ++hop) {
            input.add_hop(song.mel_of(static_cast<std::size_t>(hop)),
                          (static_cast<double>(hop) - begin) / length);
        }
        PulseEvidence seen = seen_from_zero(stream.next(input.next_beat()), static_cast<long>(i));
        weigh_as_followed(seen);
        evidences.push_back(seen);
    }
    return evidences;
}

// Means over the beats around each; the first ones, at which nothing is known, do not count.
Evidences smoothed(const Evidences& from) {
    Evidences result;
    for (std::size_t i = 0; i < from.size(); ++i) {
        const std::size_t first =
            std::max(std::min(kNotSettled, from.size() - 1), i - std::min(i, kBelievedAround));
        const std::size_t end = std::min(from.size(), std::max(i, first) + kBelievedAround + 1);
        PulseEvidence mean{};
        for (std::size_t at = first; at < end; ++at) {
            for (std::size_t pulse = 0; pulse < mean.size(); ++pulse) {
                mean[pulse] += from[at][pulse] / static_cast<float>(end - first);
            }
        }
        result.push_back(mean);
    }
    return result;
}

// Number of the pulse that is the beat at each beat: 0, or a rival that is surely better for a
// while.
std::vector<std::size_t> choices_of(const Evidences& evidences, const Sequence& sequence) {
    std::vector<std::size_t> choices;
    for (std::size_t i = 0; i < evidences.size(); ++i) {
        const PulseEvidence& seen = evidences[i];
        const auto best =
            static_cast<std::size_t>(std::max_element(seen.begin(), seen.end()) - seen.begin());
        const double bpm = 60.0 * kHopsPerSecond / sequence.length(sequence.first + i);
        const bool is_there = is_followed(Bpm(bpm * pulse_at(best).rate));
        choices.push_back(is_there && seen[best] >= kBetter ? best : 0);
    }
    for (std::size_t first = 0; first < choices.size();) {
        std::size_t end = first + 1;
        while (end < choices.size() && choices[end] == choices[first]) {
            ++end;
        }
        if (end - first < std::min(kShortestRun, choices.size())) {
            std::fill(choices.begin() + static_cast<std::ptrdiff_t>(first),
                      choices.begin() + static_cast<std::ptrdiff_t>(end),
                      first == 0 ? 0 : choices[first - 1]);
        }
        first = end;
    }
    return choices;
}

/// Beats with the probability that they are of the right pulse.
struct JudgedPath {
    std::vector<PathBeat> beats;
    std::vector<float> right;
};

// Appends the beats of a pulse in place of those of a part of the sequence.
void put_pulse(const Sequence& part,
               std::span<const PulseEvidence> evidences,
               std::size_t pulse,
               bool is_apart,
               JudgedPath& path) {
    const RivalPulse rival = pulse_at(pulse);
    // From the first whole position of the pulse on.
    double number = std::ceil(rival.rate * static_cast<double>(part.first) + rival.offset - 1e-6);
    for (bool is_first = true;; number += 1.0, is_first = false) {
        const double position = (number - rival.offset) / rival.rate;
        if (position >= static_cast<double>(part.end) - 1e-6) {
            return;
        }
        const auto i = std::min(static_cast<std::size_t>(position + 1e-6), part.end - 1);
        const PathBeat& beat = part.beats[i];
        const std::size_t next = std::min(i + 1, part.beats.size() - 1);
        const double length = next > i && !part.beats[next].is_restart
                                  ? part.beats[next].hop - beat.hop
                                  : beat.hop - part.beats[i - 1].hop;
        path.beats.push_back({beat.hop + (position - static_cast<double>(i)) * length,
                              is_first && (is_apart || part.beats[part.first].is_restart)});
        path.right.push_back(evidences[i - part.first][pulse]);
    }
}

// One sequence, corrected.
void correct_sequence(const SongRecording& song,
                      const std::shared_ptr<const PulseNetwork>& network,
                      const SongMargins& margins,
                      const Sequence& sequence,
                      JudgedPath& path) {
    if (sequence.size() < kFewestOfPulse) {
        for (std::size_t i = sequence.first; i < sequence.end; ++i) {
            path.beats.push_back(sequence.beats[i]);
            path.right.push_back(0.5F);
        }
        return;
    }
    Evidences evidences = smoothed(evidences_of(song, network, sequence));
    for (std::size_t i = 0; i < evidences.size(); ++i) {
        weigh_by_margins(margins.around(sequence.first + i), evidences[i]);
    }
    const std::vector<std::size_t> choices = choices_of(evidences, sequence);
    for (std::size_t first = 0; first < choices.size();) {
        std::size_t end = first + 1;
        while (end < choices.size() && choices[end] == choices[first]) {
            ++end;
        }
        put_pulse({sequence.beats, sequence.first + first, sequence.first + end},
                  std::span(evidences).subspan(first, end - first),
                  choices[first],
                  first > 0,
                  path);
        first = end;
    }
}

}  // namespace

std::vector<float> correct_pulse(const SongRecording& song,
                                 const std::shared_ptr<const PulseNetwork>& network,
                                 std::vector<PathBeat>& beats) {
    std::vector<float> right(beats.size(), 0.5F);
    const bool has_sound = !song.hops.empty() && song.hops.front().has_evidence;
    for (int pass = 0; pass < kPasses && network && has_sound; ++pass) {
        const SongMargins margins(song, beats);
        JudgedPath path;
        for (std::size_t first = 0; first < beats.size();) {
            std::size_t end = first + 1;
            while (end < beats.size() && !beats[end].is_restart) {
                ++end;
            }
            correct_sequence(song, network, margins, {beats, first, end}, path);
            first = end;
        }
        beats = std::move(path.beats);
        right = std::move(path.right);
    }
    return right;
}

}  // namespace raks::audio
