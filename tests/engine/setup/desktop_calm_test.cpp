#include "engine/setup/desktop_calm.hpp"

#include <dbus/dbus.h>
#include <gtest/gtest.h>
#include <sys/socket.h>
#include <sys/un.h>
#include <unistd.h>

#include <atomic>
#include <chrono>
#include <csignal>
#include <cstdlib>
#include <map>
#include <memory>
#include <optional>
#include <string>
#include <thread>
#include <utility>
#include <variant>

#include "base/pending_file.hpp"
#include "tests/support/child_process.hpp"
#include "tests/support/temporary_folder.hpp"

namespace raks::engine {
namespace {

TEST(CalmInKdeglobals, is_a_duration_factor_of_nothing) {
    const struct {
        const char* text;
        std::optional<bool> is_calm;
    } cases[] = {
        {"", std::nullopt},
        {"[KDE]\nAnimationDurationFactor=0\n", true},
        {"[KDE]\r\nAnimationDurationFactor = 0.0\r\n", true},
        {"[General]\nx=1\n[KDE]\nAnimationDurationFactor=0", true},
        {"[KDE]\nAnimationDurationFactor=0.5\n", false},
        {"[Other]\nAnimationDurationFactor=0\n", std::nullopt},
        {"[KDE]\n#AnimationDurationFactor=0\n", std::nullopt},
        {"[KDE]\nAnimationDurationFactor=\n", std::nullopt},
        {"[KDE]\nAnimationDurationFactor=none\n", std::nullopt},
        {"[KDE]\nAnimationDurationFactor=0\nAnimationDurationFactor=1\n", false},
        {"\n=\n[\n]\n[KDE]", std::nullopt},
    };
    for (const auto& c : cases) {
        EXPECT_EQ(calm_in_kdeglobals(c.text), c.is_calm) << c.text;
    }
}

/// Sets a variable of the environment for as long as it lives.
class Variable {
 public:
    Variable(const char* name, const std::string& value) : name_(name) {
        // NOLINTBEGIN(concurrency-mt-unsafe): no other thread reads them
        if (const char* const before = std::getenv(name)) {
            before_ = before;
        }
        value.empty() ? unsetenv(name) : setenv(name, value.c_str(), 1);
    }
    ~Variable() { before_ ? setenv(name_, before_->c_str(), 1) : unsetenv(name_); }
    // NOLINTEND(concurrency-mt-unsafe)
    Variable(const Variable&) = delete;
    Variable& operator=(const Variable&) = delete;

 private:
    const char* name_;
    std::optional<std::string> before_;
};

/// What the portal says of "GROUP KEY".
using PortalValues = std::map<std::string, std::variant<bool, double, std::string>>;

/// A bus of the test's own in the place of the session's, and a portal of settings on it.
class Portal {
 public:
    enum class Answers { all, none };

    explicit Portal(PortalValues values, Answers answers = Answers::all)
        : address_("unix:abstract=raks-calm-bus-" + std::to_string(getpid())),
          variable_("DBUS_SESSION_BUS_ADDRESS", address_),
          values_(std::move(values)),
          answers_(answers) {
        EXPECT_TRUE(write_file(folder_ / "bus.conf",
                               "<busconfig><type>session</type><listen>" + address_ +
                                   "</listen><auth>EXTERNAL</auth><policy context=\"default\">"
                                   "<allow user=\"*\"/><allow own=\"*\"/>"
                                   "<allow send_destination=\"*\"/><allow receive_sender=\"*\"/>"
                                   "</policy></busconfig>"));
        daemon_ = std::make_unique<test::ChildProcess>(
            std::vector<std::string>{
                "dbus-daemon", "--nofork", "--config-file=" + (folder_ / "bus.conf").string()},
            "/dev/null");
        for (int attempt = 0; attempt < 500 && bus_ == nullptr; ++attempt) {
            bus_ = dbus_bus_get_private(DBUS_BUS_SESSION, nullptr);
            if (bus_ == nullptr) {
                std::this_thread::sleep_for(std::chrono::milliseconds(10));
            }
        }
        EXPECT_NE(bus_, nullptr) << "dbus-daemon does not start (is the package dbus installed?)";
        if (bus_ != nullptr) {
            dbus_connection_set_exit_on_disconnect(bus_, FALSE);
            dbus_bus_request_name(bus_, "org.freedesktop.portal.Desktop", 0, nullptr);
            thread_ = std::thread([this] { run(); });
        }
    }
    ~Portal() {
        is_stopping_ = true;
        if (thread_.joinable()) {
            thread_.join();
            dbus_connection_close(bus_);
            dbus_connection_unref(bus_);
        }
        daemon_->end(SIGTERM);
    }
    Portal(const Portal&) = delete;
    Portal& operator=(const Portal&) = delete;

 private:
    void run() {
        while (!is_stopping_ && dbus_connection_read_write(bus_, 20) != 0) {
            while (DBusMessage* const message = dbus_connection_pop_message(bus_)) {
                if (dbus_message_get_type(message) == DBUS_MESSAGE_TYPE_METHOD_CALL &&
                    answers_ == Answers::all) {
                    DBusMessage* const answer = answer_to(message);
                    dbus_connection_send(bus_, answer, nullptr);
                    dbus_connection_flush(bus_);
                    dbus_message_unref(answer);
                }
                dbus_message_unref(message);
            }
        }
    }

    DBusMessage* answer_to(DBusMessage* message) const {
        const char* group = "";
        const char* key = "";
        dbus_message_get_args(
            message, nullptr, DBUS_TYPE_STRING, &group, DBUS_TYPE_STRING, &key, DBUS_TYPE_INVALID);
        const auto found = values_.find(std::string(group) + " " + key);
        if (found == values_.end()) {
            return dbus_message_new_error(
                message, "org.freedesktop.portal.Error.NotFound", "no such setting");
        }
        DBusMessage* const answer = dbus_message_new_method_return(message);
        DBusMessageIter at;
        dbus_message_iter_init_append(answer, &at);
        std::visit([&](const auto& value) { append(&at, value); }, found->second);
        return answer;
    }
    // As the portal does: a variant in a variant.
    static void append(DBusMessageIter* at, bool value) {
        const dbus_bool_t plain = value ? TRUE : FALSE;
        append(at, DBUS_TYPE_BOOLEAN_AS_STRING, DBUS_TYPE_BOOLEAN, &plain);
    }
    static void append(DBusMessageIter* at, double value) {
        append(at, DBUS_TYPE_DOUBLE_AS_STRING, DBUS_TYPE_DOUBLE, &value);
    }
    static void append(DBusMessageIter* at, const std::string& value) {
        const char* const text = value.c_str();
        append(at, DBUS_TYPE_STRING_AS_STRING, DBUS_TYPE_STRING, &text);
    }
    static void append(DBusMessageIter* at, const char* name, int type, const void* value) {
        DBusMessageIter outer;
        DBusMessageIter inner;
        dbus_message_iter_open_container(at, DBUS_TYPE_VARIANT, "v", &outer);
        dbus_message_iter_open_container(&outer, DBUS_TYPE_VARIANT, name, &inner);
        dbus_message_iter_append_basic(&inner, type, value);
        dbus_message_iter_close_container(&outer, &inner);
        dbus_message_iter_close_container(at, &outer);
    }

    test::TemporaryFolder folder_;
    std::string address_;
    Variable variable_;
    PortalValues values_;
    Answers answers_;
    std::unique_ptr<test::ChildProcess> daemon_;
    DBusConnection* bus_ = nullptr;
    std::atomic<bool> is_stopping_{false};
    std::thread thread_;
};

const std::string kGnome = "org.gnome.desktop.interface enable-animations";
const std::string kKde = "org.kde.kdeglobals.KDE AnimationDurationFactor";

/// A person's folder of settings, with a kdeglobals file.
class CalmDesktop : public ::testing::Test {
 protected:
    void write_kdeglobals(const std::string& factor) const {
        ASSERT_TRUE(
            write_file(folder_ / "kdeglobals", "[KDE]\nAnimationDurationFactor=" + factor + "\n"));
    }

    test::TemporaryFolder folder_;
    Variable config_{"XDG_CONFIG_HOME", folder_.path().string()};
    Variable bus_{"DBUS_SESSION_BUS_ADDRESS", ""};
};

TEST_F(CalmDesktop, is_asked_for_by_the_file_where_there_is_no_bus) {
    EXPECT_FALSE(desktop_asks_for_calm());
    write_kdeglobals("0");
    EXPECT_TRUE(desktop_asks_for_calm());
    write_kdeglobals("1");
    EXPECT_FALSE(desktop_asks_for_calm());
    write_kdeglobals("0");
    for (const char* address : {"unix:path=/nowhere/at/all", "autolaunch:", "nonsense"}) {
        const Variable bus("DBUS_SESSION_BUS_ADDRESS", address);
        EXPECT_TRUE(desktop_asks_for_calm()) << address;
    }
}

// libdbus by itself would wait without end.
TEST_F(CalmDesktop, does_not_wait_for_a_bus_that_takes_calls_and_does_not_answer) {
    write_kdeglobals("0");
    const std::string path = (folder_ / "bus").string();
    sockaddr_un address{};
    address.sun_family = AF_UNIX;
    ASSERT_LT(path.size(), sizeof address.sun_path);
    path.copy(static_cast<char*>(address.sun_path), path.size());
    const int bus = ::socket(AF_UNIX, SOCK_STREAM | SOCK_CLOEXEC, 0);
    ASSERT_EQ(::bind(bus, reinterpret_cast<const sockaddr*>(&address), sizeof address), 0);
    ASSERT_EQ(::listen(bus, 5), 0);
    const Variable variable("DBUS_SESSION_BUS_ADDRESS", "unix:path=" + path);
    EXPECT_TRUE(desktop_asks_for_calm()) << "the file says so";
    ::close(bus);
}

TEST_F(CalmDesktop, is_asked_for_by_the_portal) {
    const struct {
        PortalValues values;
        bool is_calm;
    } cases[] = {
        {{{kGnome, false}}, true},
        {{{kGnome, true}}, false},
        {{{kKde, std::string("0")}}, true},
        {{{kKde, 0.0}}, true},
        {{{kKde, std::string("1.5")}}, false},
        {{{kGnome, true}, {kKde, std::string("0")}}, true},
        {{{kGnome, std::string("broken")}}, false},
    };
    for (const auto& c : cases) {
        const Portal portal(c.values);
        EXPECT_EQ(desktop_asks_for_calm(), c.is_calm) << &c - cases;
    }
}

TEST_F(CalmDesktop, is_asked_for_by_the_file_where_the_portal_does_not_know) {
    write_kdeglobals("0");
    {
        const Portal portal({});
        EXPECT_TRUE(desktop_asks_for_calm());
    }
    {
        const Portal portal({{kGnome, true}}, Portal::Answers::none);
        EXPECT_TRUE(desktop_asks_for_calm()) << "it is not waited for";
    }
    const Portal portal({{kGnome, true}});
    EXPECT_FALSE(desktop_asks_for_calm()) << "what the portal says counts";
}

}  // namespace
}  // namespace raks::engine
