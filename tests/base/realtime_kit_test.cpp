#include "base/realtime_kit.hpp"

#include <dbus/dbus.h>
#include <gtest/gtest.h>
#include <pthread.h>
#include <sched.h>
#include <sys/resource.h>
#include <sys/syscall.h>
#include <unistd.h>

#include <atomic>
#include <csignal>
#include <cstdlib>
#include <memory>
#include <string>
#include <thread>

#include "base/pending_file.hpp"
#include "base/thread_priority.hpp"
#include "tests/support/child_process.hpp"
#include "tests/support/temporary_folder.hpp"

namespace raks {
namespace {

constexpr const char* kService = "org.freedesktop.RealtimeKit1";
constexpr uid_t kNobody = 65'534;

/// A bus of the test's own in the place of the system's.
class BusOfTheTest {
 public:
    BusOfTheTest() {
        const std::string address = "unix:abstract=raks-test-bus-" + std::to_string(getpid());
        EXPECT_TRUE(write_file(folder_ / "bus.conf",
                               "<busconfig><type>system</type><listen>" + address +
                                   "</listen><auth>EXTERNAL</auth><policy context=\"default\">"
                                   "<allow user=\"*\"/><allow own=\"*\"/>"
                                   "<allow send_destination=\"*\"/><allow receive_sender=\"*\"/>"
                                   "</policy></busconfig>"));
        setenv("DBUS_SYSTEM_BUS_ADDRESS", address.c_str(), 1);  // NOLINT(concurrency-mt-unsafe)
        daemon_ = std::make_unique<test::ChildProcess>(
            std::vector<std::string>{
                "dbus-daemon", "--nofork", "--config-file=" + (folder_ / "bus.conf").string()},
            "/dev/null");
    }
    ~BusOfTheTest() { daemon_->end(SIGTERM); }
    BusOfTheTest(const BusOfTheTest&) = delete;
    BusOfTheTest& operator=(const BusOfTheTest&) = delete;

    /// Null: the daemon does not come up (5 s).
    static DBusConnection* connect() {
        for (int attempt = 0; attempt < 500; ++attempt) {
            if (DBusConnection* const bus = dbus_bus_get_private(DBUS_BUS_SYSTEM, nullptr)) {
                dbus_connection_set_exit_on_disconnect(bus, FALSE);
                return bus;
            }
            std::this_thread::sleep_for(std::chrono::milliseconds(10));
        }
        return nullptr;
    }

 private:
    test::TemporaryFolder folder_;
    std::unique_ptr<test::ChildProcess> daemon_;
};

/// RealtimeKit's place on the bus: answers as rtkit-daemon does, and really gives the priority,
/// which it may since it has the right.
class RealtimeKit {
 public:
    RealtimeKit() : bus_(BusOfTheTest::connect()) {
        EXPECT_NE(bus_, nullptr) << "dbus-daemon does not start (is the package dbus installed?)";
        if (bus_ != nullptr) {
            dbus_bus_request_name(bus_, kService, 0, nullptr);
            thread_ = std::thread([this] { run(); });
        }
    }
    ~RealtimeKit() {
        is_stopping_ = true;
        if (thread_.joinable()) {
            thread_.join();
            dbus_connection_close(bus_);
            dbus_connection_unref(bus_);
        }
    }
    RealtimeKit(const RealtimeKit&) = delete;
    RealtimeKit& operator=(const RealtimeKit&) = delete;

 private:
    void run() {
        while (!is_stopping_ && dbus_connection_read_write(bus_, 20) != 0) {
            while (DBusMessage* const message = dbus_connection_pop_message(bus_)) {
                if (dbus_message_get_type(message) == DBUS_MESSAGE_TYPE_METHOD_CALL) {
                    DBusMessage* const answer = answer_to(message);
                    dbus_connection_send(bus_, answer, nullptr);
                    dbus_connection_flush(bus_);
                    dbus_message_unref(answer);
                }
                dbus_message_unref(message);
            }
        }
    }

    static DBusMessage* answer_to(DBusMessage* message) {
        if (dbus_message_has_member(message, "Get") != 0) {
            return property_of(message);
        }
        dbus_uint64_t process = 0;
        dbus_uint64_t thread = 0;
        dbus_uint32_t priority = 0;
        rlimit limit{};
        getrlimit(RLIMIT_RTTIME, &limit);
        const bool is_asked_well = dbus_message_get_args(message,
                                                         nullptr,
                                                         DBUS_TYPE_UINT64,
                                                         &process,
                                                         DBUS_TYPE_UINT64,
                                                         &thread,
                                                         DBUS_TYPE_UINT32,
                                                         &priority,
                                                         DBUS_TYPE_INVALID) != 0 &&
                                   process == static_cast<dbus_uint64_t>(getpid()) &&
                                   limit.rlim_max <= 200'000;
        sched_param parameters{};
        parameters.sched_priority = static_cast<int>(priority);
        const bool is_granted = is_asked_well && sched_setscheduler(static_cast<pid_t>(thread),
                                                                    SCHED_RR | SCHED_RESET_ON_FORK,
                                                                    &parameters) == 0;
        return is_granted ? dbus_message_new_method_return(message)
                          : dbus_message_new_error(message, DBUS_ERROR_ACCESS_DENIED, "refused");
    }

    static DBusMessage* property_of(DBusMessage* message) {
        const char* interface = nullptr;
        const char* name = nullptr;
        dbus_message_get_args(message,
                              nullptr,
                              DBUS_TYPE_STRING,
                              &interface,
                              DBUS_TYPE_STRING,
                              &name,
                              DBUS_TYPE_INVALID);
        DBusMessage* const answer = dbus_message_new_method_return(message);
        DBusMessageIter outer;
        DBusMessageIter value;
        dbus_message_iter_init_append(answer, &outer);
        // rtkit-daemon's own values and types.
        if (std::string(name) == "RTTimeUSecMax") {
            const dbus_int64_t microseconds = 200'000;
            dbus_message_iter_open_container(&outer, DBUS_TYPE_VARIANT, "x", &value);
            dbus_message_iter_append_basic(&value, DBUS_TYPE_INT64, &microseconds);
        } else {
            const dbus_int32_t priority = 20;
            dbus_message_iter_open_container(&outer, DBUS_TYPE_VARIANT, "i", &value);
            dbus_message_iter_append_basic(&value, DBUS_TYPE_INT32, &priority);
        }
        dbus_message_iter_close_container(&outer, &value);
        return answer;
    }

    DBusConnection* bus_;
    std::atomic<bool> is_stopping_{false};
    std::thread thread_;
};

/// Class and priority of the calling thread, without the flag that its children do not have it.
std::pair<int, int> scheduling() {
    sched_param parameters{};
    const int policy = sched_getscheduler(0) & ~SCHED_RESET_ON_FORK;
    sched_getparam(0, &parameters);
    return {policy, parameters.sched_priority};
}

/// Runs `work` on a thread of a person who has no rights. (glibc's own setresuid would change all
/// threads.)
template <typename Work>
void without_rights(const Work& work) {
    std::thread([&work] {
        const rlimit none{};
        setrlimit(RLIMIT_RTPRIO, &none);
        syscall(SYS_setresuid, kNobody, kNobody, kNobody);
        work();
    }).join();
}

TEST(RealtimeKit, gives_priority_to_a_thread_without_the_right) {
    if (geteuid() != 0) {
        GTEST_SKIP() << "who answers for RealtimeKit here must be root";
    }
    const BusOfTheTest bus;
    const RealtimeKit kit;
    without_rights([] {
        EXPECT_TRUE(prefer_this_thread(RealtimeThread::callback));
        EXPECT_EQ(scheduling(), std::pair(SCHED_RR, 3));
        // What comes when it computes without a pause: instead of the end of the program.
        raise(SIGXCPU);
        EXPECT_EQ(scheduling(), std::pair(SCHED_OTHER, 0));
        EXPECT_TRUE(prefer_this_thread(RealtimeThread::callback));
        EXPECT_FALSE(prefer_this_thread(RealtimeThread::callback, 1));
        EXPECT_EQ(scheduling(), std::pair(SCHED_OTHER, 0)) << "below a thread of the lowest";
    });
}

TEST(RealtimeKit, where_it_does_not_answer_the_thread_stays_as_it_is) {
    const BusOfTheTest bus;
    DBusConnection* const connection = BusOfTheTest::connect();
    ASSERT_NE(connection, nullptr);
    EXPECT_FALSE(ask_realtime_kit(3)) << "a bus without the service";
    dbus_connection_close(connection);
    dbus_connection_unref(connection);
    setenv("DBUS_SYSTEM_BUS_ADDRESS", "unix:path=/nowhere", 1);  // NOLINT(concurrency-mt-unsafe)
    EXPECT_FALSE(ask_realtime_kit(3)) << "no bus";
    EXPECT_EQ(scheduling().first, SCHED_OTHER);
}

}  // namespace
}  // namespace raks
