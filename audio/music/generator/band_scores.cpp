#include <array>

#include "audio/music/generator/notes.hpp"
#include "base/random.hpp"

// Rock, hip-hop and waltz: the common patterns of each style over common chord progressions.
namespace raks::audio {
namespace {

// Two sections of eight bars in turn, verse and chorus; the last bar of each has a drum fill.
void write_rock_bar(Notes& score, int bar, const CounterRandom& random) {
    constexpr std::array<int, 4> kRoots = {0, 5, 7, 5};  // I - IV - V - IV
    const double start = 4.0 * bar;
    const int key = 40 + static_cast<int>(random.below(0, 6));
    const int root = key + kRoots[static_cast<std::size_t>(bar % 4)];
    const bool is_chorus = bar / 8 % 2 == 1;
    const bool is_fill = bar % 8 == 7;
    strike(score, Sound::kick, is_chorus ? "X..xX.x." : "X...X.x.", start, 0.5);
    strike(score, Sound::snare, is_fill ? "....X...x.x.XxXX" : "....X.......X...", start, 0.25);
    strike(score, is_chorus ? Sound::open_hat : Sound::closed_hat, "XxXxXxXx", start, 0.5, 0.8);
    if (bar % 8 == 0) {
        score.push_back({.beat = start, .sound = Sound::crash});
    }
    for (int eighth = 0; eighth < 8; ++eighth) {
        const double at = start + 0.5 * eighth;
        score.push_back({at, Sound::bass, root - 12, 0.45, eighth % 2 == 0 ? 0.9 : 0.7});
        // Power chords: short (palm-muted) in the verse, ringing in the chorus.
        const bool rings = is_chorus && eighth % 4 == 0;
        for (const int pitch : {root, root + 7, root + 12}) {
            if (rings) {
                score.push_back({at, Sound::guitar, pitch, 1.9, 0.9});
            } else if (!is_chorus) {
                score.push_back({at, Sound::guitar, pitch, 0.22, eighth % 4 == 0 ? 0.8 : 0.5});
            }
        }
    }
}

// The kick varies at random from bar to bar; off-sixteenths are late.
void write_hiphop_bar(Notes& score, int bar, const CounterRandom& random) {
    constexpr std::array<int, 4> kRoots = {0, 0, -4, -2};  // i - i - VI - VII
    constexpr double kSwing = 0.06;                        // of a beat: late off-sixteenths
    const double start = 4.0 * bar;
    const int key = 45 + static_cast<int>(random.below(0, 6));
    const int root = key + kRoots[static_cast<std::size_t>(bar % 4)];
    const bool is_busy = random.below(static_cast<std::uint64_t>(bar) + 1, 2) == 0;
    Notes drums;
    strike(drums, Sound::kick, is_busy ? "X.....x.x.X....." : "X......x..X.....", start, 0.25);
    strike(drums, Sound::snare, "....X.......X..o", start, 0.25);
    strike(drums, Sound::clap, "....x.......x...", start, 0.25, 0.8);
    strike(drums,
           Sound::closed_hat,
           bar % 2 == 0 ? "X.xoX.x.X.xoX.x." : "X.x.X.xoX.x.X.xx",
           start,
           0.25);
    // Swing: only off-sixteenths move, so beats stay exact.
    for (Note& note : drums) {
        const auto sixteenth = static_cast<int>((note.beat - start) * 4.0 + 0.5);
        note.beat += sixteenth % 2 == 1 ? kSwing : 0.0;
    }
    score.insert(score.end(), drums.begin(), drums.end());
    for (const double at : {0.0, 1.75 + kSwing, 2.5}) {
        score.push_back({start + at, Sound::synth_bass, root - 12, at == 0.0 ? 1.2 : 0.5, 0.9});
    }
    const bool is_minor = bar % 4 < 2;
    for (const int pitch : {root + 12, root + (is_minor ? 15 : 16), root + 19}) {
        score.push_back({start, Sound::piano, pitch, 1.4, 0.6});
        score.push_back({start + 2.5, Sound::piano, pitch, 0.8, 0.5});
    }
}

// Bass on 1, chords on 2 and 3, and a melody.
void write_waltz_bar(Notes& score, int bar, const CounterRandom& random) {
    constexpr std::array<int, 8> kRoots = {0, 0, 7, 7, 7, 7, 0, 0};  // I I V V V V I I
    constexpr std::array<int, 7> kScale = {0, 2, 4, 5, 7, 9, 11};
    const double start = 3.0 * bar;
    const int key = 48 + static_cast<int>(random.below(0, 6));
    const int root = key + kRoots[static_cast<std::size_t>(bar % 8)];
    const bool is_dominant = kRoots[static_cast<std::size_t>(bar % 8)] == 7;
    score.push_back({start, Sound::bass, root - 12 - (bar % 2 == 1 ? 5 : 0), 0.9, 1.0});
    for (const double at : {1.0, 2.0}) {
        for (const int pitch : {root, root + 4, root + (is_dominant ? 10 : 7)}) {
            score.push_back({start + at, Sound::piano, pitch, 0.4, 0.55});
        }
    }
    strike(score, Sound::kick, "x..", start, 1.0, 0.7);
    strike(score, Sound::closed_hat, ".xx", start, 1.0, 0.7);
    // A melody that holds the first beat and moves on the others.
    const auto step = [&](int n) {
        return static_cast<int>(random.below(static_cast<std::uint64_t>(8 * bar + n) + 1, 5));
    };
    const auto tone = [&](int degree) {
        return key + 24 + kScale[static_cast<std::size_t>((degree + (is_dominant ? 4 : 0)) % 7)];
    };
    score.push_back({start, Sound::brass, tone(2 * (step(0) % 3)), bar % 2 == 0 ? 1.9 : 0.9, 0.7});
    if (bar % 2 == 1) {
        score.push_back({start + 1.0, Sound::brass, tone(step(1)), 0.9, 0.6});
    }
    score.push_back({start + 2.0, Sound::brass, tone(step(2)), 0.9, 0.6});
}

}  // namespace

Notes write_backbeat(double beats, std::uint64_t seed) {
    const CounterRandom random(seed, 3);
    return write_bars(beats, 4, [&](Notes& score, int bar) { write_rock_bar(score, bar, random); });
}

Notes write_boom_bap(double beats, std::uint64_t seed) {
    const CounterRandom random(seed, 4);
    return write_bars(
        beats, 4, [&](Notes& score, int bar) { write_hiphop_bar(score, bar, random); });
}

Notes write_oom_pah_pah(double beats, std::uint64_t seed) {
    const CounterRandom random(seed, 5);
    return write_bars(
        beats, 3, [&](Notes& score, int bar) { write_waltz_bar(score, bar, random); });
}

}  // namespace raks::audio
