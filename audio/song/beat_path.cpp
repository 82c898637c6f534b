#include "audio/song/beat_path.hpp"

#include <algorithm>
#include <array>
#include <cstdint>
#include <limits>

#include "base/simd_clones.hpp"

namespace raks::audio {
namespace {

constexpr std::uint8_t kRestart = 255;  // in place of the number of a tempo
static_assert(kRestart >
              200);  // more tempi than BeatPointerConfig asks for, in two and three parts

constexpr std::int64_t kAhead = 5;  // hops that a beat may lie before the song

// Standard deviations of the smoother.
constexpr double kPlaceNoise = 0.8;     // hops: the raster, and how far players scatter
constexpr double kLengthDrift = 0.004;  // change of the beat's length from beat to beat, as a ratio

// The most likely predecessor of each state: of all states but the first ones it is the state
// before; of the first ones it is kept here.
class Viterbi {
 public:
    Viterbi(const PointerStates& states, std::size_t hops)
        : states_(states),
          best_(states.prior().begin(), states.prior().end()),
          moved_(states.size()),
          arrived_from_(hops * states.tempi().size()),
          best_state_(hops) {}

    void advance(const SongHop& hop) {
        if (hop_ > 0) {
            move();
        } else {
            moved_ = best_;
        }
        if (!hop.is_blind && hop.has_evidence) {
            states_.weigh(moved_, moved_, 0.0F, hop.onset_strength, hop.evidence);
        } else if (!hop.is_blind) {
            states_.weigh(moved_, moved_, 0.0F, hop.onset_strength);
        }
        // Scaled so that the best state has 1: the others fall to 0 before they could matter.
        const auto best = std::max_element(moved_.begin(), moved_.end());
        best_state_[hop_] = static_cast<std::uint16_t>(best - moved_.begin());
        const float scale = 1.0F / *best;
        for (std::size_t i = 0; i < moved_.size(); ++i) {
            best_[i] = moved_[i] * scale;
        }
        ++hop_;
    }

    // Walks back from the best state after the last hop.
    [[nodiscard]] std::vector<PathBeat> beats() const {
        std::vector<PathBeat> found;
        auto hop = static_cast<std::int64_t>(hop_) - 1;
        std::size_t state = hop >= 0 ? best_state_[static_cast<std::size_t>(hop)] : 0;
        while (hop >= 0) {
            const std::size_t tempo = tempo_of(state);
            hop -= static_cast<std::int64_t>(state) - states_.tempi()[tempo].first;
            if (hop < 0) {
                // Before the song; one on its first sample may seem to be a little before it.
                if (hop >= -kAhead) {
                    found.push_back({static_cast<double>(hop), false});
                }
                break;
            }
            const auto at = static_cast<std::size_t>(hop);
            const std::uint8_t from = arrived_from_[at * states_.tempi().size() + tempo];
            found.push_back({static_cast<double>(hop), hop > 0 && from == kRestart});
            if (hop == 0) {
                break;
            }
            state = from == kRestart ? best_state_[at - 1]
                                     : states_.tempi()[from].state(states_.tempi()[from].hops - 1);
            --hop;
        }
        std::reverse(found.begin(), found.end());
        return found;
    }

 private:
    // The best way into each first state; all other states are entered from the one before.
    void move() {
        const std::span<const PointerStates::Tempo> tempi = states_.tempi();
        std::copy(best_.begin(), best_.end() - 1, moved_.begin() + 1);
        std::uint8_t* const from_row = &arrived_from_[hop_ * tempi.size()];
        for (std::size_t to = 0; to < tempi.size(); ++to) {
            const auto first = tempi[to].state(0);
            // A restart from the best state, which has 1.
            float most =
                states_.leak() * states_.prior()[first] * static_cast<float>(tempi[to].hops);
            std::uint8_t from = kRestart;
            for (std::size_t i = 0; i < tempi.size(); ++i) {
                const float way =
                    best_[tempi[i].state(tempi[i].hops - 1)] * states_.transitions(i)[to];
                if (way > most) {
                    most = way;
                    from = static_cast<std::uint8_t>(i);
                }
            }
            moved_[first] = most;
            from_row[to] = from;
        }
    }

    [[nodiscard]] std::size_t tempo_of(std::size_t state) const {
        const auto after = std::upper_bound(
            states_.tempi().begin(),
            states_.tempi().end(),
            static_cast<int>(state),
            [](int number, const PointerStates::Tempo& tempo) { return number < tempo.first; });
        return static_cast<std::size_t>(after - states_.tempi().begin()) - 1;
    }

    const PointerStates& states_;
    std::vector<float> best_;  // probability of the best path into each state, scaled
    std::vector<float> moved_;
    std::vector<std::uint8_t> arrived_from_;  // hop x tempo: tempo of the beat before
    std::vector<std::uint16_t> best_state_;   // by hop
    std::size_t hop_ = 0;
};

// Place and length of a beat, with their covariance.
struct BeatState {
    double place = 0.0;
    double length = 0.0;
    double place_variance = 0.0;
    double covariance = 0.0;
    double length_variance = 0.0;
};

// The state one beat later, before it is heard.
BeatState predicted(const BeatState& state) {
    const double drift = kLengthDrift * state.length;
    return {state.place + state.length,
            state.length,
            state.place_variance + 2.0 * state.covariance + state.length_variance,
            state.covariance + state.length_variance,
            state.length_variance + drift * drift};
}

// The state after its beat was heard at `place`.
BeatState corrected(const BeatState& state, double place) {
    const double noise = kPlaceNoise * kPlaceNoise;
    const double place_gain = state.place_variance / (state.place_variance + noise);
    const double length_gain = state.covariance / (state.place_variance + noise);
    const double error = place - state.place;
    return {state.place + place_gain * error,
            state.length + length_gain * error,
            (1.0 - place_gain) * state.place_variance,
            (1.0 - place_gain) * state.covariance,
            state.length_variance - length_gain * state.covariance};
}

// Takes into `state` what the smoothed state one beat later says beyond its prediction.
BeatState smoothed(const BeatState& state, const BeatState& next, const BeatState& smooth_next) {
    // Gain: covariance of this state with the predicted one, times the inverse of the latter's.
    const double determinant =
        next.place_variance * next.length_variance - next.covariance * next.covariance;
    const double cross[2][2] = {{state.place_variance + state.covariance, state.covariance},
                                {state.covariance + state.length_variance, state.length_variance}};
    const double place_error = smooth_next.place - next.place;
    const double length_error = smooth_next.length - next.length;
    const double place_weight =
        (next.length_variance * place_error - next.covariance * length_error) / determinant;
    const double length_weight =
        (next.place_variance * length_error - next.covariance * place_error) / determinant;
    BeatState result = state;
    result.place += cross[0][0] * place_weight + cross[0][1] * length_weight;
    result.length += cross[1][0] * place_weight + cross[1][1] * length_weight;
    return result;
}

// One sequence of at least three beats.
void smooth_sequence(std::span<PathBeat> beats) {
    std::vector<BeatState> filtered;
    std::vector<BeatState> expected;  // before each beat
    const double length =
        (beats.back().hop - beats.front().hop) / static_cast<double>(beats.size() - 1);
    BeatState state{beats.front().hop, length, kPlaceNoise * kPlaceNoise, 0.0, length * length};
    for (const PathBeat& beat : beats) {
        expected.push_back(filtered.empty() ? state : predicted(filtered.back()));
        filtered.push_back(corrected(expected.back(), beat.hop));
    }
    BeatState smooth = filtered.back();
    for (std::size_t i = beats.size(); i-- > 0;) {
        smooth = i + 1 == beats.size() ? smooth : smoothed(filtered[i], expected[i + 1], smooth);
        beats[i].hop = smooth.place;
    }
}

}  // namespace

std::vector<PathBeat> find_beats(std::span<const SongHop> hops, const PointerStates& states) {
    Viterbi viterbi(states, hops.size());
    for (const SongHop& hop : hops) {
        viterbi.advance(hop);
    }
    return viterbi.beats();
}

void smooth_beats(std::vector<PathBeat>& beats) {
    for (std::size_t first = 0; first < beats.size();) {
        std::size_t end = first + 1;
        while (end < beats.size() && !beats[end].is_restart) {
            ++end;
        }
        if (end - first >= 3) {
            smooth_sequence(std::span(beats).subspan(first, end - first));
        }
        first = end;
    }
}

}  // namespace raks::audio
