#include "base/realtime_kit.hpp"

#include <dbus/dbus.h>
#include <sched.h>
#include <sys/resource.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <atomic>
#include <csignal>
#include <memory>
#include <mutex>
#include <optional>

namespace raks {
namespace {

constexpr const char* kService = "org.freedesktop.RealtimeKit1";
constexpr const char* kObject = "/org/freedesktop/RealtimeKit1";
constexpr int kPatienceMs = 300;  // of a question

struct CloseConnection {
    void operator()(DBusConnection* connection) const noexcept {
        dbus_connection_close(connection);
        dbus_connection_unref(connection);
    }
};
using Connection = std::unique_ptr<DBusConnection, CloseConnection>;

struct FreeMessage {
    void operator()(DBusMessage* message) const noexcept { dbus_message_unref(message); }
};
using Message = std::unique_ptr<DBusMessage, FreeMessage>;

// A connection of our own to the bus of the system; null: there is none, or it refuses.
Connection open_system_bus() {
    DBusConnection* const connection = dbus_bus_get_private(DBUS_BUS_SYSTEM, nullptr);
    if (connection != nullptr) {
        // By default the library ends the process when the bus goes.
        dbus_connection_set_exit_on_disconnect(connection, FALSE);
    }
    return Connection(connection);
}

// Null: no answer, or an error.
Message answer_to(const Connection& bus, const Message& question) {
    return Message(
        dbus_connection_send_with_reply_and_block(bus.get(), question.get(), kPatienceMs, nullptr));
}

// A whole number of RealtimeKit's; nothing where it does not answer.
std::optional<std::int64_t> property(const Connection& bus, const char* name) {
    const Message question(
        dbus_message_new_method_call(kService, kObject, "org.freedesktop.DBus.Properties", "Get"));
    if (!question || dbus_message_append_args(question.get(),
                                              DBUS_TYPE_STRING,
                                              &kService,
                                              DBUS_TYPE_STRING,
                                              &name,
                                              DBUS_TYPE_INVALID) == 0) {
        return std::nullopt;
    }
    const Message answer = answer_to(bus, question);
    DBusMessageIter outer;
    if (!answer || dbus_message_iter_init(answer.get(), &outer) == 0 ||
        dbus_message_iter_get_arg_type(&outer) != DBUS_TYPE_VARIANT) {
        return std::nullopt;
    }
    DBusMessageIter value;
    dbus_message_iter_recurse(&outer, &value);
    if (dbus_message_iter_get_arg_type(&value) == DBUS_TYPE_INT32) {
        dbus_int32_t number = 0;
        dbus_message_iter_get_basic(&value, &number);
        return number;
    }
    if (dbus_message_iter_get_arg_type(&value) == DBUS_TYPE_INT64) {
        dbus_int64_t number = 0;
        dbus_message_iter_get_basic(&value, &number);
        return number;
    }
    return std::nullopt;
}

// Threads that were granted a priority, for the handler; 0: a free place. A program has three.
std::array<std::atomic<pid_t>, 16> granted;

// The computing time of a thread has nearly reached its bound, at which the process would be ended.
extern "C" void become_ordinary(int) {
    const sched_param ordinary{};
    for (std::atomic<pid_t>& thread : granted) {
        if (const pid_t id = thread.load(std::memory_order_relaxed); id != 0) {
            // RealtimeKit sets the flag, and only who has the right may take it off.
            sched_setscheduler(id, SCHED_OTHER | SCHED_RESET_ON_FORK, &ordinary);
        }
    }
}

void remember(pid_t thread) noexcept {
    for (std::atomic<pid_t>& place : granted) {
        pid_t free = 0;
        if (place.load(std::memory_order_relaxed) == thread ||
            place.compare_exchange_strong(free, thread, std::memory_order_relaxed)) {
            return;
        }
    }
}

// The bound that RealtimeKit wants, with room below it for the handler. False: refused.
bool bound_computing(std::int64_t most_microseconds) noexcept {
    rlimit limit{};
    if (getrlimit(RLIMIT_RTTIME, &limit) != 0) {
        return false;
    }
    limit.rlim_max = std::min(limit.rlim_max, static_cast<rlim_t>(most_microseconds));
    limit.rlim_cur = std::min(limit.rlim_cur, limit.rlim_max / 4 * 3);
    struct sigaction action {};
    action.sa_handler = become_ordinary;
    action.sa_flags = SA_RESTART;
    return sigaction(SIGXCPU, &action, nullptr) == 0 && setrlimit(RLIMIT_RTTIME, &limit) == 0;
}

}  // namespace

bool ask_realtime_kit(int priority) noexcept {
    // One question at a time; a program asks when its threads begin.
    static std::mutex mutex;
    const std::lock_guard lock(mutex);
    const Connection bus = open_system_bus();
    if (!bus) {
        return false;
    }
    const auto most_microseconds = property(bus, "RTTimeUSecMax");
    const auto most_priority = property(bus, "MaxRealtimePriority");
    if (!most_microseconds || *most_microseconds <= 0 || !most_priority || *most_priority < 1 ||
        !bound_computing(*most_microseconds)) {
        return false;
    }
    const auto process = static_cast<dbus_uint64_t>(getpid());
    const auto thread = static_cast<dbus_uint64_t>(gettid());
    const auto wanted =
        static_cast<dbus_uint32_t>(std::min<std::int64_t>(priority, *most_priority));
    const Message question(
        dbus_message_new_method_call(kService, kObject, kService, "MakeThreadRealtimeWithPID"));
    if (!question || dbus_message_append_args(question.get(),
                                              DBUS_TYPE_UINT64,
                                              &process,
                                              DBUS_TYPE_UINT64,
                                              &thread,
                                              DBUS_TYPE_UINT32,
                                              &wanted,
                                              DBUS_TYPE_INVALID) == 0) {
        return false;
    }
    // Before it may be needed.
    remember(gettid());
    return answer_to(bus, question) != nullptr;
}

}  // namespace raks
