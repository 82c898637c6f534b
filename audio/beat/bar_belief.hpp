#pragma once

#include <array>
#include <cstddef>
#include <span>

#include "audio/beat/network/bar_network.hpp"
#include "audio/features/onset.hpp"
#include "base/realtime.hpp"

namespace raks::audio {

/// How much the sound changes at a beat: the mean spectrum of the beat's time against that of the
/// beat before. Harmony and bass line change where bars begin; a network on onsets often gives
/// beats 1 and 3 the same evidence. (Davies, Plumbley 2006, "A spectral difference approach to
/// downbeat extraction in musical audio"; here on mel bands, compressed, each relative to its own
/// level.)
///
/// Threads: one. Real-time: yes.
class BeatChange {
 public:
    /// Starts without any beat.
    BeatChange() noexcept { reset(); }

    /// Adds a hop's mel magnitudes to the current beat.
    void add(std::span<const float, OnsetDetector::kMelBands> magnitudes) noexcept RAKS_NONBLOCKING;

    /// Ends the current beat and starts the next. Returns how much the sound changed at the start
    /// of the ended beat, in standard deviations from the mean over the last beats, [-3, 3]; 0 in
    /// the first beats.
    float next_beat() noexcept RAKS_NONBLOCKING;

    /// Forgets all beats.
    void reset() noexcept RAKS_NONBLOCKING;

 private:
    using Bands = std::array<float, OnsetDetector::kMelBands>;

    Bands sum_{};            // magnitudes of the current beat
    int hops_ = 0;           // hops of the current beat
    Bands level_{};          // running mean of the beats, by band
    Bands before_{};         // compressed magnitudes of the last whole beat
    int beats_ = 0;          // whole beats so far
    float mean_ = 0.0F;      // of the change
    float variance_ = 0.0F;  // of the change
};

/// Bars as a Markov chain over metre x position: what both the running belief and the search over a
/// whole song assume.
struct BarModel {
    static constexpr std::array kMetres = {2, 3, 4, 5, 6, 7};  ///< beats a bar
    static constexpr float kMetreChange = 0.02F;               ///< probability a bar
    /// Share of the prior that is mixed in each beat: the bar may be counted wrong.
    static constexpr float kLeak = 0.003F;
    /// Probability of a metre while nothing is known.
    [[nodiscard]] static constexpr float prior_of(int beats_per_bar) noexcept {
        switch (beats_per_bar) {
            case 2:
                return 0.16F;
            case 3:
                return 0.2F;
            case 4:
                return 0.58F;
            case 5:
                return 0.03F;
            case 6:
                return 0.02F;
            default:
                return 0.01F;
        }
    }
};

/// Likelihoods of what is known of a beat, up to a common factor: at the first beat of a bar, in
/// the middle of a bar of 4 or 6, and at all other places.
struct BarLikelihood {
    float first = 1.0F;   ///< at position 0
    float middle = 1.0F;  ///< at half of a bar of 4 or 6
    float other = 1.0F;   ///< elsewhere

    /// Of a network's or the pointer's probability, [0, 1], that the beat is a downbeat. The middle
    /// of a bar may have the evidence of a downbeat, too, so that such bars are not mistaken for
    /// two short ones.
    [[nodiscard]] static BarLikelihood of_downbeat(float probability) noexcept;
    /// Of how much the sound changed at the beat, in standard deviations, see BeatChange.
    [[nodiscard]] static BarLikelihood of_change(float deviations) noexcept;
    /// Of a network's probabilities of the beat's place in its bar.
    [[nodiscard]] static BarLikelihood of_bar(const BarEvidence& evidence) noexcept;

    /// At a position of a bar of this many beats.
    [[nodiscard]] float of(int beats_per_bar, int position) const noexcept {
        const bool has_middle = beats_per_bar == 4 || beats_per_bar == 6;
        return position == 0 ? first : has_middle && position == beats_per_bar / 2 ? middle : other;
    }
    /// Both are known of the same beat.
    BarLikelihood& operator*=(const BarLikelihood& more) noexcept {
        first *= more.first;
        middle *= more.middle;
        other *= more.other;
        return *this;
    }
};

/// Estimates the bar position of each beat and the number of beats a bar: a forward recursion over
/// metre x position, one step a beat. Its evidence: the probability of a downbeat, the change of
/// the sound at the beat, and a network's bar evidence. The metre may change at a downbeat.
///
/// Threads: one. Real-time: yes.
class BarBelief {
 public:
    /// Starts from the prior of metres.
    BarBelief() noexcept { reset(); }

    /// Moves on to beat `number`, of which nothing is known yet. Numbers count up by one; where one
    /// is skipped, the bar position moves along.
    void next_beat(long number) noexcept RAKS_NONBLOCKING;

    /// Evidence: the last beat was a downbeat with this probability, [0, 1]. The middle of a bar of
    /// 4 or 6 may have the evidence of a downbeat, too, so such bars are not mistaken for two short
    /// ones.
    void observe_downbeat(float probability) noexcept RAKS_NONBLOCKING;

    /// Evidence: how much the sound changed at the last beat, in standard deviations, see
    /// BeatChange.
    void observe_change(float deviations) noexcept RAKS_NONBLOCKING;

    /// Evidence: a network's probabilities of the last beat's place in its bar.
    void observe_bar(const BarEvidence& evidence) noexcept RAKS_NONBLOCKING;

    /// Evidence: the song has begun with beat `number`, which then is a downbeat, most likely.
    void observe_start(long number) noexcept RAKS_NONBLOCKING;

    /// The user sets beat `number` as a downbeat: held until reset().
    void hold(long number) noexcept RAKS_NONBLOCKING;

    /// The beats have other numbers from here on (half or double tempo); beat `origin` is a
    /// downbeat of the same bars. The probabilities start anew.
    void recount(long origin) noexcept RAKS_NONBLOCKING;

    /// Most likely metre: one of BarModel::kMetres.
    [[nodiscard]] int beats_per_bar() const noexcept { return beats_per_bar_; }
    /// A beat number that is a downbeat.
    [[nodiscard]] long origin() const noexcept { return origin_; }
    /// Posterior probability of the published metre and position; 1 when held by the user.
    [[nodiscard]] float confidence() const noexcept { return confidence_; }

    /// Back to the prior; releases hold().
    void reset() noexcept RAKS_NONBLOCKING;

 private:
    static constexpr auto kMetres = BarModel::kMetres;
    static constexpr std::size_t kLongest = 7;
    using Positions = std::array<float, kLongest>;  // probability by bar position

    void step() noexcept;
    void weigh(const BarLikelihood& likelihood) noexcept;
    void normalize() noexcept;
    void tell() noexcept;

    std::array<Positions, kMetres.size()> probability_{};  // by metre
    long number_ = 0;                                      // of the last beat
    bool has_beat_ = false;
    bool is_held_ = false;   // by the user
    int beats_per_bar_ = 4;  // published
    long origin_ = 0;        // published: number of a downbeat
    float confidence_ = 0.0F;
};

}  // namespace raks::audio
