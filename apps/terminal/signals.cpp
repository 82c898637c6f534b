#include "apps/terminal/signals.hpp"

#include <atomic>
#include <csignal>

namespace raks::apps {
namespace {

std::atomic<int> g_signal{0};
static_assert(std::atomic<int>::is_always_lock_free, "used inside a signal handler");

extern "C" void note_signal(int number) {
    g_signal.store(number, std::memory_order_relaxed);  // relaxed: a flag that orders nothing
    std::signal(number, SIG_DFL);                       // the next one ends the process
}

}  // namespace

// SIGXFSZ and SIGPIPE are ignored, so that the write that caused them fails with an error that is
// reported.
void catch_signals() noexcept {
    std::signal(SIGINT, note_signal);
    std::signal(SIGTERM, note_signal);
    std::signal(SIGXFSZ, SIG_IGN);
    std::signal(SIGPIPE, SIG_IGN);
}

std::optional<int> stop_signal() noexcept {
    const int number = g_signal.load(std::memory_order_relaxed);  // relaxed: see note_signal
    return number == 0 ? std::nullopt : std::optional(number);
}

// The convention of shells for a process that a signal ended.
int exit_code_after_signals(int code) noexcept {
    const std::optional<int> number = stop_signal();
    return number ? 128 + *number : code;
}

}  // namespace raks::apps
