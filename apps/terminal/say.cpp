#include "apps/terminal/say.hpp"

#include <unistd.h>

#include <cstdio>
#include <utility>

#include "base/printable.hpp"
#include "base/time.hpp"

#include <fmt/format.h>

namespace raks::apps {

void say(std::string_view line) { std::fprintf(stderr, "raks: %s\n", printable(line).c_str()); }

namespace {
// At most five updates a second: writing to a terminal is slow.
constexpr double kSecondsBetween = 0.2;
}  // namespace

ProgressLine::ProgressLine(std::string what)
    : what_(printable(what, 60)), is_terminal_(isatty(STDERR_FILENO) == 1) {}

ProgressLine::~ProgressLine() {
    if (has_shown_) {
        std::fputs("\r\033[K", stderr);
    }
}

void ProgressLine::show(double share) { show(fmt::format("{:3.0f} %", 100.0 * share)); }

void ProgressLine::show(const std::string& text) {
    // Updates in between are dropped, not queued: the next one is newer.
    const double now = to_seconds(Nanos(HostClock::now().time_since_epoch()));
    if (!is_terminal_ || now - last_seconds_ < kSecondsBetween) {
        return;
    }
    last_seconds_ = now;
    has_shown_ = true;
    std::fprintf(stderr, "\r\033[K%s %s", what_.c_str(), text.c_str());
    std::fflush(stderr);
}

}  // namespace raks::apps
