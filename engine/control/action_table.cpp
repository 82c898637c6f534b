#include "engine/control/action_table.hpp"

#include <algorithm>
#include <array>
#include <cstddef>

#include "audio/beat/analyzer_command.hpp"
#include "base/suggest.hpp"

namespace raks::engine {
namespace {

// The value of an action that adds `most` at most, in either direction.
constexpr ActionValue step(ValueUnit unit, double most) {
    return {ValueKind::step, unit, -most, most};
}
// The value of an action that picks one of several, numbered from 1.
constexpr ActionValue choice(double highest) {
    return {ValueKind::choice, ValueUnit::number, 1.0, highest};
}

// The value of an action that sets it.
constexpr ActionValue level(ValueUnit unit, double lowest, double highest) {
    return {ValueKind::level, unit, lowest, highest};
}

// Help texts of the four arrow keys: two keys with the same text share a line of the help panel.
constexpr std::string_view kSeekNear = "back, forward 5 s";
constexpr std::string_view kSeekFar = "back, forward 30 s";

// The table. A row gives: action, name for machines, group, help, value, keys, text. Order: that of
// the enumeration, which the static_assert below checks.
constexpr std::array<ActionRow, kActionCount> kTable = {{
    // playing
    {Action::choose_source,
     "source",
     ActionGroup::playing,
     "what is listened to",
     {},
     {{{Key::f2, "F2"}}},
     TextKind::device},
    {Action::choose_output,
     "loudspeaker",
     ActionGroup::playing,
     "which loudspeaker plays",
     {},
     {},
     TextKind::device},
    {Action::show_queue,
     "queue",
     ActionGroup::playing,
     "the files that play",
     {},
     {{{.key = Key::f2, .name = "Shift+F2", .has_shift = true}}}},
    {Action::pause, "pause", ActionGroup::playing, "pause, go on", {}, {{{Key::space, "Space"}}}},
    {Action::seek,
     "seek",
     ActionGroup::playing,
     "back, forward",
     step(ValueUnit::seconds, 36'000.0),
     {{{Key::left, "Left", -5.0, false, kSeekNear},
       {Key::right, "Right", 5.0, false, kSeekNear},
       {Key::left, "Shift+Left", -30.0, true, kSeekFar},
       {Key::right, "Shift+Right", 30.0, true, kSeekFar}}}},
    {Action::next_file,
     "next-file",
     ActionGroup::playing,
     "next file",
     {},
     {{{key_of(U'n'), "N"}}}},
    {Action::previous_file,
     "previous-file",
     ActionGroup::playing,
     "to the start, file before",
     {},
     {{{key_of(U'b'), "B"}}}},
    {Action::volume,
     "volume",
     ActionGroup::playing,
     "softer, louder",
     step(ValueUnit::share, 1.0),
     {{{Key::down, "Down", -0.05}, {Key::up, "Up", 0.05}}}},
    {Action::latency,
     "latency",
     ActionGroup::playing,
     "picture earlier, later",
     step(ValueUnit::milliseconds, 500.0),
     {{{Key::page_down, "PgDn", -5.0}, {Key::page_up, "PgUp", 5.0}}}},
    // tempo
    {Action::tap_tempo, "tap", ActionGroup::tempo, "tap the tempo", {}, {{{key_of(U't'), "T"}}}},
    {Action::half_tempo,
     "half-tempo",
     ActionGroup::tempo,
     "half the tempo",
     {},
     {{{key_of(U'['), "["}}}},
    {Action::double_tempo,
     "double-tempo",
     ActionGroup::tempo,
     "double the tempo",
     {},
     {{{key_of(U']'), "]"}}}},
    {Action::three_two,
     "three-two",
     ActionGroup::tempo,
     "three beats for two, two for three",
     {},
     {{{key_of(U'\\'), "\\"}}}},
    {Action::change_tempo,
     "tempo",
     ActionGroup::tempo,
     "1 BPM less, more",
     step(ValueUnit::bpm, 100.0),
     // "=" is "+" without Shift on many layouts; both raise the tempo.
     {{{key_of(U'-'), "-", -1.0}, {key_of(U'+'), "+", 1.0}, {key_of(U'='), "=", 1.0}}}},
    {Action::set_tempo,
     "set-tempo",
     ActionGroup::tempo,
     "hold this tempo",
     level(ValueUnit::bpm, audio::kSlowestTempo.bpm(), audio::kFastestTempo.bpm())},
    {Action::hold_tempo,
     "hold-tempo",
     ActionGroup::tempo,
     "hold the tempo",
     {},
     {{{key_of(U'h'), "H"}}}},
    {Action::release_tempo,
     "release-tempo",
     ActionGroup::tempo,
     "follow the music again",
     {},
     {{{key_of(U'r'), "R"}}}},
    {Action::nudge_beats,
     "nudge",
     ActionGroup::tempo,
     "beats earlier, later",
     step(ValueUnit::milliseconds, 500.0),
     {{{key_of(U','), ",", -10.0}, {key_of(U'.'), ".", 10.0}}}},
    {Action::resync_bar,
     "resync-bar",
     ActionGroup::tempo,
     "count 1 is now",
     {},
     {{{Key::enter, "Enter"}}}},
    // dance
    {Action::next_figure,
     "next-figure",
     ActionGroup::dance,
     "another figure",
     {},
     {{{key_of(U'g'), "G"}}}},
    {Action::select_figure,
     "select-figure",
     ActionGroup::dance,
     "this figure",
     // More numbers than keys: a remote control may name figures beyond the ninth.
     choice(64.0),
     {{{key_of(U'1'), "1", 1.0},
       {key_of(U'2'), "2", 2.0},
       {key_of(U'3'), "3", 3.0},
       {key_of(U'4'), "4", 4.0},
       {key_of(U'5'), "5", 5.0},
       {key_of(U'6'), "6", 6.0},
       {key_of(U'7'), "7", 7.0},
       {key_of(U'8'), "8", 8.0},
       {key_of(U'9'), "9", 9.0}}}},
    {Action::keep_figure,
     "keep-figure",
     ActionGroup::dance,
     "keep to the figure",
     {},
     {{{key_of(U'k'), "K"}}}},
    {Action::choose_figure,
     "figure",
     ActionGroup::dance,
     "the figure of this name",
     {},
     {},
     TextKind::figure},
    {Action::next_dance,
     "next-dance",
     ActionGroup::dance,
     "another dance",
     {},
     {{{key_of(U'd'), "D"}}}},
    {Action::choose_dance,
     "dance",
     ActionGroup::dance,
     "dances and figures",
     {},
     {{{Key::f4, "F4"}}},
     TextKind::dance},
    {Action::forbid_dance,
     "forbid-dance",
     ActionGroup::dance,
     "a dance is danced no more",
     {},
     {},
     TextKind::dance},
    {Action::allow_dance,
     "allow-dance",
     ActionGroup::dance,
     "a dance may be danced again",
     {},
     {},
     TextKind::dance},
    {Action::keep_dance,
     "keep-dance",
     ActionGroup::dance,
     "keep dance for this song",
     {},
     {{{key_of(U'u'), "U"}}}},
    {Action::next_formation,
     "formation",
     ActionGroup::dance,
     "alone, couple, several",
     {},
     {{{key_of(U'e'), "E"}}},
     TextKind::formation},
    {Action::next_avatar,
     "avatar",
     ActionGroup::dance,
     "another avatar",
     {},
     {{{key_of(U'a'), "A"}}},
     TextKind::avatar},
    // view
    {Action::choose_preset,
     "preset",
     ActionGroup::view,
     "presets",
     {},
     {{{Key::f3, "F3"}}},
     TextKind::preset},
    {Action::save_preset,
     "save-preset",
     ActionGroup::view,
     "keep this as a preset",
     {},
     {{{.key = Key::f3, .name = "Shift+F3", .has_shift = true}}},
     TextKind::preset},
    {Action::toggle_figure_view,
     "figure-view",
     ActionGroup::view,
     "stick figure, avatar",
     {},
     {{{key_of(U's'), "S"}}}},
    {Action::next_camera,
     "camera",
     ActionGroup::view,
     "another camera",
     {},
     {{{key_of(U'v'), "V"}}},
     TextKind::camera},
    {Action::select_camera,
     "select-camera",
     ActionGroup::view,
     "front, side, back, above",
     choice(4.0),
     {{{Key::f5, "F5", 1.0}, {Key::f6, "F6", 2.0}, {Key::f7, "F7", 3.0}, {Key::f8, "F8", 4.0}}}},
    {Action::reset_camera,
     "reset-camera",
     ActionGroup::view,
     "reset the camera",
     {},
     {{{key_of(U'c'), "C"}, {Key::home, "Home"}}}},
    {Action::next_theme,
     "theme",
     ActionGroup::view,
     "another theme",
     {},
     {{{key_of(U'l'), "L"}}},
     TextKind::theme},
    {Action::next_backdrop,
     "backdrop",
     ActionGroup::view,
     "stage, transparent, key",
     {},
     {{{key_of(U'x'), "X"}}},
     TextKind::backdrop},
    {Action::toggle_overlay,
     "overlay",
     ActionGroup::view,
     "hide, show this overlay",
     {},
     {{{key_of(U'o'), "O"}, {Key::tab, "Tab"}}}},
    {Action::clean_picture,
     "clean",
     ActionGroup::view,
     "nothing but the picture",
     {},
     {{{Key::f10, "F10"}}}},
    {Action::calm,
     "calm",
     ActionGroup::view,
     "less motion in the picture",
     {},
     {},
     TextKind::on_off},
    // window
    {Action::toggle_fullscreen,
     "fullscreen",
     ActionGroup::window,
     "full screen",
     {},
     {{{key_of(U'f'), "F"}, {Key::f11, "F11"}}}},
    {Action::next_monitor,
     "next-monitor",
     ActionGroup::window,
     "full screen on the next",
     {},
     {{{.key = Key::f11, .name = "Shift+F11", .has_shift = true}}}},
    {Action::toggle_border,
     "border",
     ActionGroup::window,
     "window without frame",
     {},
     {{{key_of(U'w'), "W"}}}},
    {Action::toggle_on_top,
     "on-top",
     ActionGroup::window,
     "over all other windows",
     {},
     {{{key_of(U'y'), "Y"}}}},
    {Action::screenshot,
     "screenshot",
     ActionGroup::window,
     "save a picture",
     {},
     {{{key_of(U'p'), "P"}, {Key::f12, "F12"}}}},
    {Action::record, "record", ActionGroup::window, "record a film, stop", {}, {{{Key::f9, "F9"}}}},
    {Action::learn_midi,
     "learn-midi",
     ActionGroup::window,
     "teach a MIDI controller",
     {},
     {{{key_of(U'i'), "I"}}}},
    {Action::toggle_help,
     "help",
     ActionGroup::window,
     "these keys",
     {},
     {{{key_of(U'?'), "?"}, {Key::f1, "F1"}}}},
    {Action::quit,
     "quit",
     ActionGroup::window,
     "quit",
     {},
     {{{key_of(U'q'), "Q"}, {Key::escape, "Esc"}}}},
}};

// True when row i describes action i, so that an action's number finds its row without a search.
constexpr bool is_in_order() {
    for (std::size_t i = 0; i < kTable.size(); ++i) {
        if (static_cast<std::size_t>(kTable[i].action) != i) {
            return false;
        }
    }
    return true;
}
static_assert(is_in_order(), "row_of() takes the action's number for the row's");

// The names alone, in the table's order: what a wrong name is compared with.
constexpr std::array<std::string_view, kActionCount> kNames = [] {
    std::array<std::string_view, kActionCount> names{};
    std::transform(
        kTable.begin(), kTable.end(), names.begin(), [](const ActionRow& row) { return row.name; });
    return names;
}();

// True for keys with a character of their own: they lie between the space and the named keys, which
// are numbered past Unicode. Space counts as a named key here.
constexpr bool has_character(Key key) { return key > Key::space && key < Key::escape; }

// Shift is compared for named keys only: a character such as "?" may need Shift on one keyboard
// layout and not on another.
bool is_meant(const ActionKey& key, const KeyEvent& event) {
    return key.key == event.key && (has_character(event.key) || key.has_shift == event.has_shift);
}

}  // namespace

std::span<const ActionKey> ActionRow::keys() const noexcept {
    // Unused slots hold Key{}, and the used ones come first.
    const auto end = std::find_if(
        key_slots.begin(), key_slots.end(), [](const ActionKey& key) { return key.key == Key{}; });
    return std::span(key_slots).first(static_cast<std::size_t>(end - key_slots.begin()));
}

std::span<const ActionRow> action_table() noexcept { return kTable; }

const ActionRow& row_of(Action action) noexcept { return kTable[static_cast<std::size_t>(action)]; }

Expected<const ActionRow*> find_action(std::string_view name) {
    const auto at = std::find(kNames.begin(), kNames.end(), name);
    if (at == kNames.end()) {
        return fail(unknown_name("action", name, kNames));
    }
    return &kTable[static_cast<std::size_t>(at - kNames.begin())];
}

std::optional<ActionRequest> request_of(const KeyEvent& event) noexcept {
    if (event.has_control) {
        return std::nullopt;
    }
    for (const ActionRow& row : kTable) {
        for (const ActionKey& key : row.keys()) {
            if (is_meant(key, event)) {
                // Holding Left goes on seeking; holding F must not switch full screen on and off.
                const bool repeats = row.value && row.value->kind == ValueKind::step;
                return event.is_repeat && !repeats
                           ? std::nullopt
                           : std::optional(ActionRequest{row.action, key.value, {}});
            }
        }
    }
    return std::nullopt;
}

namespace {

// Appends the lines of one action. Neighbouring keys with the same text share a line; a key without
// a text of its own has the row's. `first` keeps a line of the action before from being extended.
void add_keys(const ActionRow& row, std::vector<HelpLine>& lines) {
    const std::size_t first = lines.size();
    for (const ActionKey& key : row.keys()) {
        const std::string_view text = key.help.empty() ? row.help : key.help;
        if (lines.size() == first || lines.back().text != text) {
            lines.push_back({row.group, {}, text});
        }
        lines.back().keys.emplace_back(key.name);
    }
}

}  // namespace

std::string_view title_of(ActionGroup group) noexcept {
    // In the order of ActionGroup.
    constexpr std::array<std::string_view, 5> kTitles = {
        "PLAYING", "TEMPO", "DANCE", "VIEW", "WINDOW"};
    return kTitles[static_cast<std::size_t>(group)];
}

std::vector<HelpLine> help_lines(const std::function<bool(Action)>& is_there) {
    std::vector<HelpLine> lines;
    for (const ActionRow& row : action_table()) {
        if (is_there(row.action)) {
            add_keys(row, lines);
        }
    }
    return lines;
}

}  // namespace raks::engine
