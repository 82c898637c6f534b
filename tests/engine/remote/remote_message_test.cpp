#include "engine/remote/remote_message.hpp"

#include <gtest/gtest.h>

#include <chrono>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "engine/control/remote_request.hpp"

#include <fmt/format.h>

namespace raks::engine {
namespace {

using std::chrono::milliseconds;

const HostTime kNow = HostTime(std::chrono::seconds(1'000));

ActionRequest request_in(const std::string& text) {
    const auto message = read_remote_message(text, kNow);
    EXPECT_TRUE(message) << text << ": " << message.error().message;
    const auto* const request = message ? std::get_if<ActionRequest>(&*message) : nullptr;
    EXPECT_NE(request, nullptr) << text;
    return request == nullptr ? ActionRequest{} : *request;
}

TEST(RemoteMessage, asks_for_an_action) {
    EXPECT_EQ(request_in(R"({"do":"tap"})"),
              (ActionRequest{.action = Action::tap_tempo, .came = kNow}));
    EXPECT_EQ(request_in(R"({"do":"nudge","value":-10})").value, -10.0);
    EXPECT_EQ(request_in(R"({"do":"nudge","value":"2.5"})").value, 2.5);
    EXPECT_EQ(request_in(R"({"do":"dance","value":"salsa"})").text, "salsa");
    EXPECT_EQ(request_in(R"({"do":"dance","value":null})").text, "");
}

TEST(RemoteMessage, a_moment_counts_within_the_last_second) {
    const auto came = [](HostTime at) {
        return request_in(fmt::format(R"({{"do":"tap","at":{}}})", remote_time(at))).came;
    };
    const auto is_near = [](std::optional<HostTime> a, HostTime b) {
        return a && std::abs((*a - b).count()) < 1'000;  // doubles of milliseconds
    };
    EXPECT_TRUE(is_near(came(kNow - milliseconds(35)), kNow - milliseconds(35)));
    EXPECT_TRUE(is_near(came(kNow - milliseconds(999)), kNow - milliseconds(999)));
    EXPECT_EQ(came(kNow - milliseconds(1'001)), kNow);
    EXPECT_EQ(came(kNow + milliseconds(1)), kNow) << "a clock that is wrong";
    EXPECT_EQ(request_in(R"({"do":"tap","at":"now"})").came, kNow);
    EXPECT_EQ(request_in(R"({"do":"tap","at":1e308})").came, kNow);
}

TEST(RemoteMessage, a_question_for_the_time_is_given_back) {
    const auto message = read_remote_message(R"({"clock":12.5})", kNow);
    ASSERT_TRUE(message);
    const auto answer = nlohmann::json::parse(
        remote_clock_answer(std::get<RemoteClock>(*message), kNow + milliseconds(3)));
    EXPECT_EQ(answer, (nlohmann::json{{"type", "clock"}, {"clock", 12.5}, {"now", 1'000'003.0}}));
}

TEST(RemoteMessage, says_what_is_wrong) {
    for (const auto& [text, fault] : std::vector<std::pair<std::string, std::string>>{
             {"", "a message is one JSON object"},
             {"[1,2]", "a message is one JSON object"},
             {"{\"do\":\"tap\"", "a message is one JSON object"},
             {"{\"do\":\"\xff\"}", "a message is one JSON object"},
             {std::string(40'000, '['), "a message is one JSON object"},
             {"{}", "a message has \"do\" with an action's name, or \"clock\""},
             {R"({"do":7})", "a message has \"do\" with an action's name, or \"clock\""},
             {R"({"do":"tap","value":[1]})", "\"value\" is a text or a number"},
             {R"({"do":"nudge","value":1e999})", "a message is one JSON object"},
             {R"({"do":"quit"})", "action quit: only who sits at the program may ask for it"},
             {R"({"do":"avatar","value":"/x"})", "action avatar: a name is taken, no path"}}) {
        const auto message = read_remote_message(text, kNow);
        ASSERT_FALSE(message) << text.substr(0, 60);
        EXPECT_EQ(message.error().message, fault);
    }
}

TEST(RemoteMessage, the_first_one_has_the_table_of_actions) {
    const auto hello = nlohmann::json::parse(remote_text(RemoteChoices{.dances = {"salsa"}}));
    EXPECT_EQ(hello["protocol"], kRemoteProtocol);
    EXPECT_EQ(hello["dances"], nlohmann::json::array({"salsa"}));
    EXPECT_EQ(hello["actions"].size(), kActionCount - 1);
    for (const auto& action : hello["actions"]) {
        const auto row = find_action(action["name"].get<std::string>());
        ASSERT_TRUE(row);
        EXPECT_TRUE(is_remote(**row));
        EXPECT_EQ(action.contains("kind"), (*row)->value.has_value());
        EXPECT_EQ(action.contains("takes"), (*row)->text != TextKind::none);
    }
}

TEST(RemoteMessage, the_state_has_beats_to_come_by_the_same_clock) {
    RemoteState state;
    state.now = kNow;
    state.bpm = 119.984;
    state.is_locked = true;
    state.source = "a \"song\"\n\xff";
    state.song = {"mpv", "Quimbara", "Celia \"la reina\" Cruz", true};
    state.beats = {{kNow + milliseconds(120), 4}, {kNow + milliseconds(620), 1}};
    state.targets = {{"--osc studio:9000", 7, 2, "nobody listens there"}};
    const auto text = nlohmann::json::parse(remote_text(state));
    EXPECT_EQ(text["now"], 1'000'000.0);
    EXPECT_EQ(text["bpm"], 119.98);
    EXPECT_EQ(text["beats"][0]["at"], 1'000'120.0);
    EXPECT_EQ(text["beats"][1]["count"], 1);
    EXPECT_EQ(text["targets"][0]["dropped"], 2);
    EXPECT_EQ(text["locked"], true);
    EXPECT_EQ(text["playing"],
              nlohmann::json({{"player", "mpv"},
                              {"title", "Quimbara"},
                              {"artist", "Celia \"la reina\" Cruz"},
                              {"playing", true}}));
}

}  // namespace
}  // namespace raks::engine
