#include "audio/music/generator/notes.hpp"
#include "base/random.hpp"

namespace raks::audio {
namespace {

// Kick on every beat, hats off the beat; sections of eight bars add instruments.
void write_house_bar(Notes& score, int bar, const CounterRandom& random) {
    // Minor chords in parallel: i - VI - III - VII, two bars each.
    constexpr int kRoots[] = {0, -4, 3, -2};
    const double start = 4.0 * bar;
    const int section = bar / 8 % 4;
    const int key = 45 + static_cast<int>(random.below(0, 7));
    const int root = key + kRoots[bar / 2 % 4];
    strike(score, Sound::club_kick, "X...X...X...X...", start, 0.25);
    strike(score, Sound::open_hat, "..x...x...x...x.", start, 0.25);
    strike(score, Sound::clap, "....X.......X...", start, 0.25, section == 0 ? 0.7 : 1.0);
    if (section != 0) {
        strike(score, Sound::closed_hat, "xo.oxo.oxo.oxo.o", start, 0.25, 0.8);
    }
    if (bar % 8 == 0) {
        score.push_back({.beat = start, .sound = Sound::crash});
    }
    for (const double at : {0.5, 1.5, 2.5, 2.75, 3.5}) {
        score.push_back({start + at, Sound::synth_bass, root - 12, 0.30, at == 2.75 ? 0.6 : 0.9});
    }
    const bool is_minor = kRoots[bar / 2 % 4] == 0;
    const int third = root + (is_minor ? 3 : 4);
    if (bar % 2 == 0) {
        for (const int pitch : {root + 12, third + 12, root + 19}) {
            score.push_back({start, Sound::pad, pitch, 7.6, 0.8});
        }
    }
    if (section >= 2) {
        for (const double at : {0.0, 0.75, 1.5, 2.5, 3.25}) {
            for (const int pitch : {root + 12, third + 12, root + 19, root + 22}) {
                score.push_back({start + at, Sound::stab, pitch, 0.3, at == 0.0 ? 0.9 : 0.7});
            }
        }
    }
}

}  // namespace

Notes write_clicks(double beats) {
    Notes score;
    for (int beat = 0; beat < beats; ++beat) {
        score.push_back({.beat = static_cast<double>(beat),
                         .sound = beat % 4 == 0 ? Sound::click_high : Sound::click_low});
    }
    return score;
}

Notes write_drums(double beats, std::uint64_t seed) {
    const CounterRandom random(seed, 1);
    return write_bars(beats, 4, [&](Notes& score, int bar) {
        const double start = 4.0 * bar;
        const bool has_ghosts = random.below(static_cast<std::uint64_t>(bar), 2) == 0;
        strike(score, Sound::kick, has_ghosts ? "X...x..." : "X...Xx..", start, 0.5);
        strike(score, Sound::closed_hat, "XoxoXoxo", start, 0.5);
        const bool is_fill = bar % 8 == 7;
        strike(score, Sound::snare, is_fill ? "....X.....x.XxXx" : "....X.......X..o", start, 0.25);
        if (bar % 8 == 0) {
            score.push_back({.beat = start, .sound = Sound::crash});
        }
    });
}

Notes write_four_on_the_floor(double beats, std::uint64_t seed) {
    const CounterRandom random(seed, 2);
    return write_bars(
        beats, 4, [&](Notes& score, int bar) { write_house_bar(score, bar, random); });
}

}  // namespace raks::audio
