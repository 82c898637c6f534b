#pragma once

#include <array>
#include <cstdint>
#include <memory>
#include <optional>
#include <utility>

#include "audio/beat/analyzer_command.hpp"
#include "audio/beat/bar_belief.hpp"
#include "audio/beat/beat_confidence.hpp"
#include "audio/beat/beat_pointer.hpp"
#include "audio/beat/network/bar_network.hpp"
#include "audio/beat/network/beat_network.hpp"
#include "audio/beat/pulse_belief.hpp"
#include "audio/beat/rival_pulses.hpp"
#include "audio/beat/tap_tempo.hpp"
#include "base/beat_grid.hpp"
#include "base/music_state.hpp"
#include "base/realtime.hpp"
#include "base/timed_commands.hpp"

namespace raks::audio {

/// What the tracker is given of one hop.
struct TrackedHop {
    HopIndex hop = 0;             ///< number of the hop
    StreamTime audio_end{};       ///< end of the audio that the hop was computed from
    float onset_strength = 0.0F;  ///< Onset::strength of the hop
    /// The hop's mel magnitudes (OnsetDetector::kMelBands of them; none: changes of the sound are
    /// not evaluated). Used during advance() only.
    std::span<const float> mel_magnitudes;
    bool has_evidence = false;  ///< whether `evidence` comes from a network
    int evidence_lag = 0;       ///< hops by which the evidence is late
    BeatEvidence evidence;      ///< of all networks, about the hop `evidence_lag` hops ago
    BeatEvidence own_evidence;  ///< likewise, of our own: what the network for bars learnt from
    int quiet_hops = 0;         ///< hops in a row, up to this one, too soft to hold a beat
    bool is_silent = false;     ///< silence: the tempo runs on, confidence falls
};

/// Makes a steady beat grid of the pointer's estimates: a second-order filter follows the estimated
/// phase without its steps of 10 ms, beats are announced when they are due and never revised, and
/// the confidence tells whether there is a beat at all.
///
/// Threads: one. Real-time: yes.
class BeatTracker {
 public:
    /// Call reset() before the first hop if a network was set.
    BeatTracker() = default;

    /// From the next reset() on: its networks for bars and for the metre, and how sure beats are.
    /// Null, or without such a network: bars follow from downbeats and changes of the sound alone,
    /// and the pointer alone decides on the metre. Real-time: no.
    void set_network(const BeatNetwork* network);

    /// Sets the dances that hint_genre refers to, for their tempi; null: hints have no effect.
    /// Real-time: no.
    void expect_dances(std::shared_ptr<const DanceList> dances) { dances_ = std::move(dances); }

    /// Sets the tempo that is told of the music (BeatPointerConfig::told_bpm); 0: none. The present
    /// belief stays.
    void expect_told(double bpm) noexcept RAKS_NONBLOCKING;

    /// One hop; sets grid, beat and predicted of `state`.
    void advance(const TrackedHop& hop, MusicState& state) noexcept RAKS_NONBLOCKING;

    /// Of the present beat: what its confidence follows from.
    [[nodiscard]] ConfidenceFeatures features() const noexcept {
        return confidence_features(
            margins_, pulses_.right(), 60.0 * kHopsPerSecond * beats_per_hop_, on_beats_);
    }

    /// One hop inside a gap of the audio: sets the grid, which runs on.
    void advance_blind(HopIndex hop, MusicState& state) noexcept RAKS_NONBLOCKING;

    /// The audio continues elsewhere: seeks the beat anew, with the tempo as a first guess.
    void jump() noexcept RAKS_NONBLOCKING;

    /// Another song begins now: what the music has said is forgotten. What a person said stays:
    /// commands, a held tempo, a nudge. Beats are numbered on.
    void begin_song() noexcept RAKS_NONBLOCKING;

    /// Queues a command for its time, or for the next hop when that has passed. False: 16 are
    /// waiting.
    bool command(const AnalyzerCommand& command) noexcept RAKS_NONBLOCKING;

    /// Forgets music and commands, held tempo and hint included.
    void reset() noexcept RAKS_NONBLOCKING;

 private:
    static constexpr std::size_t kRecent = 64;  // hops of evidence that are kept

    // Evidence of one recent hop.
    struct HopEvidence {
        float strength = 0.0F;
        BeatEvidence evidence;
        float own_beat = 0.0F;  // of our own networks
    };

    void run_commands(StreamTime now) noexcept;
    void apply(const AnalyzerCommand& command, StreamTime now) noexcept;
    void change_tempo(double bpm) noexcept;
    void release_tempo() noexcept;
    void expect_hinted() noexcept;
    void change_octave(double factor) noexcept;
    void take_three_two() noexcept;
    void take_pulse(const RivalPulse& rival) noexcept;
    void set_position(double phase) noexcept;
    void track_tempo(const TrackedHop& hop) noexcept;
    void begin_tempo() noexcept;
    void keep_tempo(double moved) noexcept;
    void run_alone() noexcept;
    void follow(const PointerEstimate& estimate, int lag_hops) noexcept;
    void weigh_rivals(const TrackedHop& hop) noexcept;
    void track_bars(const TrackedHop& hop) noexcept;
    void forget_bars() noexcept;
    void listen_for_start(const TrackedHop& hop) noexcept;
    void place_start() noexcept;
    void track_pulses(const TrackedHop& hop) noexcept;
    void forget_pulses() noexcept;
    [[nodiscard]] BeatEvidence as_believed(const BeatEvidence& evidence, int lag) const noexcept;
    void rate_beat(const TrackedHop& hop) noexcept;
    void rate_confidence(const TrackedHop& hop) noexcept;
    void publish(HopIndex hop, MusicState& state) const noexcept;
    void announce(const TrackedHop& hop, MusicState& state) noexcept;
    [[nodiscard]] HopEvidence& evidence_at(HopIndex hop) noexcept;

    BeatPointer pointer_;
    BarBelief bars_;
    TapTempo taps_;

    // The grid at the current hop.
    double position_ = 0.0;            // beats
    double beats_per_hop_ = 1.0 / 50;  // tempo; 120 BPM at first
    double nudge_hops_ = 0.0;          // the user's shift of the beats; positive: later
    bool is_tempo_held_ = false;
    bool are_beats_set_ = false;    // by somebody who knows them: the music moves them no more
    bool is_tempo_told_ = false;    // by the file, or by who plays it
    bool is_tempo_chosen_ = false;  // by the user, who knows the metre
    std::shared_ptr<const DanceList> dances_;
    DanceId hint_ = DanceId::none;     // dance of the last hint_genre
    double steady_rate_ = 1.0 / 50;    // mean beats a hop over the last beats, corrections included
    double steady_beats_ = 1.0;        // number of beats in that mean
    double followed_rate_ = 1.0 / 50;  // steady_rate_ at the last hop with evidence of a beat
    double drift_ = 0.0;          // beats that the grid moved more than followed_rate_ since then
    int hops_without_ = 0;        // hops since the network last had evidence of a beat
    int hops_apart_ = 0;          // hops in a row in which estimate and grid differed too much
    int hops_with_evidence_ = 0;  // hops with evidence since reset or jump

    // Bar evidence of the current beat, used when the next one begins.
    BeatChange changes_;
    BarInput bar_input_;
    std::optional<BarNetworkStream> bar_stream_;
    long sounding_beat_ = 0;                   // number of the current beat
    float change_ = 0.0F;                      // of the sound, at the beat before
    std::optional<BarEvidence> bar_evidence_;  // of the beat before

    // Where the song began, as somebody said that it begins.
    HopIndex hop_ = 0;               // the newest
    HopIndex quiet_hop_ = -1'000;    // the newest that was too soft for a beat
    HopIndex start_until_ = 0;       // its first sound comes before this hop
    std::optional<HopIndex> start_;  // hop of its first sound behind quiet
    bool owes_start_ = false;        // the bars are not told yet

    // The metre.
    PulseInput pulse_input_;
    std::optional<PulseNetworkStream> pulse_stream_;
    PulseBelief pulses_;
    long pulse_beat_ = 0;  // number of the beat whose sound is collected

    // Confidence.
    std::array<HopEvidence, kRecent> recent_{};  // ring, by hop
    long rated_beat_ = 0;                        // number of the last rated beat
    int beats_rated_ = 0;                        // at most 8
    float contrast_ = 0.0F;                      // evidence on the beats, running mean
    float mass_ = 0.0F;                          // PointerEstimate::mass, smoothed
    float on_beats_ = 0.0F;                      // contrast_ as a share of full evidence
    PulseMargins margins_;                       // of the grid over its rivals
    ConfidenceModel confidence_model_;
    BeatVerdict verdict_;  // what they say
    float confidence_ = 0.0F;

    // Announcements.
    long next_beat_ = 0;       // number of the next beat to announce
    long next_predicted_ = 0;  // and of the next to predict
    StreamTime last_beat_time_{std::chrono::seconds(-10)};
    StreamTime last_predicted_time_{std::chrono::seconds(-10)};

    TimedCommands<AnalyzerCommand, 16> commands_;
};

}  // namespace raks::audio
