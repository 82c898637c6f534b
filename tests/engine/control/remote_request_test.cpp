#include "engine/control/remote_request.hpp"

#include <gtest/gtest.h>

#include <chrono>
#include <string>
#include <vector>

namespace raks::engine {
namespace {

const HostTime kCame = HostTime(std::chrono::seconds(77));

std::string fault_of(std::string_view name, std::string_view value) {
    const auto request = remote_request(name, value, kCame);
    return request ? "" : request.error().message;
}

TEST(RemoteRequest, every_action_but_quit_can_be_asked_for_by_its_name) {
    for (const ActionRow& row : action_table()) {
        const std::string value = row.value ? std::to_string(row.value->highest) : "";
        const auto request = remote_request(row.name, value, kCame);
        ASSERT_EQ(request.has_value(), row.action != Action::quit) << row.name;
        EXPECT_EQ(is_remote(row), request.has_value());
        if (request) {
            EXPECT_EQ(request->action, row.action);
            EXPECT_EQ(request->value, row.value ? row.value->highest : 0.0) << row.name;
            EXPECT_EQ(request->came, kCame);
        }
    }
}

TEST(RemoteRequest, takes_numbers_and_names_with_blanks_around_them) {
    EXPECT_EQ(remote_request("nudge", " -10\r\n", kCame)->value, -10.0);
    EXPECT_EQ(remote_request("nudge", "+2.5", kCame)->value, 2.5);
    EXPECT_EQ(remote_request("dance", "\tsalsa\n", kCame)->text, "salsa");
    EXPECT_EQ(remote_request("dance", "", kCame)->text, "");
    EXPECT_EQ(remote_request("calm", "on", kCame)->text, "on");
}

TEST(RemoteRequest, says_what_is_wrong) {
    struct Case {
        const char* name;
        std::string value;
        const char* fault;
    };
    const std::vector<Case> cases = {
        {"quit", "", "action quit: only who sits at the program may ask for it"},
        {"tpa", "", "action \"tpa\" is unknown; did you mean \"tap\"?"},
        {"nudge", "", "action nudge: it takes a number in ms"},
        {"nudge", "ten", "action nudge: it takes a number in ms"},
        {"nudge", "1 2", "action nudge: it takes a number in ms"},
        {"nudge", "nan", "action nudge: it takes a number in ms"},
        {"nudge", "inf", "action nudge: it takes a number in ms"},
        {"nudge", "1e999", "action nudge: it takes a number in ms"},
        {"set-tempo", "300", "action set-tempo: 300 BPM must be 40 to 230 BPM"},
        {"select-figure", "0", "action select-figure: 0 must be a whole number from 1 to 64"},
        {"tap", "x", "action tap: it takes no name"},
        {"avatar", "/etc/passwd", "action avatar: a name is taken, no path"},
        {"avatar", "../me.vrm", "action avatar: a name is taken, no path"},
        {"theme", "a/b", "action theme: a name is taken, no path"},
        {"calm", "very", "action calm: it is on or off"},
        {"dance", "a\nb", "action dance: a name is one line of 1 to 255 bytes in UTF-8"},
        {"dance", "\xff", "action dance: a name is one line of 1 to 255 bytes in UTF-8"},
        {"dance",
         std::string(256, 'x'),
         "action dance: a name is one line of 1 to 255 bytes in UTF-8"},
    };
    for (const Case& row : cases) {
        EXPECT_EQ(fault_of(row.name, row.value), row.fault);
    }
}

}  // namespace
}  // namespace raks::engine
