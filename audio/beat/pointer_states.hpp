#pragma once

#include <cstddef>
#include <span>
#include <vector>

#include "audio/beat/analyzer_command.hpp"
#include "audio/beat/network/beat_network.hpp"
#include "base/realtime.hpp"
#include "base/time.hpp"

namespace raks::audio {

/// Options of the pointer; the defaults were chosen by classes of music, not by single pieces.
struct BeatPointerConfig {
    double lowest_bpm = kSlowestTempo.bpm();   ///< slowest tempo
    double highest_bpm = kFastestTempo.bpm();  ///< fastest tempo
    int tempi = 86;                            ///< number of tempi, log-spaced between the two
    /// Share of beats of three parts in the prior. At a beat the number of parts changes with
    /// probability `parts_change`.
    double in_three = 0.25;
    double parts_change = 1e-3;  ///< see in_three
    /// A tempo change by ratio r at a beat has probability proportional to exp(-stiffness |r - 1|).
    double stiffness = 100.0;
    double trust = 0.7;           ///< exponent of a hop's onset strength when it is alone
    double trust_beside = 0.3;    ///< the same beside a network's evidence
    double network_trust = 0.22;  ///< exponent of the network's evidence
    /// Share of the prior that is mixed in each hop: so a new song is found within seconds.
    double leak = 1e-6;
    double centre_bpm = 120.0;  ///< middle of the log-normal tempo prior
    double octaves = 0.7;       ///< standard deviation of the tempo prior
    /// Tempo that the file itself tells; 0: none. Tempi that are easily taken for it (an octave,
    /// 3:2 or 4:3 away) become less likely; of all others, and of the tempo itself, nothing
    /// changes.
    double told_bpm = 0.0;
};

/// Hops in a beat of this tempo; its own inverse: tempo of a beat of that many hops.
constexpr double hops_of(double bpm) noexcept { return 60.0 * kHopsPerSecond / bpm; }

/// Likelihoods of a hop's evidence where a beat, its half, a third of it or none of these is:
/// probabilities over how often each is found, to the power of the trust, as neighbouring hops are
/// not independent.
struct EvidenceLikelihood {
    float other = 1.0F;
    float beat = 1.0F;
    float half = 1.0F;
    float third = 1.0F;
};
[[nodiscard]] EvidenceLikelihood likelihood_of(const BeatEvidence& evidence,
                                               double trust = BeatPointerConfig().network_trust);

/// 1 at an event, falling off over the hops around it: as wide as networks' evidence of one.
[[nodiscard]] float event_bump(double hops_away) noexcept;

/// State space of tempo x beat phase (Krebs, Boeck, Widmer 2015, "An efficient state space model
/// for joint tempo and meter tracking"). A state is one hop of a beat of one tempo: the phase moves
/// on by one state a hop, and the tempo may change at a beat only. Each tempo exists twice, with
/// beats of two parts and with beats of three, as in compound metres: or else the thirds of a
/// dotted beat would be taken for halves of a faster one. The likelihood of a hop is exp(trust x
/// onset strength x template), with a template of zero mean: 1 on the beat, 0.35 on the half and
/// 0.12 on the quarters, or 0.35 on the thirds; times what networks say of it.
///
/// Immutable but for expect_told(). Threads: any may read. Real-time: all but the constructor.
class PointerStates {
 public:
    /// States of one tempo; they follow those of the tempo before.
    struct Tempo {
        int first = 0;  ///< index of its first state, which is the beat
        int hops = 0;   ///< number of its states, one for each hop of a beat
        int parts = 2;  ///< of its beats, 2 or 3
        /// Index of the state at a position, 0 to hops - 1.
        [[nodiscard]] std::size_t state(int position) const noexcept {
            return static_cast<std::size_t>(first) + static_cast<std::size_t>(position);
        }
    };

    /// Lays out the states.
    explicit PointerStates(const BeatPointerConfig& config);

    /// Changes BeatPointerConfig::told_bpm, as another song tells another tempo. No call of another
    /// method may run meanwhile.
    void expect_told(double bpm) noexcept RAKS_NONBLOCKING;

    /// Those of two parts from the fastest to the slowest, then those of three.
    [[nodiscard]] std::span<const Tempo> tempi() const noexcept { return tempi_; }
    /// Probability of each state while nothing is known.
    [[nodiscard]] std::span<const float> prior() const noexcept { return prior_; }
    /// Number of states.
    [[nodiscard]] std::size_t size() const noexcept { return prior_.size(); }
    /// Probability of each tempo after a beat of tempo number `from`.
    [[nodiscard]] std::span<const float> transitions(std::size_t from) const noexcept {
        return std::span(transition_).subspan(from * tempi_.size(), tempi_.size());
    }
    /// Those of all tempi, one row after the other.
    [[nodiscard]] std::span<const float> transitions() const noexcept { return transition_; }
    /// Share of the prior that is mixed in each hop.
    [[nodiscard]] float leak() const noexcept { return static_cast<float>(config_.leak); }

    /// One hop's evidence: mixes a share of `prior` into `states`, then multiplies each by the
    /// likelihood of the onset strength.
    void weigh(std::span<float> states,
               std::span<const float> prior,
               float leak,
               float onset_strength) const noexcept RAKS_NONBLOCKING;
    /// The same with a network's evidence of the same hop.
    void weigh(std::span<float> states,
               std::span<const float> prior,
               float leak,
               float onset_strength,
               const BeatEvidence& evidence) const noexcept RAKS_NONBLOCKING;

 private:
    void add_tempo(int hops, int parts);
    void add_transitions(const Tempo& from);

    BeatPointerConfig config_;
    std::vector<Tempo> tempi_;
    std::vector<float> prior_;
    std::vector<float> template_;     // of onset strength, of every state
    std::vector<float> on_beat_;      // how near a state is to the beat: 1 on it
    std::vector<float> on_part_;      // the same for the middle between two beats, or its thirds
    std::size_t first_in_three_ = 0;  // the first state of beats of three parts
    // Tempo from x tempo to, row-major; and the same where no tempo is told.
    std::vector<float> transition_;
    std::vector<float> untold_transition_;
};

}  // namespace raks::audio
