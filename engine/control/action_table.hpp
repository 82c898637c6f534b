#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "base/expected.hpp"
#include "base/key.hpp"

/// What a person may ask of a running show, as one table: keys and the help panel are made from it,
/// and whatever else asks (a remote control, a MIDI controller) finds names, units and ranges here.
namespace raks::engine {

/// In the order of the help panel.
enum class Action : std::uint8_t {
    // playing
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
    change_tempo,
    hold_tempo,
    release_tempo,
    nudge_beats,
    resync_bar,
    // dance
    next_figure,
    select_figure,
    keep_figure,
    next_dance,
    next_formation,
    // view
    toggle_figure_view,
    next_camera,
    reset_camera,
    next_theme,
    toggle_overlay,
    // window
    toggle_fullscreen,
    screenshot,
    toggle_help,
    quit,
};
inline constexpr std::size_t kActionCount = 28;

/// One thing asked for: what every input produces. `value` is in the unit of the action's row; an
/// action without a value does not look at it.
struct ActionRequest {
    Action action{};
    double value = 0.0;

    friend bool operator==(const ActionRequest&, const ActionRequest&) = default;
};

/// The groups of the help panel, top to bottom.
enum class ActionGroup : std::uint8_t { playing, tempo, dance, view, window };

enum class ValueUnit : std::uint8_t { seconds, milliseconds, bpm, share, number };

/// How an action takes its value.
enum class ValueKind : std::uint8_t {
    step,    ///< added to what is there; a held key repeats it; out of range it is clamped
    choice,  ///< a whole number that names one of several; out of range it is refused
};

/// The value of an action: unit and range, both ends included.
struct ActionValue {
    ValueKind kind{};
    ValueUnit unit{};
    double lowest = 0.0;
    double highest = 0.0;
};

/// A key that asks for an action, and the value that it gives. Shift matters only for keys without
/// a character of their own.
struct ActionKey {
    Key key{};
    std::string_view name{};  ///< as written on a key: "Space", "F11", "["
    double value = 0.0;
    bool has_shift = false;
    std::string_view help{};  ///< what this value does: "back, forward 5 s"; empty: the row's help
};

/// One action.
struct ActionRow {
    static constexpr std::size_t kMostKeys = 9;

    Action action{};
    std::string_view name{};  ///< for machines, stable: "seek", "half-tempo"
    ActionGroup group{};
    std::string_view help{};                          ///< one line for people: "half the tempo"
    std::optional<ActionValue> value = std::nullopt;  ///< none: it takes no value
    std::array<ActionKey, kMostKeys> key_slots = {};  ///< those in use come first

    /// The keys that ask for it; no key asks for two things.
    [[nodiscard]] std::span<const ActionKey> keys() const noexcept;
};

/// Every action once, in the order of the enumeration.
[[nodiscard]] std::span<const ActionRow> action_table() noexcept;
[[nodiscard]] const ActionRow& row_of(Action action) noexcept;

/// The row of a name. Errors: no such action; the nearest name is suggested.
[[nodiscard]] Expected<const ActionRow*> find_action(std::string_view name);

/// What a key asks for; nothing when it is in no row. Keys with Control held belong to others. A
/// held key repeats steps only.
[[nodiscard]] std::optional<ActionRequest> request_of(const KeyEvent& event) noexcept;

/// A value as an action takes it.
struct TakenValue {
    double value = 0.0;
    std::string remark;  ///< a line for people when it is not the one that was given, else empty
};
/// Errors: not a finite number (an infinite step is clamped); a choice that is not there.
[[nodiscard]] Expected<TakenValue> take_value(const ActionRow& row, double value);

/// "s", "ms", "BPM"; empty for shares and numbers.
[[nodiscard]] std::string_view symbol_of(ValueUnit unit) noexcept;

}  // namespace raks::engine
