#include <array>

#include "audio/music/generator/notes.hpp"
#include "base/random.hpp"

namespace raks::audio {
namespace {

// The mode hijaz: 1, flat 2, 3, 4, 5, flat 6, flat 7, in semitones above the tonic.
constexpr std::array<int, 7> kHijaz{0, 1, 4, 5, 7, 8, 10};

// MIDI number of a degree (0 = tonic); degrees below 0 and above 6 are in other octaves.
int hijaz_pitch(int tonic, int degree) {
    const int octave = degree >= 0 ? degree / 7 : -((6 - degree) / 7);
    return tonic + 12 * octave + kHijaz[static_cast<std::size_t>(degree - 7 * octave)];
}

// Darbuka: D T - T D - T - in eighths, with ka between the strokes from bar 4 on; riq from bar 2.
void write_rhythm(Notes& score, double start, int bar) {
    strike(score, Sound::darbuka_dum, "X.......X.......", start, 0.25);
    strike(score, Sound::darbuka_tek, "..X...X.....X...", start, 0.25, 0.9);
    if (bar >= 4) {
        strike(score,
               Sound::darbuka_ka,
               bar % 4 == 3 ? ".....o.o..o.ooxo" : ".....o.o..o...oo",
               start,
               0.25);
    }
    if (bar >= 2) {
        strike(score, Sound::riq, "xooo", start, 1.0);
        strike(score, Sound::riq, "o.o.o.o.", start + 0.5, 0.5, 0.6);
    }
}

// The next degree of a melody that wanders around the fifth and returns to the tonic in its last
// three steps.
int next_degree(int degree, int step, std::uint64_t move) {
    constexpr int kLastStep = 14;
    if (step >= kLastStep - 2) {
        return step == kLastStep ? 0 : 1;
    }
    const int centre = 4;
    const int pull = degree > centre + 3 ? -1 : (degree < centre - 3 ? 1 : 0);
    return degree + static_cast<int>(move) - 2 + pull;
}

// A phrase of two bars that ends on the tonic. Four phrases make a verse A A B A: repeated, a
// melody is recognised as one.
void write_phrase(Notes& score, double start, int phrase, int tonic, std::uint64_t seed) {
    const bool is_second = phrase % 4 == 2;
    // The same numbers for each A, so the same phrase.
    const CounterRandom random(seed, is_second ? 12 : 11);
    int degree = is_second ? 7 : 4;
    for (int step = 0; step <= 14; ++step) {
        const auto i = static_cast<std::uint64_t>(step);
        const bool is_strong = step % 4 == 0 || step == 14;
        if (!is_strong && random.uniform(3 * i) < 0.35) {
            continue;
        }
        degree = next_degree(degree, step, random.below(3 * i + 1, 5));
        const double at = start + 0.5 * step;
        const int pitch = hijaz_pitch(tonic, degree);
        const double length = step == 14 ? 0.95 : 0.48;
        score.push_back({at, Sound::oud, pitch, length, is_strong ? 0.95 : 0.75});
        if (step < 14 && random.uniform(3 * i + 2) < 0.25) {  // risha: the stroke doubled
            score.push_back({at + 0.25, Sound::oud, pitch, 0.24, 0.55});
        }
    }
}

}  // namespace

// Drums begin; riq and melody enter in bar 2, the bass in bar 4.
Notes write_maqsum(double beats, std::uint64_t seed) {
    const CounterRandom random(seed, 3);
    const int tonic = 50 + static_cast<int>(random.below(0, 5));
    return write_bars(beats, 4, [&](Notes& score, int bar) {
        const double start = 4.0 * bar;
        write_rhythm(score, start, bar);
        if (bar >= 2 && bar % 2 == 0) {
            write_phrase(score, start, bar / 2 - 1, tonic, seed);
        }
        if (bar >= 4) {
            score.push_back({start, Sound::bass, tonic - 12, 1.4, 0.8});
            score.push_back({start + 2.0, Sound::bass, tonic - 12, 0.9, 0.65});
            score.push_back({start + 3.0, Sound::bass, tonic - 5, 0.8, 0.6});
        }
    });
}

}  // namespace raks::audio
