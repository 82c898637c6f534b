#include "engine/control/action_dispatcher.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <string>
#include <vector>

namespace raks::engine {
namespace {

class Dispatcher : public ::testing::Test {
 protected:
    void SetUp() override {
        actions_.on(Action::seek, [this](double value) { sought_.push_back(value); });
        actions_.on(Action::quit, [this](double value) { quit_.push_back(value); });
    }
    [[nodiscard]] std::string error_of(const ActionRequest& request) const {
        const auto done = actions_.dispatch(request);
        return done ? "" : done.error().message;
    }

    std::vector<std::string> said_;
    std::vector<double> sought_;
    std::vector<double> quit_;
    ActionDispatcher actions_{[this](const std::string& line) { said_.push_back(line); }};
};

TEST_F(Dispatcher, brings_a_request_to_its_handler_alone) {
    EXPECT_EQ(error_of({Action::seek, -5.0}), "");
    EXPECT_EQ(sought_, std::vector{-5.0});
    EXPECT_TRUE(quit_.empty());
    EXPECT_TRUE(said_.empty());
}

TEST_F(Dispatcher, does_not_hand_a_value_to_an_action_without_one) {
    EXPECT_EQ(error_of({Action::quit, 1.0}), "") << "a button of a remote control sends 1";
    EXPECT_EQ(quit_, std::vector{0.0});
}

TEST_F(Dispatcher, finds_actions_by_name) {
    EXPECT_TRUE(actions_.dispatch("seek", 30.0));
    EXPECT_EQ(sought_, std::vector{30.0});
    const auto wrong = actions_.dispatch("sekk", 30.0);
    ASSERT_FALSE(wrong);
    EXPECT_EQ(wrong.error().message, "action \"sekk\" is unknown; did you mean \"seek\"?");
}

TEST_F(Dispatcher, brings_a_text_to_the_handler_of_texts) {
    std::vector<std::string> danced;
    std::vector<double> listed;
    actions_.on(Action::choose_dance, [&](double value) { listed.push_back(value); });
    actions_.on_text(Action::choose_dance, [&](const std::string& text) -> Expected<void> {
        danced.push_back(text);
        return text == "polka" ? Expected<void>(fail("no polka here")) : Expected<void>();
    });
    EXPECT_EQ(error_of({Action::choose_dance, 0.0, "salsa"}), "");
    EXPECT_EQ(error_of({Action::choose_dance}), "");
    EXPECT_TRUE(actions_.dispatch("dance", 0.0, "waltz"));
    EXPECT_EQ(error_of({Action::choose_dance, 0.0, "polka"}), "no polka here");
    EXPECT_EQ(danced, (std::vector<std::string>{"salsa", "waltz", "polka"}));
    EXPECT_EQ(listed, std::vector{0.0});
    EXPECT_EQ(error_of({Action::choose_preset, 0.0, "x"}),
              "action preset: there is nothing here that does it");
    EXPECT_EQ(error_of({Action::quit, 0.0, "x"}), "action quit: it takes no name");
    EXPECT_TRUE(quit_.empty());
}

TEST_F(Dispatcher, tells_a_handler_when_the_request_came) {
    std::vector<HostTime> moments;
    actions_.on_dated(Action::tap_tempo, [&](double, HostTime came) { moments.push_back(came); });
    const HostTime before = HostClock::now();
    const HostTime came = before - std::chrono::milliseconds(40);
    EXPECT_EQ(error_of({.action = Action::tap_tempo, .came = came}), "");
    EXPECT_EQ(error_of({Action::tap_tempo}), "");
    ASSERT_EQ(moments.size(), 2U);
    EXPECT_EQ(moments[0], came);
    EXPECT_GE(moments[1], before) << "when it is carried out";
}

TEST_F(Dispatcher, says_when_it_clamps) {
    EXPECT_EQ(error_of({Action::seek, -1e6}), "");
    EXPECT_EQ(sought_, std::vector{-36'000.0});
    EXPECT_EQ(said_,
              std::vector<std::string>{"action seek: -1e+06 s is too far, -36000 s is taken"});
}

TEST_F(Dispatcher, does_nothing_when_it_refuses) {
    EXPECT_EQ(error_of({Action::seek, std::nan("")}), "action seek: its value is not a number");
    EXPECT_EQ(error_of({Action::pause, 0.0}), "action pause: there is nothing here that does it");
    EXPECT_TRUE(sought_.empty());
    EXPECT_TRUE(said_.empty());
}

TEST_F(Dispatcher, knows_what_is_done_here_and_lets_the_last_handler_do_it) {
    EXPECT_TRUE(actions_.handles(Action::seek));
    EXPECT_FALSE(actions_.handles(Action::pause));
    int count = 0;
    actions_.on(Action::seek, [&](double) { ++count; });
    EXPECT_EQ(error_of({Action::seek, 5.0}), "");
    EXPECT_EQ(count, 1);
    EXPECT_TRUE(sought_.empty());
}

}  // namespace
}  // namespace raks::engine
