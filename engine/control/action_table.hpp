#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "base/expected.hpp"
#include "base/key.hpp"
#include "base/time.hpp"

/// What a person may ask of a running show, as one table: keys and the help panel are made from it,
/// and whatever else asks (a remote control, a MIDI controller) finds names, units and ranges here.
namespace raks::engine {

/// Everything that can be asked for; the order is that of the table and of the help panel.
enum class Action : std::uint8_t {
    // playing
    choose_source,
    choose_output,
    show_queue,
    pause,
    seek,
    next_file,
    previous_file,
    volume,
    latency,
    // tempo
    tap_tempo,
    half_tempo,
    double_tempo,
    three_two,
    change_tempo,
    set_tempo,
    hold_tempo,
    release_tempo,
    nudge_beats,
    resync_bar,
    // dance
    next_figure,
    select_figure,
    keep_figure,
    choose_figure,
    next_dance,
    choose_dance,
    forbid_dance,
    allow_dance,
    keep_dance,
    next_formation,
    next_avatar,
    // view
    choose_preset,
    save_preset,
    toggle_figure_view,
    next_camera,
    select_camera,
    reset_camera,
    next_theme,
    next_backdrop,
    toggle_overlay,
    clean_picture,
    calm,
    // window
    toggle_fullscreen,
    next_monitor,
    toggle_border,
    toggle_on_top,
    screenshot,
    record,
    learn_midi,
    toggle_help,
    quit,
};
/// Number of actions; the table must have exactly as many rows.
inline constexpr std::size_t kActionCount = 50;

/// One request, as every input (key, remote control, MIDI controller) produces it.
struct ActionRequest {
    Action action{};     ///< what is asked for
    double value = 0.0;  ///< in the unit of the action's row; ignored by an action without a value
    std::string text{};  ///< as the row's; empty: none, and the action asks for it or goes on to
                         ///< the next one
    /// When it was asked for; nothing: when it is carried out.
    std::optional<HostTime> came{};

    friend bool operator==(const ActionRequest&, const ActionRequest&) = default;
};

/// The groups of the help panel, top to bottom.
enum class ActionGroup : std::uint8_t { playing, tempo, dance, view, window };

/// Unit of an action's value. `share`: 1 is the whole; `number`: counts from 1.
enum class ValueUnit : std::uint8_t { seconds, milliseconds, bpm, share, number };

/// How an action takes its value.
enum class ValueKind : std::uint8_t {
    step,    ///< added to what is there; a held key repeats it; out of range it is clamped
    choice,  ///< a whole number that names one of several; out of range it is refused
    level,   ///< what is there from then on; out of range it is refused
};

/// The value of an action: unit and range, both ends included.
struct ActionValue {
    ValueKind kind{};      ///< added to the present value, one of several, or the value itself
    ValueUnit unit{};      ///< of the value and of both bounds
    double lowest = 0.0;   ///< the smallest value that is taken
    double highest = 0.0;  ///< the largest value that is taken
};

/// What the text of an action names.
enum class TextKind : std::uint8_t {
    none,       ///< the action takes no text
    device,     ///< an input or a loudspeaker, as `--device` and `--output` take it
    dance,      ///< one of `raks dances`
    figure,     ///< of the dance that is danced
    formation,  ///< as `--formation` takes it
    avatar,     ///< one of `raks avatar list`; no path
    preset,     ///< a preset, as `--preset` takes it
    camera,     ///< as `--camera` takes it
    theme,      ///< as `--theme` takes it; no path
    backdrop,   ///< as `--backdrop` takes it: stage, transparent, or a colour
    on_off,     ///< on or off
};

/// A key that asks for an action, and the value that it gives. Shift matters only for keys without
/// a character of their own.
struct ActionKey {
    Key key{};                ///< the key without its modifiers
    std::string_view name{};  ///< as written on a key: "Space", "F11", "["
    double value = 0.0;       ///< the value of the request that this key makes
    bool has_shift = false;   ///< the key must come with Shift; looked at for named keys only
    std::string_view help{};  ///< what this value does: "back, forward 5 s"; empty: the row's help
};

/// One action: its names, where the help panel lists it, its value and its keys.
struct ActionRow {
    /// Room for keys in a row: the digits 1 to 9 of select_figure.
    static constexpr std::size_t kMostKeys = 9;

    Action action{};          ///< equal to the row's index in the table
    std::string_view name{};  ///< for machines, stable: "seek", "half-tempo"
    ActionGroup group{};      ///< group of the help panel
    std::string_view help{};  ///< one line for people: "half the tempo"
    std::optional<ActionValue> value = std::nullopt;  ///< none: it takes no value
    /// Empty for what only a remote control or a list asks for.
    std::array<ActionKey, kMostKeys> key_slots = {};  ///< those in use come first
    TextKind text = TextKind::none;                   ///< what its text names

    /// The keys that ask for it; no key asks for two things.
    [[nodiscard]] std::span<const ActionKey> keys() const noexcept;
};

/// Every action once, in the order of the enumeration.
[[nodiscard]] std::span<const ActionRow> action_table() noexcept;
/// The row of one action; lives as long as the program. Threads: any.
[[nodiscard]] const ActionRow& row_of(Action action) noexcept;

/// The row of a name. Errors: no such action; the nearest name is suggested.
[[nodiscard]] Expected<const ActionRow*> find_action(std::string_view name);

/// The request that a key makes; nothing when no row has the key. Keys with Control held are left
/// to others. A held key repeats its request only where the action's value is a step.
[[nodiscard]] std::optional<ActionRequest> request_of(const KeyEvent& event) noexcept;

/// A value as an action takes it.
struct TakenValue {
    double value = 0.0;  ///< inside the range of the row
    std::string remark;  ///< a line for people when it is not the one that was given, else empty
};
/// Checks a value against the row's range. Errors: NaN; a choice that is not one of the row's
/// numbers; a level out of range. A step out of range, infinite too, is clamped and remarked upon.
[[nodiscard]] Expected<TakenValue> take_value(const ActionRow& row, double value);

/// Checks a text against the row. Errors: the row takes none; longer than 255 bytes, control
/// characters or no UTF-8 in it; no backdrop, neither on nor off, where the row takes one of these;
/// a path where it names an avatar or a theme. Whether there is a device, a
/// dance or a preset of that name is for the handler to say.
[[nodiscard]] Expected<void> check_text(const ActionRow& row, std::string_view text);

/// How a unit is written behind a value: "s", "ms", "BPM"; empty for shares and numbers.
[[nodiscard]] std::string_view symbol_of(ValueUnit unit) noexcept;

/// One line of the help panel: the keys that share a text, such as Left and Right.
struct HelpLine {
    ActionGroup group{};            ///< under whose title the line stands
    std::vector<std::string> keys;  ///< as written on the keys
    std::string_view text;          ///< "back, forward 5 s"; lives as long as the program
};

/// Title of a group, in capitals: "PLAYING".
[[nodiscard]] std::string_view title_of(ActionGroup group) noexcept;

/// The lines of those actions for which `is_there` is true, in the table's order. Threads: any.
[[nodiscard]] std::vector<HelpLine> help_lines(const std::function<bool(Action)>& is_there);

}  // namespace raks::engine
