#include "render/gl/display_loss.hpp"

#include <dlfcn.h>
#include <poll.h>

#include <atomic>

// Of Xlib, whose headers name as macros what others name as values.
struct _XDisplay;  // NOLINT(bugprone-reserved-identifier): its name

namespace raks::render {
namespace {

using XDisplay = _XDisplay;
using ErrorHandler = int (*)(XDisplay*);
using ExitHandler = void (*)(XDisplay*, void*);

std::atomic<bool> g_is_lost{false};
std::atomic<int> g_connection{-1};  // to the display's server; < 0: nobody asks

// Whether the server has closed its end. Drivers that find it out by themselves may not survive it.
bool has_hung_up() noexcept {
    pollfd connection{g_connection.load(std::memory_order_relaxed), 0, 0};
    return connection.fd >= 0 && ::poll(&connection, 1, 0) > 0 &&
           (connection.revents & (POLLHUP | POLLERR | POLLNVAL)) != 0;
}

template <typename Function>
Function function_of(void* library, const char* name) noexcept {
    return reinterpret_cast<Function>(::dlsym(library, name));
}

}  // namespace

void outlive_display() noexcept {
    // GLFW has loaded it, where it is used at all.
    void* const xlib = ::dlopen("libX11.so.6", RTLD_LAZY | RTLD_NOLOAD);
    if (xlib == nullptr) {
        return;
    }
    const auto display_of_glfw = function_of<XDisplay* (*)()>(RTLD_DEFAULT, "glfwGetX11Display");
    const auto set_error_handler =
        function_of<ErrorHandler (*)(ErrorHandler)>(xlib, "XSetIOErrorHandler");
    const auto set_exit_handler =
        function_of<void (*)(XDisplay*, ExitHandler, void*)>(xlib, "XSetIOErrorExitHandler");
    XDisplay* const display = display_of_glfw != nullptr ? display_of_glfw() : nullptr;
    if (display != nullptr && set_error_handler != nullptr && set_exit_handler != nullptr) {
        // The first would print, the second would end the process. After both every call of Xlib
        // for this display does nothing.
        set_error_handler([](XDisplay*) { return 0; });
        set_exit_handler(
            display,
            [](XDisplay*, void*) { g_is_lost.store(true, std::memory_order_relaxed); },
            nullptr);
        const auto connection_of = function_of<int (*)(XDisplay*)>(xlib, "XConnectionNumber");
        g_connection.store(connection_of != nullptr ? connection_of(display) : -1,
                           std::memory_order_relaxed);
    }
    ::dlclose(xlib);
}

// relaxed: a flag that orders nothing
bool is_display_lost() noexcept {
    if (!g_is_lost.load(std::memory_order_relaxed) && has_hung_up()) {
        g_is_lost.store(true, std::memory_order_relaxed);
    }
    return g_is_lost.load(std::memory_order_relaxed);
}

}  // namespace raks::render
