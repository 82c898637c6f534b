#include "audio/music/styles/palette_reader.hpp"

#include "audio/music/styles/rhythm_reader.hpp"

namespace raks::audio {
namespace {

constexpr NumberRange kChance = {0, 1};
// General MIDI's programs, counted from 0.
constexpr NumberRange kPrograms = {0, 127};
constexpr std::size_t kMostPrograms = 64;

/// The instruments under `key`, which must be there and hold at least one: a part without
/// instrument could not be drawn.
std::vector<int> read_programs(const toml::table& table,
                               std::string_view key,
                               TomlComplaints& complaints) {
    std::vector<int> programs;
    const toml::node* const node =
        complaints.needed(table, key, fmt::format("{} = [program, ...]", key));
    if (node == nullptr) {
        return programs;
    }
    const toml::array* const array = node->as_array();
    if (array == nullptr || array->empty() || array->size() > kMostPrograms) {
        complaints.complain(
            *node,
            fmt::format("{} must be 1 to {} programs of General MIDI, from 0", key, kMostPrograms));
        return programs;
    }
    for (const toml::node& one : *array) {
        programs.push_back(complaints.whole(one, key, kPrograms));
    }
    return programs;
}

/// Chances of the band's players; what the file does not say stays as it is.
void read_players(const toml::table& table, TomlComplaints& complaints, BandChances& players) {
    constexpr std::array<std::string_view, 3> kKeys = {"bass", "chords", "lead"};
    const toml::node* const node = table.get("players");
    if (node == nullptr) {
        return;
    }
    const toml::table* const chances = node->as_table();
    if (chances == nullptr) {
        complaints.complain(*node, "players must be { bass = ..., chords = ..., lead = ... }");
        return;
    }
    // An unknown key is mostly a misspelt one, so it is a fault.
    complaints.check_keys(*chances, kKeys);
    complaints.read(*chances, "bass", kChance, players.bass);
    complaints.read(*chances, "chords", kChance, players.chords);
    complaints.read(*chances, "lead", kChance, players.lead);
}

/// The generator's music for this dance; nothing where the palette has none.
std::optional<OwnMusic> read_own(const toml::table& table, TomlComplaints& complaints) {
    const toml::node* const node = table.get("own");
    if (node == nullptr) {
        return std::nullopt;
    }
    const toml::table* const own = node->as_table();
    if (own == nullptr) {
        complaints.complain(*node, "own must be { style = ..., name = ..., tempo = [.., ..] }");
        return std::nullopt;
    }
    constexpr std::array<std::string_view, 4> kKeys = {"style", "name", "tempo", "share"};
    complaints.check_keys(*own, kKeys);
    OwnMusic music;
    music.style = complaints.text(*own, "style");
    music.name = complaints.text(*own, "name");
    // Both are used to find and to name such pieces.
    if (music.style.empty() || music.name.empty()) {
        complaints.complain(*node, "own needs style = \"...\" and name = \"...\"");
    }
    if (const auto* const tempo = complaints.needed(*own, "tempo", "tempo = [lowest, highest]")) {
        // The same limits as for rhythms.
        const auto range =
            complaints.numbers<2>(*tempo, "tempo", {30.0, 300.0}, "[lowest, highest] in BPM");
        if (range[0] > range[1]) {
            complaints.complain(*tempo, "tempo: the lowest must come first");
        }
        music.lowest_bpm = range[0];
        music.highest_bpm = range[1];
    }
    complaints.read(*own, "share", kChance, music.share);
    return music;
}

}  // namespace

BandPalette read_palette(const toml::table& table, TomlComplaints& complaints) {
    constexpr std::array<std::string_view, 11> kKeys = {"dance",
                                                        "melody",
                                                        "bass",
                                                        "chords",
                                                        "leads",
                                                        "kits",
                                                        "band_chance",
                                                        "lead_chance",
                                                        "drumless_chance",
                                                        "players",
                                                        "own"};
    BandPalette palette;
    const std::string dance = complaints.text(table, "dance");
    if (dance.empty()) {
        complaints.complain(table, "a palette needs dance = \"...\", or \"none\"");
    }
    // Every complaint from here on names the palette.
    complaints.enter(fmt::format("palette of \"{}\"", dance));
    complaints.check_keys(table, kKeys);
    palette.dance = dance_named(dance);
    if (const auto* const melody = complaints.needed(table, "melody", "melody = \"...\"")) {
        // The word's index in kMelodyNames is the enumerator.
        palette.melody = static_cast<Melody>(complaints.word(*melody, "melody", kMelodyNames));
    }
    palette.bass = read_programs(table, "bass", complaints);
    palette.chords = read_programs(table, "chords", complaints);
    palette.leads = read_programs(table, "leads", complaints);
    palette.kits = read_programs(table, "kits", complaints);
    // Chances are optional: the defaults are those of BandPalette.
    complaints.read(table, "band_chance", kChance, palette.band_chance);
    complaints.read(table, "lead_chance", kChance, palette.lead_chance);
    complaints.read(table, "drumless_chance", kChance, palette.drumless_chance);
    read_players(table, complaints, palette.players);
    palette.own = read_own(table, complaints);
    return palette;
}

}  // namespace raks::audio
