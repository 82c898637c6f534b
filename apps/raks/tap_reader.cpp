#include "apps/raks/tap_reader.hpp"

#include <poll.h>
#include <unistd.h>

#include <array>

namespace raks::apps {

TapReader::TapReader() {
    termios now{};
    if (tcgetattr(STDIN_FILENO, &now) != 0) {
        return;  // no terminal
    }
    before_ = now;
    // Single keys, unseen; Ctrl-C still ends the program.
    now.c_lflag &= ~static_cast<tcflag_t>(ICANON | ECHO);
    tcsetattr(STDIN_FILENO, TCSANOW, &now);
}

TapReader::~TapReader() {
    if (before_) {
        // Keys that were pressed meanwhile are not for the shell.
        tcsetattr(STDIN_FILENO, TCSAFLUSH, &*before_);
    }
}

std::optional<HostTime> TapReader::wait(Nanos longest) {
    pollfd input{.fd = STDIN_FILENO, .events = POLLIN, .revents = 0};
    const auto ms = std::chrono::duration_cast<std::chrono::milliseconds>(longest).count();
    if (poll(&input, 1, static_cast<int>(ms)) <= 0) {
        return std::nullopt;
    }
    const HostTime pressed = HostClock::now();
    // Arrows and the like send several bytes at once.
    std::array<char, 64> bytes{};
    if (read(STDIN_FILENO, bytes.data(), bytes.size()) <= 0) {
        has_ended_ = true;
        return std::nullopt;
    }
    return pressed;
}

}  // namespace raks::apps
