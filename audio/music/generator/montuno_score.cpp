// Salsa for a small band, written on the two-bar cycle of eight beats (sixteen eighths) that the
// son clave spans. The rhythm parts are the standard ones of the style; the harmony goes through
// four chords, one a bar; seed chooses key, mode, progression and the side of the clave.
#include <array>
#include <cstdlib>
#include <string>
#include <string_view>

#include "audio/music/generator/notes.hpp"
#include "base/random.hpp"

namespace raks::audio {
namespace {

constexpr double kEighth = 0.5;  // beats

/// Root (semitones above the key) and the chord's tones above the root.
struct Chord {
    int root;
    std::array<int, 4> tones;
};
constexpr std::array<int, 4> kMinor{0, 3, 7, 10};
constexpr std::array<int, 4> kMajor{0, 4, 7, 9};
constexpr std::array<int, 4> kDominant{0, 4, 7, 10};

struct Harmony {
    std::array<Chord, 4> chords;
    std::array<int, 7> scale;  ///< semitones above the key
};
constexpr std::array<int, 7> kMinorScale{0, 2, 3, 5, 7, 8, 10};
constexpr std::array<int, 7> kMajorScale{0, 2, 4, 5, 7, 9, 11};
constexpr std::array<Harmony, 4> kHarmonies{{
    {{{{0, kMinor}, {5, kMinor}, {7, kDominant}, {5, kMinor}}}, kMinorScale},
    {{{{0, kMinor}, {-2, kMajor}, {-4, kMajor}, {7, kDominant}}}, kMinorScale},
    {{{{0, kMajor}, {5, kMajor}, {7, kDominant}, {5, kMajor}}}, kMajorScale},
    {{{{2, kMinor}, {7, kDominant}, {0, kMajor}, {-3, kDominant}}}, kMajorScale},
}};

// Instruments and level of a section of the form.
struct Section {
    int cycles;
    bool has_piano;
    bool has_guiro;
    bool has_cascara;
    bool has_bell;
    bool has_melody;
    bool has_mambo;
    double level;
};
constexpr Section kIntro{2, true, false, false, false, false, false, 0.8};
constexpr std::array<Section, 6> kForm{{
    {4, true, true, false, false, true, false, 0.85},   // verse
    {4, true, false, false, true, false, true, 1.0},    // montuno, the brass answers
    {2, false, false, true, false, false, false, 0.9},  // drums alone
    {4, true, true, true, false, true, false, 0.9},     // verse
    {4, true, false, false, true, true, true, 1.0},     // mambo
    {2, true, true, true, false, false, false, 0.85},   // breath
}};

// A cycle's place in the form.
struct Place {
    const Section* section;
    int cycle;  ///< within the section
};

// The intro comes once; the form repeats.
Place place_of(int cycle) {
    if (cycle < kIntro.cycles) {
        return {&kIntro, cycle};
    }
    int rest = cycle - kIntro.cycles;
    for (std::size_t i = 0;; i = (i + 1) % kForm.size()) {
        if (rest < kForm[i].cycles) {
            return {&kForm[i], rest};
        }
        rest -= kForm[i].cycles;
    }
}

// The note of the pitch class of `pitch` that is nearest to `centre`: parts move by small steps.
int near_to(int pitch, int centre) {
    const int above = ((pitch - centre) % 12 + 12) % 12;
    return centre + (above > 6 ? above - 12 : above);
}

// One note of a written line: place and length in eighths, chord tone (4 = root an octave up), and
// +1 or -1 for its neighbour in the scale.
struct LineNote {
    int eighth;
    int length;
    int tone;
    int neighbour;
};
constexpr std::array<LineNote, 8> kCall{{{2, 1, 1, 0},
                                         {3, 1, 2, 0},
                                         {4, 2, 4, 0},
                                         {7, 1, 2, 1},
                                         {8, 3, 2, 0},
                                         {12, 1, 1, 0},
                                         {13, 1, 0, 1},
                                         {14, 2, 1, 0}}};
constexpr std::array<LineNote, 7> kAnswer{{{3, 1, 2, 0},
                                           {4, 1, 2, 1},
                                           {6, 2, 2, 0},
                                           {9, 1, 1, 1},
                                           {10, 1, 1, 0},
                                           {11, 1, 0, 1},
                                           {12, 3, 0, 0}}};
constexpr std::array<LineNote, 6> kMamboCall{
    {{0, 1, 0, 0}, {3, 1, 1, 0}, {6, 2, 2, 0}, {10, 1, 2, 0}, {11, 1, 1, 0}, {12, 2, 2, 0}}};
constexpr std::array<LineNote, 5> kMamboAnswer{
    {{2, 1, 2, 0}, {3, 1, 2, 0}, {4, 1, 1, 0}, {7, 1, 0, 0}, {8, 5, 1, 0}}};

// Writes cycle by cycle; the random choices are made once, for the whole piece.
class SalsaWriter {
 public:
    explicit SalsaWriter(std::uint64_t seed)
        : random_(seed, 4),
          harmony_(kHarmonies[random_.below(0, kHarmonies.size())]),
          key_(static_cast<int>(random_.below(1, 12))),
          is_two_three_(random_.below(2, 2) == 0) {}

    void write_cycle(int cycle) {
        const Place place = place_of(cycle);
        start_ = 8.0 * cycle;
        cycle_ = cycle;
        section_ = place.section;
        write_percussion(place.cycle);
        write_bass(place.cycle == 0);
        if (section_->has_piano) {
            write_montuno();
        }
        const bool is_call = place.cycle % 2 == 0;
        if (section_->has_melody) {
            is_call ? write_line(kCall, 70, 0.62, 1) : write_line(kAnswer, 70, 0.62, 1);
        }
        if (section_->has_mambo) {
            is_call ? write_line(kMamboCall, 72, 0.95, 3) : write_line(kMamboAnswer, 72, 0.9, 3);
        }
    }

    Notes take() { return std::move(score_); }

 private:
    // A pattern of sixteen eighths that is written for 2-3 clave, with the bars exchanged for 3-2.
    [[nodiscard]] std::string on_clave(std::string_view two_three) const {
        const std::string bars(two_three);
        return is_two_three_ ? bars : bars.substr(8) + bars.substr(0, 8);
    }

    void play(Sound sound, std::string_view pattern, double level = 1.0) {
        strike(score_, sound, pattern, start_, kEighth, level * section_->level);
    }

    // The clave side moves only those parts that belong to it.
    void write_percussion(int cycle_in_section) {
        play(Sound::clave, on_clave("..X.X...X..X..X."));
        play(Sound::conga_heel, "xo.xxo..xo..oo..");
        play(Sound::conga_slap, "..X.......X.....");
        play(Sound::conga_open, "......XX......XX");
        play(Sound::conga_low, on_clave("...........xx..."));
        play(Sound::maracas, "xoxoxoxoxoxoxoxo");
        if (section_->has_guiro) {
            play(Sound::guiro_long, "x...x...x...x...");
            play(Sound::guiro_short, "..xo..xo..xo..xo");
        }
        if (section_->has_cascara) {
            play(Sound::cascara, on_clave("X.xX.x.xX.x.Xx.x"));
        }
        if (section_->has_bell) {
            play(Sound::cowbell, "X...X...X...X...");
            play(Sound::cowbell_mouth, "..xx..xx..xx..xx");
        }
        if (cycle_in_section == 0 && cycle_ > 0) {
            play(Sound::crash, "x");
        }
        if (cycle_in_section == section_->cycles - 1) {
            write_fill();
        }
    }

    // The timbales' fill before the next section, over the last bar.
    void write_fill() {
        const bool is_roll = random_.below(8 + static_cast<std::uint64_t>(cycle_), 2) == 0;
        strike(score_,
               Sound::timbale_high,
               is_roll ? "......oxxXxX..X." : "....X..X..xxX...",
               start_ + 4.0,
               0.25);
        strike(score_,
               Sound::timbale_low,
               is_roll ? "............X..." : "..............X.",
               start_ + 4.0,
               0.25);
    }

    [[nodiscard]] const Chord& chord_of_bar(int bar) const {
        return harmony_.chords[static_cast<std::size_t>(bar % 4)];
    }
    // The chord at an eighth of this cycle; the last eighth of a bar anticipates the next chord.
    [[nodiscard]] const Chord& chord_at(int eighth) const {
        return chord_of_bar(2 * cycle_ + (eighth + 1) / 8);
    }

    /// Tumbao: the fifth on "2 and", the next chord's root on 4, held over the bar line.
    void write_bass(bool starts_section) {
        for (int bar = 0; bar < 2; ++bar) {
            const Chord& now = chord_of_bar(2 * cycle_ + bar);
            const Chord& next = chord_of_bar(2 * cycle_ + bar + 1);
            const double at = start_ + 4.0 * bar;
            if (starts_section && bar == 0) {
                add(at, Sound::bass, near_to(key_ + now.root, 36), 1.35, 0.95);
            }
            add(at + 1.5, Sound::bass, near_to(key_ + now.root + 7, 40), 1.35, 0.8);
            add(at + 3.0, Sound::bass, near_to(key_ + next.root, 36), 2.3, 0.95);
        }
    }

    // The montuno: a guide tone in octaves in turn with the chord's inner tones, in both hands.
    void write_montuno() {
        const std::string rhythm = on_clave("O.CO.C.O.C.O.C.O");
        for (int eighth = 0; eighth < 16; ++eighth) {
            const char mark = rhythm[static_cast<std::size_t>(eighth)];
            const double at = start_ + kEighth * eighth;
            const Chord& chord = chord_at(eighth);
            const int guide = near_to(key_ + chord.root, 72);
            if (mark == 'O') {
                for (const int octave : {-24, -12, 0}) {
                    add(at, Sound::piano, guide + octave, 0.46, octave == 0 ? 0.9 : 0.75);
                }
            } else if (mark == 'C') {
                for (const int tone : {1, 2}) {
                    const int pitch =
                        key_ + chord.root + chord.tones[static_cast<std::size_t>(tone)];
                    add(at, Sound::piano, near_to(pitch, guide - 6), 0.42, 0.7);
                    add(at, Sound::piano, near_to(pitch, guide - 6) - 12, 0.42, 0.6);
                }
            }
        }
    }

    // The next note of the scale above or below.
    [[nodiscard]] int scale_neighbour(int pitch, int direction) const {
        for (int candidate = pitch + direction;; candidate += direction) {
            const int degree = ((candidate - key_) % 12 + 12) % 12;
            for (const int tone : harmony_.scale) {
                if (tone == degree) {
                    return candidate;
                }
            }
        }
    }

    // The brass plays a written line in `voices` parts: chord tones below the upper one.
    template <std::size_t size>
    void write_line(const std::array<LineNote, size>& line,
                    int centre,
                    double velocity,
                    int voices) {
        for (const LineNote& note : line) {
            const Chord& chord = chord_at(note.eighth);
            for (int voice = 0; voice < voices; ++voice) {
                const int tone = note.tone - voice;
                const auto index = static_cast<std::size_t>((tone + 4) % 4);
                int pitch = near_to(key_ + chord.root, centre - 5) + chord.tones[index] +
                            (tone >= 4 ? 12 : 0) - (tone < 0 ? 12 : 0);
                if (note.neighbour != 0) {
                    pitch = scale_neighbour(pitch, note.neighbour);
                }
                const double length = kEighth * note.length - 0.12;
                add(start_ + kEighth * note.eighth,
                    Sound::brass,
                    pitch,
                    length,
                    velocity * (voice == 0 ? 1.0 : 0.7));
            }
        }
    }

    void add(double beat, Sound sound, int pitch, double beats, double velocity) {
        score_.push_back({beat, sound, pitch, beats, velocity * section_->level});
    }

    CounterRandom random_;
    Harmony harmony_;
    int key_;  ///< pitch class
    bool is_two_three_;
    Notes score_;
    const Section* section_ = &kIntro;
    double start_ = 0.0;  ///< of the cycle, in beats
    int cycle_ = 0;
};

}  // namespace

Notes write_montuno(double beats, std::uint64_t seed) {
    SalsaWriter writer(seed);
    for (int cycle = 0; 8.0 * cycle < beats; ++cycle) {
        writer.write_cycle(cycle);
    }
    Notes score = writer.take();
    std::erase_if(score, [beats](const Note& note) { return note.beat >= beats; });
    return score;
}

}  // namespace raks::audio
