#include "audio/music/styles/genre_styles.hpp"

#include <algorithm>
#include <array>
#include <string>

#include "audio/music/styles/general_midi_drums.hpp"

namespace raks::audio {
namespace {

using B = BassLine;
using C = Comping;

/// Rhythms that the beat tracker's training does without.
const std::vector<RhythmStyle>& further_styles() {
    static const std::vector<RhythmStyle> styles = {
        {"bolero",
         "latin",
         76,
         120,
         4,
         4,
         4,
         {{kMaracas, "X.xxx.x.X.xxx.x.|x.xxx.x.x.xxx.x.", 0.9},
          {kHighBongo, "X.o.X.o.X.o.X.o.|XoxoX.xoXoxoX.xo", 0.7},
          {kSlapConga, "....X.......x...", 0.8},
          {kOpenConga, "............x.x.|......x.....x.x.", 0.8},
          {kTimbale, "x.xxx.x.x.x.x.x.", 0.4},
          {kClaves, "x..x..x...x.x...|x.....x...x.x...", 0.4}},
         {B::tumbao, B::root_fifth},
         {C::arpeggio8, C::montuno, C::held},
         1.0},
        {"son",
         "latin",
         150,
         200,
         4,
         4,
         4,
         {{kClaves, "x..x..x...x.x...|..x.x...x..x..x.", 1.0},
          {kMaracas, "XoxoXoxoXoxoXoxo", 0.9},
          {kHighBongo, "X.o.X.o.X.o.X.o.|XoxoXoxxXoxoXoxx", 0.9},
          {kGuiro, "X.ooX.ooX.ooX.oo", 0.5}},
         {B::tumbao},
         {C::montuno, C::arpeggio8},
         1.0},
        {"boom bap",
         "hiphop",
         78,
         100,
         4,
         4,
         4,
         {{kKick, "X......X..X.....|X.....x.X.......|X..X......X..x..|X.X....x..X.....", 1.0},
          {kSnare, "....X.......X...|....X..o....X..o", 1.0},
          {kHat, "x.x.x.x.x.x.x.x.|x.xox.xox.xox.xo|x.x.x.xxx.x.x.x.", 0.9},
          {kOpenHat, "..............x.|......x.........", 0.3},
          {kRim, "..........o.....", 0.2}},
         {B::random_cell, B::whole_bar},
         {C::held, C::random_cell, C::none},
         1.5},
        {"club hip-hop",
         "hiphop",
         84,
         106,
         4,
         4,
         4,
         {{kKick, "X..x..X...x.....|X...x..X..X.....|X..X..X...X..X..", 1.0},
          {kClap, "....X.......X...", 1.0},
          {kSnare, "....x.......x...", 0.4},
          {kHat, "x.x.x.x.x.x.x.x.|xxxxxxxxxxxxxxxx|x.xxx.x.x.xxx.xx", 0.8},
          {kShaker, "xoxoxoxoxoxoxoxo", 0.3}},
         {B::random_cell, B::whole_bar},
         {C::random_cell, C::none, C::arpeggio8},
         1.0},
        {"ballad hip-hop",
         "hiphop",
         68,
         88,
         4,
         4,
         4,
         {{kKick, "X.....x...X.....|X.........Xx....", 1.0},
          {kSnare, "....X.......X...|....X.......X..o", 0.9},
          {kHat, "x.x.x.x.x.x.x.x.|x.ooxxx.x.ooxxx.", 0.9}},
         {B::whole_bar, B::random_cell},
         {C::held, C::arpeggio8},
         1.0},
        {"slow waltz",
         "ballroom",
         80,
         100,
         3,
         3,
         2,
         {{kKick, "X.....", 0.4}, {kHat, "..x.x.|..o.o.", 0.4}, {kRide, "x.x.x.", 0.3}},
         {B::whole_bar},
         {C::after_beats, C::after_beats, C::arpeggio8},
         1.5},
        {"viennese waltz",
         "ballroom",
         150,
         190,
         3,
         3,
         2,
         {{kKick, "X.....", 0.4}, {kSnare, "..o.o.|..x.o.", 0.4}, {kTriangle, "x.....", 0.2}},
         {B::whole_bar},
         {C::after_beats},
         1.5},
        {"musette",
         "ballroom",
         140,
         200,
         3,
         3,
         2,
         {{kKick, "X.....", 0.6}, {kHat, "..x.x.", 0.6}, {kSnare, "..o.o.", 0.3}},
         {B::whole_bar, B::root_fifth},
         {C::after_beats},
         1.0},
        {"orient band",
         "belly",
         70,
         140,
         4,
         4,
         4,
         {{kFloorTom, "X.......X.......|X.....x.X.......|X...............", 0.8},
          {kTambourine, "....x.......x...|x...x...x...x...|..x.x...x...x.x.", 0.6},
          {kLowConga, "X..x..X.....X...|....x..x....x...", 0.5}},
         {B::whole_bar, B::none},
         {C::held, C::none},
         3.0},
        {"samai",
         "belly",
         90,
         140,
         4,
         4,
         2,
         {{kLowConga, "X..X.X..|X...X...", 1.0},
          {kSlapConga, "..X...X.|...x..XX", 0.9},
          {kTambourine, "x.xxx.xx", 0.5}},
         {B::whole_bar, B::none},
         {C::none, C::held},
         1.0},
        {"deep house",
         "electronic",
         116,
         126,
         4,
         4,
         4,
         {{kKick, "X...X...X...X...", 1.0},
          {kOpenHat, "..x...x...x...x.", 0.9},
          {kClap, "....X.......X...", 0.8},
          {kShaker, "xoxoxoxoxoxoxoxo", 0.5},
          {kOpenConga, "...x..x....x..x.", 0.3}},
         {B::off_beat, B::random_cell},
         {C::random_cell, C::held},
         1.5},
    };
    return styles;
}

struct Entry {
    std::string_view name;
    Genre genre;
    GenreStyle::Use use = GenreStyle::Use::always;
};

constexpr auto kHeldOut = GenreStyle::Use::held_out;

// What is not named here is none of the six dances.
constexpr std::array kEntries = {
    Entry{"salsa", Genre::salsa},
    Entry{"mambo", Genre::salsa},
    Entry{"son", Genre::salsa},
    Entry{"bolero", Genre::salsa},
    Entry{"cha-cha", Genre::salsa},
    Entry{"merengue", Genre::salsa, kHeldOut},
    Entry{"merengue kit", Genre::salsa, kHeldOut},
    Entry{"cumbia", Genre::salsa},
    Entry{"bachata", Genre::salsa},
    Entry{"songo", Genre::salsa},
    Entry{"rhumba kit", Genre::salsa},
    Entry{"rumba on the kit", Genre::salsa},
    Entry{"guaguanco", Genre::salsa},
    Entry{"mozambique", Genre::salsa},
    Entry{"clave kit", Genre::salsa},
    Entry{"samba", Genre::salsa},
    Entry{"samba kit", Genre::salsa},
    Entry{"maqsum", Genre::belly},
    Entry{"baladi", Genre::belly},
    Entry{"saidi", Genre::belly, kHeldOut},
    Entry{"malfuf", Genre::belly},
    Entry{"ayub", Genre::belly},
    Entry{"wahda", Genre::belly},
    Entry{"masmudi", Genre::belly},
    Entry{"chiftetelli", Genre::belly},
    Entry{"belly kit", Genre::belly},
    Entry{"orient band", Genre::belly},
    Entry{"samai", Genre::belly},
    Entry{"house", Genre::house},
    Entry{"deep house", Genre::house},
    Entry{"techno", Genre::house},
    Entry{"trance", Genre::house, kHeldOut},
    Entry{"electro", Genre::house},
    Entry{"drum and bass", Genre::house},
    Entry{"breakbeat", Genre::house},
    Entry{"two-step", Genre::house},
    Entry{"disco", Genre::house},
    Entry{"hip-hop", Genre::hiphop},
    Entry{"boom bap", Genre::hiphop},
    Entry{"club hip-hop", Genre::hiphop},
    Entry{"ballad hip-hop", Genre::hiphop},
    Entry{"trap", Genre::hiphop, kHeldOut},
    Entry{"rock", Genre::rock},
    Entry{"rock with broken backbeat", Genre::rock},
    Entry{"four snares", Genre::rock},
    Entry{"half time rock", Genre::rock},
    Entry{"tom rock", Genre::rock},
    Entry{"heavy rock", Genre::rock},
    Entry{"punk", Genre::rock, kHeldOut},
    Entry{"fast game", Genre::rock},
    Entry{"waltz", Genre::waltz},
    Entry{"slow waltz", Genre::waltz},
    Entry{"viennese waltz", Genre::waltz},
    Entry{"musette", Genre::waltz},
    Entry{"jazz waltz", Genre::waltz, kHeldOut},
};

/// Neighbours of rock and house that a dancer may take for either: not learnt from.
bool is_between(std::string_view name) {
    constexpr std::array<std::string_view, 4> kBetween = {
        "rockabilly", "shuffle", "half-time shuffle", "sparse"};
    return std::find(kBetween.begin(), kBetween.end(), name) != kBetween.end();
}

std::vector<GenreStyle> make_table() {
    std::vector<GenreStyle> table;
    const auto add = [&table](const RhythmStyle& style) {
        const auto* const found = std::find_if(
            kEntries.begin(), kEntries.end(), [&](const Entry& e) { return e.name == style.name; });
        if (found != kEntries.end()) {
            table.push_back({&style, found->genre, found->use});
        } else if (style.family != "latin" && !is_between(style.name)) {
            // Latin rhythms that are not named above are neither salsa nor clearly something else.
            table.push_back({&style});
        }
    };
    const auto known = rhythm_styles();
    std::for_each(known.begin(), known.end(), add);
    std::for_each(further_styles().begin(), further_styles().end(), add);
    return table;
}

}  // namespace

std::span<const GenreStyle> genre_styles() {
    static const std::vector<GenreStyle> table = make_table();
    return table;
}

std::optional<GenreStyle> genre_of_style(std::string_view name) {
    for (const GenreStyle& style : genre_styles()) {
        if (style.style->name == name) {
            return style;
        }
    }
    struct Played {
        std::string_view name;
        Genre genre;
    };
    constexpr std::array kPlayed = {Played{"own salsa", Genre::salsa},
                                    Played{"own maqsum", Genre::belly},
                                    Played{"own house", Genre::house},
                                    Played{"groove rock", Genre::rock},
                                    Played{"groove hiphop", Genre::hiphop},
                                    Played{"groove jazz", Genre::unknown},
                                    Played{"groove funk", Genre::unknown},
                                    Played{"piano", Genre::unknown},
                                    Played{"lied", Genre::unknown},
                                    Played{"people", Genre::unknown},
                                    Played{"no pulse", Genre::unknown},
                                    Played{"free", Genre::unknown},
                                    Played{"own clicks", Genre::unknown}};
    const auto* const found =
        std::find_if(kPlayed.begin(), kPlayed.end(), [name](const Played& played) {
            return played.name == name || name.starts_with(std::string(played.name) + "-");
        });
    return found == kPlayed.end() ? std::nullopt : std::optional(GenreStyle{nullptr, found->genre});
}

const Palette& palette_of(Genre genre) {
    // Numbers: General MIDI. 104-111 are plucked and blown instruments of other continents.
    static const std::array<Palette, kGenreCount> palettes = {{
        {{32, 33, 35, 43},
         {0, 0, 1, 2, 3, 24, 61},
         {56, 57, 61, 56, 64, 65, 66, 73, 11},
         {0, 0, 0, 8},
         0.97,
         0.6,
         {.bass = 0.95, .chords = 0.9, .lead = 0.3}},
        {{43, 42, 49, 32},
         {48, 49, 50, 51, 104, 46, 15},
         {104, 105, 106, 107, 15, 68, 69, 71, 72, 73, 75, 77, 110, 111, 40, 41, 48},
         {0, 0, 8, 48},
         0.95,
         0.9,
         {.bass = 0.6, .chords = 0.5, .lead = 0.2}},
        {{38, 39, 38, 87},
         {80, 81, 89, 90, 91, 94, 62, 63, 4, 50},
         {80, 81, 82, 84, 87, 98, 99, 62},
         {24, 25, 24, 25},
         0.97,
         0.5,
         {.bass = 0.95, .chords = 0.85, .lead = 0.2}},
        {{38, 39, 33, 35, 32},
         {4, 5, 4, 0, 48, 7, 89, 2, 88},
         {4, 11, 65, 56, 80, 53, 8, 75},
         {25, 25, 24, 8, 0},
         0.95,
         0.4,
         {.bass = 0.95, .chords = 0.85, .lead = 0.2}},
        {{33, 34, 33, 36, 37},
         {29, 30, 28, 30, 29, 27, 18},
         {29, 30, 27, 26, 18, 84},
         {0, 16, 0, 16},
         1.0,
         0.6,
         {.bass = 0.95, .chords = 0.9, .lead = 0.3}},
        {{43, 32, 42, 58, 43},
         {0, 21, 48, 22, 23, 40, 46, 24, 1},
         {40, 21, 73, 71, 68, 0, 22, 48, 60},
         {0, 40, 48},
         1.0,
         0.8,
         {.bass = 1.0, .chords = 1.0, .lead = 0.4}},
        {{32, 33, 34, 35, 36, 38, 39, 43},
         {0, 4, 11, 16, 21, 24, 25, 27, 48, 61, 89},
         {0, 11, 21, 22, 26, 40, 42, 52, 56, 60, 65, 68, 71, 73, 75, 81},
         {0, 0, 8, 16, 24, 25, 32, 40},
         0.85,
         0.6,
         {}},
    }};
    return palettes[static_cast<std::size_t>(genre)];
}

}  // namespace raks::audio
