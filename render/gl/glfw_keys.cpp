#include "render/gl/glfw_keys.hpp"

// OpenGL comes from epoxy, which other sources include.
#define GLFW_INCLUDE_NONE
#include <GLFW/glfw3.h>

#include <algorithm>
#include <array>
#include <utility>

namespace raks::render {
namespace {

// Keys without a character, and those whose character means a key: the rest arrive as characters.
constexpr std::array kNamedKeys = {
    std::pair{GLFW_KEY_SPACE, Key::space},     std::pair{GLFW_KEY_ESCAPE, Key::escape},
    std::pair{GLFW_KEY_ENTER, Key::enter},     std::pair{GLFW_KEY_KP_ENTER, Key::enter},
    std::pair{GLFW_KEY_TAB, Key::tab},         std::pair{GLFW_KEY_BACKSPACE, Key::backspace},
    std::pair{GLFW_KEY_LEFT, Key::left},       std::pair{GLFW_KEY_RIGHT, Key::right},
    std::pair{GLFW_KEY_UP, Key::up},           std::pair{GLFW_KEY_DOWN, Key::down},
    std::pair{GLFW_KEY_HOME, Key::home},       std::pair{GLFW_KEY_END, Key::end},
    std::pair{GLFW_KEY_PAGE_UP, Key::page_up}, std::pair{GLFW_KEY_PAGE_DOWN, Key::page_down},
    std::pair{GLFW_KEY_F1, Key::f1},           std::pair{GLFW_KEY_F2, Key::f2},
    std::pair{GLFW_KEY_F3, Key::f3},           std::pair{GLFW_KEY_F4, Key::f4},
    std::pair{GLFW_KEY_F5, Key::f5},           std::pair{GLFW_KEY_F6, Key::f6},
    std::pair{GLFW_KEY_F7, Key::f7},           std::pair{GLFW_KEY_F8, Key::f8},
    std::pair{GLFW_KEY_F9, Key::f9},           std::pair{GLFW_KEY_F10, Key::f10},
    std::pair{GLFW_KEY_F11, Key::f11},         std::pair{GLFW_KEY_F12, Key::f12},
};

}  // namespace

std::optional<Key> named_key(int glfw_key) {
    const auto* const found =
        std::find_if(kNamedKeys.begin(), kNamedKeys.end(), [&](const auto& pair) {
            return pair.first == glfw_key;
        });
    return found != kNamedKeys.end() ? std::optional(found->second) : std::nullopt;
}

}  // namespace raks::render
