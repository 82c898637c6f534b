#include "engine/control/request_inbox.hpp"

#include <gtest/gtest.h>

#include <chrono>
#include <future>
#include <string>
#include <vector>

namespace raks::engine {
namespace {

using std::chrono::milliseconds;

class Inbox : public ::testing::Test {
 protected:
    void SetUp() override {
        actions_.on_dated(Action::tap_tempo,
                          [this](double, HostTime came) { taps_.push_back(came); });
        actions_.on_text(Action::choose_dance, [](const std::string& name) -> Expected<void> {
            return name == "salsa" ? Expected<void>() : fail("no " + name);
        });
    }
    ActionDispatcher actions_{[](const std::string&) {}};
    std::vector<HostTime> taps_;
    RequestInbox inbox_;
};

TEST_F(Inbox, carries_out_in_order_with_the_moments_at_which_they_came) {
    const HostTime first = HostClock::now();
    for (int i = 0; i < 3; ++i) {
        ASSERT_TRUE(inbox_.post({.action = Action::tap_tempo, .came = first + milliseconds(i)}));
    }
    EXPECT_EQ(inbox_.carry_out(actions_), std::nullopt);
    EXPECT_EQ(taps_, (std::vector{first, first + milliseconds(1), first + milliseconds(2)}));
    EXPECT_EQ(inbox_.carry_out(actions_), std::nullopt);
    EXPECT_EQ(taps_.size(), 3U);
}

TEST_F(Inbox, who_asks_gets_the_answer) {
    for (const char* name : {"salsa", "polka"}) {
        auto asked = std::async(std::launch::async, [&] {
            return inbox_.ask({.action = Action::choose_dance, .text = name},
                              std::chrono::minutes(1));
        });
        while (asked.wait_for(Nanos(0)) != std::future_status::ready) {
            EXPECT_EQ(inbox_.carry_out(actions_), std::nullopt);
        }
        const auto answer = asked.get();
        ASSERT_TRUE(answer.has_value());
        EXPECT_EQ(answer->has_value(), std::string(name) == "salsa");
        EXPECT_EQ(*answer ? "" : answer->error().message,
                  std::string(name) == "salsa" ? "" : "no polka");
    }
}

TEST_F(Inbox, who_does_not_wait_long_enough_is_served_all_the_same) {
    EXPECT_EQ(inbox_.ask({.action = Action::tap_tempo}, Nanos(0)), std::nullopt);
    EXPECT_EQ(inbox_.carry_out(actions_), std::nullopt);
    EXPECT_EQ(taps_.size(), 1U);
}

TEST_F(Inbox, what_finds_no_room_is_refused_and_counted) {
    for (std::size_t i = 0; i < RequestInbox::kRoom; ++i) {
        ASSERT_TRUE(inbox_.post({.action = Action::tap_tempo}));
    }
    EXPECT_FALSE(inbox_.post({.action = Action::tap_tempo}));
    const auto asked = inbox_.ask({.action = Action::tap_tempo}, std::chrono::minutes(1));
    ASSERT_TRUE(asked.has_value());
    EXPECT_EQ(asked->error().message, "too much is asked for at once: this is left out");
    EXPECT_EQ(inbox_.refused(), 2U);
    EXPECT_EQ(inbox_.carry_out(actions_), std::nullopt);
    EXPECT_EQ(taps_.size(), RequestInbox::kRoom);
}

TEST_F(Inbox, the_same_fault_again_is_not_said_again) {
    const auto post = [&](const char* name) {
        ASSERT_TRUE(inbox_.post({.action = Action::choose_dance, .text = name}));
    };
    post("polka");
    post("gavotte");
    EXPECT_EQ(inbox_.carry_out(actions_), "no polka");
    post("polka");
    EXPECT_EQ(inbox_.carry_out(actions_), std::nullopt);
    post("gavotte");
    EXPECT_EQ(inbox_.carry_out(actions_), "no gavotte");
}

}  // namespace
}  // namespace raks::engine
