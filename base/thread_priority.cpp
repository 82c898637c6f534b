#include "base/thread_priority.hpp"

#include <pthread.h>
#include <sched.h>
#include <sys/resource.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <charconv>
#include <filesystem>
#include <fstream>
#include <string>
#include <system_error>

#include "base/realtime_kit.hpp"

namespace raks {
namespace {

// Below JACK's clients (5, where Debian starts the server at 10) and PulseAudio's server (5), and
// above everything that is ordinary. In the order of RealtimeThread.
constexpr std::array kPriorities = {1, 2, 3, 4};
constexpr std::array kNames = {
    "raks-outputs", "raks-motion", "raks-audio", "raks-transport"};  // likewise
// PulseAudio's own choice where real time is refused.
constexpr int kPreferredNice = -11;
constexpr int kBehindNice = 10;

}  // namespace

bool prefer_this_thread(RealtimeThread kind, int below) noexcept {
    pthread_setname_np(pthread_self(), kNames[static_cast<std::size_t>(kind)]);
    sched_param parameters{};
    parameters.sched_priority = std::min(kPriorities[static_cast<std::size_t>(kind)], below - 1);
    if (parameters.sched_priority < 1) {
        parameters.sched_priority = 0;
        // With the flag that RealtimeKit sets, which cannot be taken off.
        sched_setscheduler(gettid(), SCHED_OTHER | SCHED_RESET_ON_FORK, &parameters);
        return false;
    }
    return pthread_setschedparam(pthread_self(), SCHED_FIFO, &parameters) == 0 ||
           ask_realtime_kit(parameters.sched_priority) ||
           setpriority(PRIO_PROCESS, static_cast<id_t>(gettid()), kPreferredNice) == 0;
}

// Linux keeps a nice value for each thread, under the thread's number.
int put_threads_behind(std::string_view prefix) noexcept {
    int found = 0;
    std::error_code error;
    for (std::filesystem::directory_iterator task("/proc/self/task", error), end;
         !error && task != end;
         task.increment(error)) {
        const std::string number = task->path().filename().string();
        std::string name;
        std::getline(std::ifstream(task->path() / "comm"), name);
        id_t thread = 0;
        const auto parsed = std::from_chars(number.data(), number.data() + number.size(), thread);
        if (name.starts_with(prefix) && parsed.ec == std::errc() &&
            setpriority(PRIO_PROCESS, thread, kBehindNice) == 0) {
            ++found;
        }
    }
    return found;
}

}  // namespace raks
