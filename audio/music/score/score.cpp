#include "audio/music/score/score.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <span>

#include "audio/music/score/metre_variations.hpp"

namespace raks::audio {
namespace {

/// Seconds of each beat from the first on, and of the end: one more than `beats`. The tempo is
/// steady, drifts, has rubato, a ramp or one step, as drawn.
std::vector<double> beat_times(const Score& score, int beats, double bpm, Dice& dice) {
    const bool is_expressive = score.is_expressive;
    const bool is_steady = score.is_programmed && dice.chance(0.8);
    const double kind = is_steady ? 0.0 : is_expressive ? dice.uniform(0.5, 1.0) : dice.uniform();
    std::vector<double> times{0.0};
    // Deviations of the logarithm of the period: drift is slow, rubato and wander are fast.
    const double drift = kind < 0.35 ? 0.0 : dice.uniform(0.004, 0.02);
    const double rubato = kind > 0.75 && kind < 0.85 ? dice.uniform(0.02, 0.06) : 0.0;
    const double wander = is_expressive ? dice.uniform(0.02, 0.12) : rubato;
    const double ramp =
        kind >= 0.85 && kind < 0.93 ? dice.uniform(-0.02, 0.02) : 0.0;  // per second
    const bool has_step = kind >= 0.93 && !is_expressive;
    const int step_beat = dice.whole(beats / 4, std::max(beats / 4, 3 * beats / 4));
    // A step changes the period once, by a factor of 0.7 to 1.4, in the middle half of the piece.
    const double step_ratio = std::exp(dice.uniform(-0.35, 0.35));
    // In free tempo the last two beats of a phrase are lengthened.
    const int phrase = dice.pick({8, 12, 16, 16, 24, 32});
    const double wait = is_expressive ? dice.uniform(0.0, 0.25) : 0.0;
    // 48 to 231 BPM, whatever was drawn, but for scores that are slower or faster.
    const double shortest = score.highest_bpm > 231.0 ? 50.0 / score.highest_bpm : 0.26;
    const double longest = score.lowest_bpm < 48.0 ? 63.0 / score.lowest_bpm : 1.25;
    double log_drift = 0.0;
    double log_wander = 0.0;
    for (int beat = 0; beat < beats; ++beat) {
        // Autoregressive noise: 0.97 remembers for tens of beats, 0.8 for a few.
        log_drift = 0.97 * log_drift + dice.normal(0.25 * drift);
        log_wander = 0.8 * log_wander + dice.normal(0.6 * wander);
        double period = 60.0 / bpm * std::exp(log_drift + log_wander - ramp * times.back());
        if (has_step && beat >= step_beat) {
            period *= step_ratio;
        }
        if (beat % phrase >= phrase - 2) {
            period *= 1.0 + wait * (beat % phrase == phrase - 1 ? 1.0 : 0.5) * dice.uniform();
        }
        times.push_back(times.back() + std::clamp(period, shortest, longest));
    }
    return times;
}

/// Seconds of a fractional beat, interpolated between beats and continued behind the last.
double time_at(const std::vector<double>& times, double beat) {
    const double last = static_cast<double>(times.size()) - 1.0;
    const double clamped = std::clamp(beat, 0.0, last - 1e-9);
    const auto whole = static_cast<std::size_t>(clamped);
    return times[whole] + (beat - static_cast<double>(whole)) * (times[whole + 1] - times[whole]);
}

std::size_t index_of(int beat) { return static_cast<std::size_t>(beat); }

/// The beats of the score from `first` on, each `start` seconds later than in `times`.
std::vector<PlayedBeat> beats_until(double seconds,
                                    std::span<const double> times,
                                    double start,
                                    const Score& score,
                                    std::size_t first) {
    std::vector<PlayedBeat> beats;
    const int parts = score.beat_parts.empty() ? parts_of(score) : 2;
    for (std::size_t i = 0; i + 1 < times.size() && start + times[i] < seconds; ++i) {
        const std::size_t beat = first + i;
        if (score.bar_position[beat] != Score::kNoBeat) {
            beats.push_back({start + times[i],
                             score.bar_position[beat],
                             score.beat_parts.empty() ? parts : score.beat_parts[beat]});
        }
    }
    return beats;
}

/// How one instrument (channel, and key for drums) plays in this piece.
struct Player {
    double late = 0.0;
    double level = 1.0;
    bool is_missing = false;
};

/// Draws an instrument's constant lateness, its level, and whether it is missing.
Player draw_player(const Score& score, bool leaves_out, Dice& dice) {
    return {dice.normal(score.is_programmed ? 0.0 : 0.004),
            std::exp(dice.normal(0.2)),
            leaves_out && score.has_drums && dice.chance(0.12)};
}

/// Standard deviation, in seconds, of notes around their places.
double draw_jitter(const Score& score, Dice& dice) {
    if (score.is_programmed) {
        return 0.0;
    }
    return dice.log_uniform(0.001, score.is_expressive ? 0.020 : 0.010);
}

}  // namespace

Performance perform(const Score& score, double seconds, Dice& dice) {
    const double bpm = dice.log_uniform(score.lowest_bpm, score.highest_bpm);
    const int all = static_cast<int>(score.bar_position.size());
    const int wanted = std::min(all, static_cast<int>(seconds * bpm / 60.0) + 8);
    // A random place of the score, so that pieces do not all begin alike.
    const int first = all > wanted ? dice.whole(0, all - wanted) : 0;
    const std::vector<double> times = beat_times(score, wanted, bpm, dice);
    const double jitter = draw_jitter(score, dice);
    const double drop = dice.uniform(0.0, 0.06);
    const double ghosts = dice.uniform(0.0, 0.06);
    const bool leaves_out = dice.chance(0.5) && !score.is_complete;
    const double start = dice.uniform(0.0, 0.6);  // silence before the first beat

    // In some pieces there is a break: the drums pause for a while, or all players but one.
    const bool has_break = score.has_drums && dice.chance(0.35) && !score.is_complete;
    const bool is_solo = dice.chance(0.3);
    const double break_from = dice.uniform(8.0, std::max(9.0, wanted - 12.0));
    const double break_to = break_from + dice.uniform(4.0, 17.0);

    std::map<int, Player> players;
    int soloist = -1;
    Performance played;
    for (const ScoreNote& note : score.notes) {
        const double beat = note.beat - first;
        // A note up to 0.06 beats early belongs to the beat that it leads to: so that of the first
        // beat is kept, and that of the beat after the last is not.
        if (beat < -0.06 || beat > wanted - 0.06) {
            continue;
        }
        // Each drum is a player of its own; other channels are one player each.
        const int group = note.channel == kDrumChannel ? 100 + note.key : note.channel;
        // Players are drawn when their first note is met.
        const auto [found, is_new] = players.try_emplace(group);
        Player& player = found->second;
        if (is_new) {
            player = draw_player(score, leaves_out, dice);
        }
        // The soloist is whoever plays first after beat 4.
        soloist = soloist < 0 && is_solo && beat > 4.0 ? group : soloist;
        const bool is_in_break = has_break && beat > break_from && beat < break_to;
        const bool pauses = is_in_break && (is_solo ? group != soloist : group >= 100);
        if (player.is_missing || pauses || dice.chance(drop)) {
            continue;
        }
        const double exact = start + time_at(times, std::max(beat, 0.0));
        // Lateness is the player's own in the whole piece; jitter is drawn for each note.
        const double off = player.late + dice.normal(jitter);
        const double end = start + time_at(times, std::max(beat, 0.0) + note.length);
        const double velocity = note.velocity * player.level + dice.normal(7.0);
        PlayedNote sounding{std::max(0.0, exact + off),
                            std::max(0.05, end - exact),
                            note.channel,
                            std::clamp(note.key, 0, 127),
                            note.program,
                            std::clamp(static_cast<int>(std::lround(velocity)), 8, 127),
                            note.cents};
        played.notes.push_back(sounding);
        // Ghost notes: the same drum again, soft, a fraction of a beat later.
        if (note.channel == kDrumChannel && dice.chance(ghosts)) {
            sounding.time += dice.pick({0.25, 0.5, 0.125}) * 60.0 / bpm;
            sounding.velocity = std::max(8, sounding.velocity / 3);
            played.notes.push_back(sounding);
        }
    }
    std::stable_sort(played.notes.begin(),
                     played.notes.end(),
                     [](const PlayedNote& a, const PlayedNote& b) { return a.time < b.time; });
    played.beats = beats_until(seconds, times, start, score, index_of(first));
    played.seconds = std::min(seconds, start + times.back());
    return played;
}

}  // namespace raks::audio
