#pragma once

#include <vector>

#include "audio/beat/analyzer_command.hpp"
#include "audio/beat/network/beat_network.hpp"
#include "base/realtime.hpp"

namespace raks::audio {

/// Options of the pointer; each default was chosen on classes of music, not on pieces.
struct BeatPointerConfig {
    double lowest_bpm = kSlowestTempo.bpm();
    double highest_bpm = kFastestTempo.bpm();
    int tempi = 76;             ///< log-spaced between the two
    double stiffness = 100.0;   ///< a beat's tempo change by ratio r costs exp(-stiffness |r - 1|)
    double trust = 0.7;         ///< exponent of one hop's onset strength, alone
    double trust_beside = 0.3;  ///< the same beside a network's evidence
    double network_trust = 0.22;  ///< exponent of the network's evidence
    double leak = 1e-6;           ///< share of the prior that flows back in every hop: a new song
                                  ///< is found within seconds
    double centre_bpm = 120.0;    ///< of the tempo prior, which acts at the start and by the leak
    double octaves = 0.7;         ///< its width
};

/// What the pointer believes after a hop.
struct PointerEstimate {
    double period_hops = 50.0;  ///< hops (10 ms) a beat
    double phase = 0.0;         ///< position in the beat, [0, 1): 0 is the beat
    float mass = 0.0F;          ///< posterior probability near this period and phase, [0, 1]
};

/// Forward recursion over tempo x position in the beat (Krebs, Boeck, Widmer 2015, "An efficient
/// state space model for joint tempo and meter tracking"): positions move on by one a hop, the
/// tempo may change at the beat alone, and a hop's evidence is exp(trust x onset strength x
/// template), with a template of zero mean: 1 on the beat, 0.35 on the half, 0.12 on the quarters.
///
/// Cost: about 5,000 states, bounded and equal for every hop.
/// Threads: one. Real-time: all but the constructor.
class BeatPointer {
 public:
    explicit BeatPointer(const BeatPointerConfig& config = {});

    /// One hop with this onset strength.
    void advance(float onset_strength) noexcept RAKS_NONBLOCKING;
    /// One hop with what the network says, too.
    void advance(float onset_strength, const BeatEvidence& evidence) noexcept RAKS_NONBLOCKING;
    /// One hop of which nothing is known.
    void advance_blind() noexcept RAKS_NONBLOCKING;

    [[nodiscard]] PointerEstimate estimate() const noexcept RAKS_NONBLOCKING;

    /// Back to the prior.
    void reset() noexcept RAKS_NONBLOCKING;
    /// A tempo within some percent of this one is expected, none beyond a third more or less, until
    /// expect_any_tempo(); all positions are open.
    void expect_tempo(double bpm) noexcept RAKS_NONBLOCKING;
    /// A beat of this tempo stands at `phase` [0, 1) now: all else is nearly ruled out. What is
    /// expected of other songs stays.
    void believe(double bpm, double phase) noexcept RAKS_NONBLOCKING;
    /// No faster tempi than this are found anew, until expect_any_tempo().
    void expect_below(double bpm) noexcept RAKS_NONBLOCKING;
    /// Tempi between the two are likelier than others by a factor of 4, where a tempo is sought (at
    /// the start, in a new song); none is ruled out, and what is believed now stays.
    void expect_range(double lowest_bpm, double highest_bpm) noexcept RAKS_NONBLOCKING;
    /// The default prior again; what is believed now stays.
    void expect_any_tempo() noexcept RAKS_NONBLOCKING;
    /// A beat is known to be now; its tempo as expected.
    void expect_beat() noexcept RAKS_NONBLOCKING;
    /// The audio jumped: tempi as believed, half forgotten; all positions are open.
    void open_positions() noexcept RAKS_NONBLOCKING;

 private:
    struct Tempo {
        int first = 0;  // index of its first state
        int hops = 0;   // a beat: its number of states
        [[nodiscard]] std::size_t state(int position) const noexcept {
            return static_cast<std::size_t>(first) + static_cast<std::size_t>(position);
        }
    };
    void move() noexcept;
    void move_and_weigh(float flux) noexcept;
    void normalize() noexcept;

    BeatPointerConfig config_;
    std::vector<Tempo> tempi_;
    std::vector<float> default_prior_;  // of every state
    std::vector<float> prior_;          // as expected now
    std::vector<float> template_;       // of onset strength, of every state
    std::vector<float> on_beat_;        // how much a state is a beat's: 1 on it
    std::vector<float> on_half_;        // the same half way to the next
    std::vector<float> transition_;     // tempo from x tempo to, row-major
    std::vector<float> probability_;    // of every state
    std::vector<float> moved_;          // work space
    std::vector<float> arrivals_;       // probability that a beat of each tempo ends now
};

}  // namespace raks::audio
