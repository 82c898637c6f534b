#pragma once

#include <cstdint>
#include <string>
#include <variant>
#include <vector>

namespace raks::render {

/// A key as the person sees it: a printable character of the keyboard's own layout (letters in
/// lower case, so `Key{'['}` works on keyboards where it needs AltGr), or a named key.
enum class Key : std::uint32_t {
    space = ' ',
    escape = 0x110000,  // past Unicode
    enter,
    tab,
    backspace,
    left,
    right,
    up,
    down,
    home,
    end,
    page_up,
    page_down,
    f1,
    f2,
    f3,
    f4,
    f5,
    f6,
    f7,
    f8,
    f9,
    f10,
    f11,
    f12,
};
[[nodiscard]] constexpr Key key_of(char32_t character) noexcept {
    return static_cast<Key>(character >= U'A' && character <= U'Z' ? character - U'A' + U'a'
                                                                   : character);
}

/// A key went down, or repeats because it is held.
struct KeyEvent {
    Key key{};
    bool has_shift = false;
    bool has_control = false;
    bool is_repeat = false;
};

enum class MouseButton : std::uint8_t { left, right, middle };

/// A button went down or up at (x, y): framebuffer pixels, origin at the top left.
struct MouseButtonEvent {
    MouseButton button{};
    bool is_down = false;
    float x = 0.0F;
    float y = 0.0F;
};

/// The mouse moved by (dx, dy) pixels with `button` held: orbit, pan.
struct MouseDragEvent {
    MouseButton button{};
    bool has_shift = false;
    float dx = 0.0F;
    float dy = 0.0F;
};

/// Steps of the wheel; up and right are positive.
struct ScrollEvent {
    float dx = 0.0F;
    float dy = 0.0F;
};

/// Files were dropped on the window.
struct DropEvent {
    std::vector<std::string> paths;
};

using WindowEvent =
    std::variant<KeyEvent, MouseButtonEvent, MouseDragEvent, ScrollEvent, DropEvent>;

}  // namespace raks::render
