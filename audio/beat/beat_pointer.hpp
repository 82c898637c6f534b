#pragma once

#include <vector>

#include "audio/beat/network/beat_network.hpp"
#include "audio/beat/pointer_states.hpp"
#include "base/realtime.hpp"

namespace raks::audio {

/// Most likely state of the pointer after a hop.
struct PointerEstimate {
    double period_hops = 50.0;  ///< hops (10 ms) a beat
    double phase = 0.0;         ///< position in the beat, [0, 1): 0 is the beat
    float mass = 0.0F;          ///< posterior probability around this period and phase, [0, 1]
};

/// Forward recursion over tempo x beat phase (Krebs, Boeck, Widmer 2015, "An efficient state space
/// model for joint tempo and meter tracking"). A state is one hop of a beat of one tempo: the phase
/// moves on by one state a hop, and the tempo may change at a beat only. The likelihood of a hop is
/// exp(trust x onset strength x template), with a template of zero mean: 1 on the beat, 0.35 on the
/// half, 0.12 on the quarters.
///
/// Cost: about 5,000 states, bounded and equal for every hop.
/// Threads: one. Real-time: all but the constructor.
class BeatPointer {
 public:
    /// Lays out the states and starts from the prior.
    explicit BeatPointer(const BeatPointerConfig& config = {});

    /// One hop with this onset strength.
    void advance(float onset_strength) noexcept RAKS_NONBLOCKING;
    /// One hop with onset strength and a network's evidence, both of the same hop.
    void advance(float onset_strength, const BeatEvidence& evidence) noexcept RAKS_NONBLOCKING;
    /// One hop without evidence: the states only move on.
    void advance_blind() noexcept RAKS_NONBLOCKING;

    /// Period, phase and mass of the most likely hypothesis.
    [[nodiscard]] PointerEstimate estimate() const noexcept RAKS_NONBLOCKING;

    /// Back to the default prior.
    void reset() noexcept RAKS_NONBLOCKING;
    /// Another song tells this tempo (BeatPointerConfig::told_bpm; 0: none). The present belief
    /// stays, and so does the prior in force until it is taken anew.
    void expect_told(double bpm) noexcept RAKS_NONBLOCKING { states_.expect_told(bpm); }
    /// Expects a tempo within some percent of this one and rules out those more than about a third
    /// away, until expect_any_tempo(). All phases become equally likely.
    void expect_tempo(double bpm) noexcept RAKS_NONBLOCKING;
    /// Puts nearly all probability on this tempo and `phase` [0, 1). The prior stays.
    void believe(double bpm, double phase) noexcept RAKS_NONBLOCKING;
    /// Finds no faster tempo than this from here on, until expect_any_tempo(); the present belief
    /// stays.
    void expect_below(double bpm) noexcept RAKS_NONBLOCKING;
    /// Makes tempi in this range likelier than others by a factor of 4 where a tempo is sought (at
    /// the start, in a new song); rules none out, and the present belief stays.
    void expect_range(double lowest_bpm, double highest_bpm) noexcept RAKS_NONBLOCKING;
    /// Takes the default prior again; the present belief stays.
    void expect_any_tempo() noexcept RAKS_NONBLOCKING;
    /// A beat is at this hop: concentrates the probability on phase 0, tempi as in the prior.
    void expect_beat() noexcept RAKS_NONBLOCKING;
    /// After a jump of the audio: tempi half as believed and half as in the prior, all phases
    /// equally likely.
    void open_positions() noexcept RAKS_NONBLOCKING;

 private:
    void move() noexcept;
    void normalize() noexcept;

    PointerStates states_;
    std::vector<float> prior_;        // the prior in force
    std::vector<float> probability_;  // of every state
    std::vector<float> moved_;        // work space
    std::vector<float> leavings_;     // probability that a beat of each tempo ends now
    std::vector<float> arrivals_;     // and that one of each begins
};

}  // namespace raks::audio
