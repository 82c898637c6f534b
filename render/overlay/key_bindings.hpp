#pragma once

#include <optional>
#include <span>
#include <string_view>

#include "render/gl/window_event.hpp"

namespace raks::render {

/// What a key asks for. The engine turns it into a command with its time.
enum class Action : std::uint8_t {
    pause,
    seek_back,
    seek_forward,
    seek_back_far,
    seek_forward_far,
    next_file,
    volume_up,
    volume_down,
    tap_tempo,
    half_tempo,
    double_tempo,
    next_figure,         ///< another one after this
    select_figure,       ///< the one of the key's number, after this
    keep_figure,         ///< this one again and again, or as the grammar says
    next_dance,          ///< another one, whatever is heard; at last as heard again
    toggle_figure_view,  ///< stick figure or skinned avatar
    reset_camera,
    toggle_overlay,
    toggle_fullscreen,
    screenshot,
    toggle_help,
    quit,
};
inline constexpr int kActionCount = 22;

inline constexpr double kSeekSeconds = 5.0;
inline constexpr double kSeekFarSeconds = 30.0;

/// One way to ask for an action. Shift matters only for keys without a character of their own.
struct KeyBinding {
    Key key;
    bool has_shift;
    Action action;
    std::string_view name;  ///< as written on a key: "Space", "F11", "["
};

/// The groups of the help panel, top to bottom.
enum class ActionGroup : std::uint8_t { playing, tempo, dance, view, window };

struct ActionHelp {
    Action action;
    ActionGroup group;
    std::string_view text;  ///< "forward 5 s"
};

/// All keys, the table that the window, the help panel and the manual page are made from. Several
/// keys may ask for one action; no key asks for two.
[[nodiscard]] std::span<const KeyBinding> key_bindings() noexcept;
/// What each action does, in the order of the help panel; every action once.
[[nodiscard]] std::span<const ActionHelp> action_help() noexcept;

/// 0 for "1", 1 for "2": which figure a key of Action::select_figure means.
[[nodiscard]] int figure_of(Key key) noexcept;

/// The action that a key asks for. Keys with Control held belong to others. Held keys repeat
/// seeking and volume only.
[[nodiscard]] std::optional<Action> action_of(const KeyEvent& event) noexcept;

}  // namespace raks::render
