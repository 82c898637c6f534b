#include "engine/setup/desktop_calm.hpp"

#include <dbus/dbus.h>

#include <algorithm>
#include <charconv>
#include <cstdlib>
#include <filesystem>
#include <memory>
#include <string>
#include <system_error>
#include <utility>

#include "base/file.hpp"
#include "engine/setup/settings.hpp"

namespace raks::engine {
namespace {

constexpr const char* kPortal = "org.freedesktop.portal.Desktop";
constexpr const char* kPortalObject = "/org/freedesktop/portal/desktop";
constexpr const char* kPortalSettings = "org.freedesktop.portal.Settings";
constexpr int kPortalPatienceMs = 200;  // of each of three questions, and to be let in
constexpr std::size_t kMostKdeglobals = std::size_t{1} << 20U;  // bytes

struct CloseBus {
    void operator()(DBusConnection* connection) const noexcept {
        dbus_connection_close(connection);
        dbus_connection_unref(connection);
    }
};
using Bus = std::unique_ptr<DBusConnection, CloseBus>;

struct FreeAnswer {
    void operator()(DBusMessage* message) const noexcept { dbus_message_unref(message); }
};
using Answer = std::unique_ptr<DBusMessage, FreeAnswer>;

// The answer; null: an error, or none in time.
Answer answer_of(const Bus& bus, const Answer& question) {
    return Answer(dbus_connection_send_with_reply_and_block(
        bus.get(), question.get(), kPortalPatienceMs, nullptr));
}

// Whether the bus lets us in, in time. Where a message is waited for, the library waits for this
// without end.
bool is_let_in(const Bus& bus) {
    constexpr int kLookMs = 20;
    for (int waited = 0; dbus_connection_get_is_authenticated(bus.get()) == 0; waited += kLookMs) {
        if (waited >= kPortalPatienceMs || dbus_connection_read_write(bus.get(), kLookMs) == 0) {
            return false;
        }
    }
    return true;
}

// A connection of our own to the bus of the session; null: there is none, or it refuses.
Bus open_session_bus() {
    // NOLINTNEXTLINE(concurrency-mt-unsafe): main, before others could set variables
    const char* const variable = std::getenv("DBUS_SESSION_BUS_ADDRESS");
    const std::string_view address = variable != nullptr ? variable : "";
    if (address.empty() || address.starts_with("autolaunch:")) {
        return nullptr;  // the library would start one
    }
    // dbus_bus_get_private() would wait for a bus that takes calls and does not answer.
    Bus bus(dbus_connection_open_private(variable, nullptr));
    if (!bus) {
        return nullptr;
    }
    dbus_connection_set_exit_on_disconnect(bus.get(), FALSE);
    if (!is_let_in(bus)) {
        return nullptr;
    }
    const Answer hello(dbus_message_new_method_call(
        DBUS_SERVICE_DBUS, DBUS_PATH_DBUS, DBUS_INTERFACE_DBUS, "Hello"));
    return hello && answer_of(bus, hello) ? std::move(bus) : nullptr;
}

// Null: the portal does not answer, or does not know this.
Answer ask_portal(const Bus& bus, const char* group, const char* key) {
    const Answer question(
        dbus_message_new_method_call(kPortal, kPortalObject, kPortalSettings, "Read"));
    if (!question ||
        dbus_message_append_args(
            question.get(), DBUS_TYPE_STRING, &group, DBUS_TYPE_STRING, &key, DBUS_TYPE_INVALID) ==
            0) {
        return nullptr;
    }
    return answer_of(bus, question);
}

// KDE writes numbers as text.
std::optional<double> number_of(std::string_view text) {
    double number = 0.0;
    const char* const end = text.data() + text.size();
    const auto [read, error] = std::from_chars(text.data(), end, number);
    return error == std::errc() && read == end ? std::optional(number) : std::nullopt;
}

// The value as a number: a truth value is 0 or 1. The portal wraps it in variants.
std::optional<double> value_of(const Answer& answer) {
    DBusMessageIter at;
    if (!answer || dbus_message_iter_init(answer.get(), &at) == 0) {
        return std::nullopt;
    }
    constexpr int kMostVariants = 4;
    for (int i = 0; i < kMostVariants && dbus_message_iter_get_arg_type(&at) == DBUS_TYPE_VARIANT;
         ++i) {
        DBusMessageIter inner;
        dbus_message_iter_recurse(&at, &inner);
        at = inner;
    }
    DBusBasicValue value{};
    switch (dbus_message_iter_get_arg_type(&at)) {
        case DBUS_TYPE_BOOLEAN:
            dbus_message_iter_get_basic(&at, &value);
            return value.bool_val != 0 ? 1.0 : 0.0;
        case DBUS_TYPE_INT32:
            dbus_message_iter_get_basic(&at, &value);
            return value.i32;
        case DBUS_TYPE_DOUBLE:
            dbus_message_iter_get_basic(&at, &value);
            return value.dbl;
        case DBUS_TYPE_STRING:
            dbus_message_iter_get_basic(&at, &value);
            return number_of(value.str);
        default:
            return std::nullopt;
    }
}

// Without the portal, which KDE has with a package of its own.
bool is_calm_by_file() {
    const std::filesystem::path settings = user_settings_path();
    if (settings.empty()) {
        return false;
    }
    // It lies beside the folder of our settings.
    const auto text =
        read_file(settings.parent_path().parent_path() / "kdeglobals", kMostKdeglobals);
    return text && calm_in_kdeglobals(*text).value_or(false);
}

std::string_view without_blanks(std::string_view text) {
    const std::size_t first = text.find_first_not_of(" \t\r");
    return first == std::string_view::npos
               ? std::string_view()
               : text.substr(first, text.find_last_not_of(" \t\r") + 1 - first);
}

}  // namespace

bool desktop_asks_for_calm() {
    if (const Bus bus = open_session_bus()) {
        const auto gnome =
            value_of(ask_portal(bus, "org.gnome.desktop.interface", "enable-animations"));
        const auto kde =
            value_of(ask_portal(bus, "org.kde.kdeglobals.KDE", "AnimationDurationFactor"));
        if (gnome || kde) {
            return gnome == 0.0 || kde == 0.0;
        }
    }
    return is_calm_by_file();
}

std::optional<bool> calm_in_kdeglobals(std::string_view text) {
    std::optional<bool> is_calm;
    bool is_group = false;
    while (!text.empty()) {
        const std::size_t end = std::min(text.find('\n'), text.size());
        const std::string_view line = without_blanks(text.substr(0, end));
        text.remove_prefix(std::min(end + 1, text.size()));
        if (line.starts_with('[')) {
            is_group = line == "[KDE]";
            continue;
        }
        const std::size_t equals = line.find('=');
        if (!is_group || equals == std::string_view::npos ||
            without_blanks(line.substr(0, equals)) != "AnimationDurationFactor") {
            continue;
        }
        if (const auto factor = number_of(without_blanks(line.substr(equals + 1)))) {
            is_calm = *factor == 0.0;
        }
    }
    return is_calm;
}

}  // namespace raks::engine
