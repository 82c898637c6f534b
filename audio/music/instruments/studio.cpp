#include "audio/music/instruments/studio.hpp"

#include <algorithm>
#include <cmath>
#include <map>
#include <numbers>
#include <set>

namespace raks::audio {
namespace {

/// Groups of instruments that pause and echo together.
enum class Part : char { bass_drum, snare, other_drums, bass, chords, lead };

/// Channels are those of add_band: 0 bass, 1 chords. Keys up to 36 are bass drums; up to 40,
/// snares, sticks and claps.
Part part_of(const ScoreNote& note) {
    if (note.channel != kDrumChannel) {
        return note.channel == 0 ? Part::bass : note.channel == 1 ? Part::chords : Part::lead;
    }
    return note.key <= 36 ? Part::bass_drum : note.key <= 40 ? Part::snare : Part::other_drums;
}

/// General MIDI's electronic kits, synthetic basses, leads and pads.
void choose_sounds(Score& score, Dice& dice) {
    // What is listed more often is drawn more often; 24 and 25 are the electronic kits.
    const int kit = dice.pick({24, 24, 25, 25, 0, 16});
    const std::map<Part, int> programs = {
        {Part::bass, dice.pick({38, 39, 38, 39, 87, 33})},
        {Part::chords, dice.pick({80, 81, 81, 87, 90, 62, 63, 50, 4, 5, 89, 94})},
        {Part::lead, dice.pick({80, 81, 82, 84, 87, 98, 99, 62, 11, 4})}};
    for (ScoreNote& note : score.notes) {
        const auto found = programs.find(part_of(note));
        note.program = found == programs.end() ? kit : found->second;
    }
}

/// Echoes of a delay line for the short notes of one part; long ones would blur.
void add_echoes(Part part, Score& score, Dice& dice) {
    constexpr double kSoftest = 25.0;
    constexpr double kLongest = 0.6;  // beats
    const double delay = dice.pick({0.75, 0.75, 0.5, 0.375, 1.0});
    // Each echo is softer by this factor, down to a velocity that no longer matters.
    const double feedback = dice.uniform(0.55, 0.85);
    // The echoes are appended behind: they have no echoes of their own.
    const std::size_t played = score.notes.size();
    for (std::size_t i = 0; i < played; ++i) {
        ScoreNote note = score.notes[i];
        if (part_of(note) != part || note.length > kLongest) {
            continue;
        }
        for (note.velocity *= feedback; note.velocity > kSoftest; note.velocity *= feedback) {
            note.beat += delay;
            score.notes.push_back(note);
        }
    }
}

/// In each phrase some parts are silent, but never all: one that has at least half the notes of the
/// busiest part carries the phrase.
void add_pauses(Score& score, Dice& dice) {
    // Beats.
    const double length = dice.pick({8.0, 8.0, 16.0, 16.0, 32.0});
    const double silent = dice.uniform(0.15, 0.45);
    const auto phrase_of = [length](const ScoreNote& note) {
        return static_cast<int>(note.beat / length);
    };
    std::map<int, std::map<Part, int>> phrases;
    for (const ScoreNote& note : score.notes) {
        ++phrases[phrase_of(note)][part_of(note)];
    }
    std::set<std::pair<int, Part>> pauses;
    for (const auto& [phrase, parts] : phrases) {
        int most = 0;
        for (const auto& [part, notes] : parts) {
            most = std::max(most, notes);
        }
        std::vector<Part> carriers;
        for (const auto& [part, notes] : parts) {
            if (2 * notes >= most) {
                carriers.push_back(part);
            }
        }
        const Part carrier = dice.pick<Part>(carriers);
        for (const auto& [part, notes] : parts) {
            if (part != carrier && dice.chance(silent)) {
                pauses.insert({phrase, part});
            }
        }
    }
    std::erase_if(score.notes, [&](const ScoreNote& note) {
        return pauses.contains({phrase_of(note), part_of(note)});
    });
}

/// A low-pass of 12 dB an octave whose corner goes up and down.
void sweep(int sample_rate, std::vector<float>& samples, Dice& dice) {
    constexpr std::size_t kHop = 64;  // samples between updates of the corner
    const double middle = std::log(dice.log_uniform(700.0, 4000.0));
    const double octaves = dice.uniform(0.5, 2.5) * std::numbers::ln2;
    // One sweep takes 6 to 50 s.
    const double turn = 2.0 * std::numbers::pi / (dice.log_uniform(6.0, 50.0) * sample_rate);
    const double start = dice.uniform(0.0, 2.0 * std::numbers::pi);
    double share = 0.0;
    double first = 0.0;
    double second = 0.0;
    for (std::size_t i = 0; i < samples.size(); ++i) {
        if (i % kHop == 0) {
            const double corner =
                std::exp(middle + octaves * std::sin(start + turn * static_cast<double>(i)));
            // The coefficient of a one-pole low-pass with this corner; two in a row make 12 dB an
            // octave.
            share = 1.0 - std::exp(-2.0 * std::numbers::pi * corner / sample_rate);
        }
        first += share * (static_cast<double>(samples[i]) - first);
        second += share * (first - second);
        samples[i] = static_cast<float>(second);
    }
}

}  // namespace

void give_to_machines(Score& score, Dice& dice) {
    score.is_programmed = true;
    if (dice.chance(0.8)) {
        choose_sounds(score, dice);
    }
    if (dice.chance(0.35)) {
        add_echoes(Part::chords, score, dice);
    }
    if (dice.chance(0.25)) {
        add_echoes(Part::lead, score, dice);
    }
    if (dice.chance(0.1)) {
        add_echoes(Part::snare, score, dice);
    }
    if (dice.chance(0.5)) {
        add_pauses(score, dice);
    }
}

void pump(std::span<const double> drums,
          double depth,
          double release,
          int sample_rate,
          std::vector<float>& samples) {
    constexpr double kAttack = 0.015;  // seconds: the drum itself gets through
    // Share of the dip that is left `since` seconds after a drum.
    const auto recovering = [release](double since) {
        return std::max(0.0, 1.0 - (since - kAttack) / release);
    };
    auto next = drums.begin();
    double last = -10.0;
    double before = -10.0;
    for (std::size_t i = 0; i < samples.size(); ++i) {
        const double now = static_cast<double>(i) / sample_rate;
        for (; next != drums.end() && *next <= now; ++next) {
            before = last;
            last = *next;
        }
        const double since = now - last;
        // During the attack the dip grows, but does not fall below what the drum before has left.
        const double held = since < kAttack ? std::max(since / kAttack, recovering(now - before))
                                            : recovering(since);
        samples[i] *= static_cast<float>(1.0 - depth * held);
    }
}

void produce(const Performance& played, int sample_rate, std::vector<float>& samples, Dice& dice) {
    if (dice.chance(0.2)) {
        sweep(sample_rate, samples, dice);
    }
    if (dice.chance(0.4)) {
        std::vector<double> drums;
        for (const PlayedNote& note : played.notes) {
            if (note.channel == kDrumChannel && note.key <= 36) {
                drums.push_back(note.time);
            }
        }
        pump(drums, dice.uniform(0.3, 0.9), dice.uniform(0.1, 0.4), sample_rate, samples);
    }
}

}  // namespace raks::audio
