#include "audio/music/styles/rhythm_reader.hpp"

#include "audio/music/styles/general_midi_drums.hpp"
#include "base/plain_name.hpp"
#include "base/printable.hpp"

namespace raks::audio {
namespace {

// Limits of what a file may say; a number beyond them is a fault, not a wish.
constexpr NumberRange kTempi = {30, 300};
constexpr NumberRange kCellBeats = {1, 64};
constexpr NumberRange kStepsPerBeat = {1, 24};
constexpr NumberRange kChances = {0.01, 1};  // of drums: a piece with none of them is never found
constexpr NumberRange kWeights = {0.01, 100};
// Bounds on lengths: a damaged file ends in a complaint, not in endless work.
constexpr std::size_t kMostLanes = 32;
constexpr std::size_t kMostChoices = 16;

/// A text that must be there and short.
std::string read_name(const toml::table& table,
                      std::string_view key,
                      std::string_view form,
                      TomlComplaints& complaints) {
    const toml::node* const node = complaints.needed(table, key, form);
    // `needed` complains of a key that is missing; here it is there, but not a name.
    const std::string name = complaints.text(table, key);
    // It names no file, so that "6/8" may be part of it.
    if (node != nullptr &&
        (name.empty() || name.size() > kLongestPlainName || printable(name) != name)) {
        complaints.complain(
            *node,
            fmt::format(
                "{} must have 1 to {} letters and no control characters", key, kLongestPlainName));
    }
    return name;
}

/// An array of names, each one of `known`; nothing where the key is not there.
template <class Enum>
std::vector<Enum> read_choices(const toml::table& table,
                               std::string_view key,
                               std::span<const std::string_view> known,
                               TomlComplaints& complaints) {
    std::vector<Enum> choices;
    const toml::node* const node = table.get(key);
    if (node == nullptr) {
        return choices;
    }
    const toml::array* const array = node->as_array();
    if (array == nullptr || array->empty() || array->size() > kMostChoices) {
        complaints.complain(*node,
                            fmt::format("{} must be 1 to {} names, [\"...\"]", key, kMostChoices));
        return choices;
    }
    for (const toml::node& one : *array) {
        // The name's index in `known` is the enumerator.
        choices.push_back(static_cast<Enum>(complaints.word(one, key, known)));
    }
    return choices;
}

/// Which dance the rhythm is for. No `dance` at all means that it is in no class of the genre
/// training, which differs from dance = "none".
std::optional<DanceLabel> read_label(const toml::table& table, TomlComplaints& complaints) {
    const toml::node* const dance = table.get("dance");
    const toml::node* const use = table.get("use");
    if (dance == nullptr) {
        // Said of nothing, it is mostly a forgotten key.
        if (use != nullptr) {
            complaints.complain(*use, "use says how dance = \"...\" is used, which is not there");
        }
        return std::nullopt;
    }
    DanceLabel label;
    label.dance = dance_named(read_name(table, "dance", "dance = \"...\"", complaints));
    if (use != nullptr) {
        label.use = static_cast<DanceLabel::Use>(complaints.word(*use, "use", kUseNames));
    }
    return label;
}

/// Lowest and highest tempo in BPM, in this order.
void read_tempo(const toml::table& table, TomlComplaints& complaints, RhythmStyle& rhythm) {
    constexpr std::string_view kForm = "tempo = [lowest, highest]";
    const toml::node* const node = complaints.needed(table, "tempo", kForm);
    if (node == nullptr) {
        return;
    }
    const auto tempo = complaints.numbers<2>(*node, "tempo", kTempi, "[lowest, highest]");
    // A range in the wrong order is a mistake to tell, not to mend.
    if (tempo[0] > tempo[1]) {
        complaints.complain(*node, "tempo must rise: [lowest, highest]");
    }
    rhythm.lowest_bpm = tempo[0];
    rhythm.highest_bpm = tempo[1];
}

/// Beats a bar, beats of the cell and steps a beat. A cell is whole bars, so that its first step is
/// always a downbeat.
void read_metre(const toml::table& table, TomlComplaints& complaints, RhythmStyle& rhythm) {
    const auto whole = [&](std::string_view key, NumberRange range, int& target) {
        const toml::node* const node = complaints.needed(table, key, fmt::format("{} = ...", key));
        target = node != nullptr ? complaints.whole(*node, key, range) : 0;
    };
    whole("beats_per_bar", {1, 12}, rhythm.beats_per_bar);
    whole("cell_beats", kCellBeats, rhythm.cell_beats);
    whole("steps_per_beat", kStepsPerBeat, rhythm.steps_per_beat);
    // Only with sound numbers: an unread beats_per_bar is 0.
    if (complaints.is_sound() && rhythm.cell_beats % rhythm.beats_per_bar != 0) {
        complaints.complain(*table.get("cell_beats"),
                            fmt::format("cell_beats is {}, must be whole bars of {} beats",
                                        rhythm.cell_beats,
                                        rhythm.beats_per_bar));
    }
}

/// A drum's key, from its General MIDI name or as a number.
int read_drum(const toml::node& node, TomlComplaints& complaints) {
    if (!node.is_string()) {
        return complaints.whole(node, "drum", {0, 127});
    }
    std::array<std::string_view, kDrumNames.size()> names;
    std::transform(kDrumNames.begin(), kDrumNames.end(), names.begin(), [](const DrumName& drum) {
        return drum.name;
    });
    return kDrumNames[complaints.word(node, "drum", names)].key;
}

/// What is wrong with one row of a pattern; empty: nothing.
std::string fault_of(std::string_view row, const RhythmStyle& rhythm) {
    const auto steps = static_cast<std::size_t>(rhythm.cell_beats * rhythm.steps_per_beat);
    // Letters before length: a stray character explains a wrong length, too.
    const std::size_t odd = row.find_first_not_of("Xxo.");
    if (odd != std::string_view::npos) {
        return fmt::format("step {} is \"{}\", must be X, x, o or .", odd + 1, row[odd]);
    }
    if (row.size() != steps) {
        return fmt::format("has {} steps, must have {}: {} beats of {}",
                           row.size(),
                           steps,
                           rhythm.cell_beats,
                           rhythm.steps_per_beat);
    }
    return {};
}

/// Checks each variant of a pattern on its own, since a piece plays one of them.
void check_pattern(const toml::node& node,
                   std::string_view pattern,
                   const RhythmStyle& rhythm,
                   TomlComplaints& complaints) {
    for (int number = 1;; ++number) {
        const std::size_t bar = pattern.find('|');
        const std::string fault = fault_of(pattern.substr(0, bar), rhythm);
        if (!fault.empty()) {
            complaints.complain(node, fmt::format("row {} of pattern: {}", number, fault));
        }
        if (bar == std::string_view::npos) {
            return;
        }
        pattern.remove_prefix(bar + 1);
    }
}

/// One drum's pattern. Needs the metre, which tells how many steps a pattern has.
DrumLane read_lane(const toml::node& node, const RhythmStyle& rhythm, TomlComplaints& complaints) {
    constexpr std::array<std::string_view, 3> kKeys = {"drum", "chance", "pattern"};
    DrumLane lane;
    const toml::table* const table = node.as_table();
    if (table == nullptr) {
        complaints.complain(node, "a lane must be { drum = ..., chance = ..., pattern = \"...\" }");
        return lane;
    }
    complaints.check_keys(*table, kKeys);
    if (const auto* const drum = complaints.needed(*table, "drum", "drum = \"...\"")) {
        lane.key = read_drum(*drum, complaints);
    }
    if (const auto* const pattern = complaints.needed(*table, "pattern", "pattern = \"...\"")) {
        lane.pattern = complaints.text(*table, "pattern");
        check_pattern(*pattern, lane.pattern, rhythm, complaints);
    }
    complaints.read(*table, "chance", kChances, lane.chance);
    return lane;
}

/// The rhythm's drums: at least one.
void read_lanes(const toml::table& table, TomlComplaints& complaints, RhythmStyle& rhythm) {
    const toml::node* const node = complaints.needed(table, "lanes", "lanes = [{ drum = ... }]");
    // After a fault in the metre every pattern would seem to have a wrong length.
    if (node == nullptr || !complaints.is_sound()) {
        return;
    }
    const toml::array* const array = node->as_array();
    if (array == nullptr || array->empty() || array->size() > kMostLanes) {
        complaints.complain(
            *node, fmt::format("lanes must be 1 to {} lanes, [{{ drum = ... }}]", kMostLanes));
        return;
    }
    for (const toml::node& one : *array) {
        rhythm.lanes.push_back(read_lane(one, rhythm, complaints));
    }
}

}  // namespace

std::string dance_named(std::string_view name) { return std::string(name == "none" ? "" : name); }

RhythmStyle read_rhythm(const toml::table& table, TomlComplaints& complaints) {
    constexpr std::array<std::string_view, 12> kKeys = {"name",
                                                        "family",
                                                        "dance",
                                                        "use",
                                                        "tempo",
                                                        "beats_per_bar",
                                                        "cell_beats",
                                                        "steps_per_beat",
                                                        "bass",
                                                        "comping",
                                                        "weight",
                                                        "lanes"};
    RhythmStyle rhythm;
    rhythm.name = read_name(table, "name", "name = \"...\"", complaints);
    // Every complaint from here on names the rhythm.
    complaints.enter(fmt::format("rhythm \"{}\"", rhythm.name));
    complaints.check_keys(table, kKeys);
    rhythm.family = read_name(table, "family", "family = \"...\"", complaints);
    rhythm.label = read_label(table, complaints);
    read_tempo(table, complaints, rhythm);
    // Before the lanes, whose patterns are checked against it.
    read_metre(table, complaints, rhythm);
    rhythm.bass = read_choices<BassLine>(table, "bass", kBassLineNames, complaints);
    rhythm.comping = read_choices<Comping>(table, "comping", kCompingNames, complaints);
    complaints.read(table, "weight", kWeights, rhythm.weight);
    read_lanes(table, complaints, rhythm);
    return rhythm;
}

}  // namespace raks::audio
