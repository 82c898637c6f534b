#pragma once

#include <cstdint>

/// Keys of a keyboard by name: what a window reports and what a table of actions names.
namespace raks {

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
/// The key that types this character; upper-case ASCII letters become lower-case.
[[nodiscard]] constexpr Key key_of(char32_t character) noexcept {
    return static_cast<Key>(character >= U'A' && character <= U'Z' ? character - U'A' + U'a'
                                                                   : character);
}

/// A key was pressed, or repeats because it is held.
struct KeyEvent {
    Key key{};                 ///< which
    bool has_shift = false;    ///< shift is held
    bool has_control = false;  ///< control is held
    bool is_repeat = false;    ///< the key was held already
};

}  // namespace raks
