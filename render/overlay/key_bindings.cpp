#include "render/overlay/key_bindings.hpp"

#include <algorithm>
#include <array>

namespace raks::render {
namespace {

constexpr std::array kBindings = {
    KeyBinding{Key::space, false, Action::pause, "Space"},
    KeyBinding{Key::left, false, Action::seek_back, "Left"},
    KeyBinding{Key::right, false, Action::seek_forward, "Right"},
    KeyBinding{Key::left, true, Action::seek_back_far, "Shift+Left"},
    KeyBinding{Key::right, true, Action::seek_forward_far, "Shift+Right"},
    KeyBinding{key_of(U'n'), false, Action::next_file, "N"},
    KeyBinding{Key::up, false, Action::volume_up, "Up"},
    KeyBinding{Key::down, false, Action::volume_down, "Down"},
    KeyBinding{key_of(U't'), false, Action::tap_tempo, "T"},
    KeyBinding{key_of(U'['), false, Action::half_tempo, "["},
    KeyBinding{key_of(U']'), false, Action::double_tempo, "]"},
    KeyBinding{key_of(U'g'), false, Action::next_figure, "G"},
    KeyBinding{key_of(U'1'), false, Action::select_figure, "1"},
    KeyBinding{key_of(U'2'), false, Action::select_figure, "2"},
    KeyBinding{key_of(U'3'), false, Action::select_figure, "3"},
    KeyBinding{key_of(U'4'), false, Action::select_figure, "4"},
    KeyBinding{key_of(U'5'), false, Action::select_figure, "5"},
    KeyBinding{key_of(U'6'), false, Action::select_figure, "6"},
    KeyBinding{key_of(U'7'), false, Action::select_figure, "7"},
    KeyBinding{key_of(U'8'), false, Action::select_figure, "8"},
    KeyBinding{key_of(U'9'), false, Action::select_figure, "9"},
    KeyBinding{key_of(U'k'), false, Action::keep_figure, "K"},
    KeyBinding{key_of(U'd'), false, Action::next_dance, "D"},
    KeyBinding{key_of(U's'), false, Action::toggle_figure_view, "S"},
    KeyBinding{key_of(U'c'), false, Action::reset_camera, "C"},
    KeyBinding{Key::home, false, Action::reset_camera, "Home"},
    KeyBinding{key_of(U'o'), false, Action::toggle_overlay, "O"},
    KeyBinding{Key::tab, false, Action::toggle_overlay, "Tab"},
    KeyBinding{key_of(U'f'), false, Action::toggle_fullscreen, "F"},
    KeyBinding{Key::f11, false, Action::toggle_fullscreen, "F11"},
    KeyBinding{key_of(U'p'), false, Action::screenshot, "P"},
    KeyBinding{Key::f12, false, Action::screenshot, "F12"},
    KeyBinding{key_of(U'?'), false, Action::toggle_help, "?"},
    KeyBinding{Key::f1, false, Action::toggle_help, "F1"},
    KeyBinding{key_of(U'q'), false, Action::quit, "Q"},
    KeyBinding{Key::escape, false, Action::quit, "Esc"},
};

constexpr std::array<ActionHelp, kActionCount> kHelp = {{
    {Action::pause, ActionGroup::playing, "pause, go on"},
    {Action::seek_back, ActionGroup::playing, "back 5 s"},
    {Action::seek_forward, ActionGroup::playing, "forward 5 s"},
    {Action::seek_back_far, ActionGroup::playing, "back 30 s"},
    {Action::seek_forward_far, ActionGroup::playing, "forward 30 s"},
    {Action::next_file, ActionGroup::playing, "next file"},
    {Action::volume_up, ActionGroup::playing, "louder"},
    {Action::volume_down, ActionGroup::playing, "softer"},
    {Action::tap_tempo, ActionGroup::tempo, "tap the tempo"},
    {Action::half_tempo, ActionGroup::tempo, "half tempo"},
    {Action::double_tempo, ActionGroup::tempo, "double tempo"},
    {Action::next_figure, ActionGroup::dance, "another figure"},
    {Action::select_figure, ActionGroup::dance, "a figure"},
    {Action::keep_figure, ActionGroup::dance, "keep to the figure"},
    {Action::next_dance, ActionGroup::dance, "another dance"},
    {Action::toggle_figure_view, ActionGroup::view, "stick figure, avatar"},
    {Action::reset_camera, ActionGroup::view, "reset the camera"},
    {Action::toggle_overlay, ActionGroup::view, "hide, show this overlay"},
    {Action::toggle_fullscreen, ActionGroup::window, "full screen"},
    {Action::screenshot, ActionGroup::window, "save a picture"},
    {Action::toggle_help, ActionGroup::window, "these keys"},
    {Action::quit, ActionGroup::window, "quit"},
}};

constexpr bool has_character(Key key) { return key > Key::space && key < Key::escape; }

constexpr bool is_repeatable(Action action) {
    return action >= Action::seek_back && action <= Action::volume_down &&
           action != Action::next_file;
}

}  // namespace

std::span<const KeyBinding> key_bindings() noexcept { return kBindings; }

std::span<const ActionHelp> action_help() noexcept { return kHelp; }

int figure_of(Key key) noexcept { return static_cast<int>(key) - static_cast<int>(key_of(U'1')); }

std::optional<Action> action_of(const KeyEvent& event) noexcept {
    if (event.has_control) {
        return std::nullopt;
    }
    const auto matches = [&](const KeyBinding& binding) {
        return binding.key == event.key &&
               (has_character(event.key) || binding.has_shift == event.has_shift);
    };
    const auto* const found = std::find_if(kBindings.begin(), kBindings.end(), matches);
    if (found == kBindings.end() || (event.is_repeat && !is_repeatable(found->action))) {
        return std::nullopt;
    }
    return found->action;
}

}  // namespace raks::render
