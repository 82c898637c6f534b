#include "engine/show/clip_transport.hpp"

#include <gtest/gtest.h>

#include <string>

namespace raks::engine {
namespace {

void type(ClipTransport& transport, const std::string& digits) {
    for (const char digit : digits) {
        EXPECT_TRUE(transport.handle({.key = static_cast<Key>(digit)}));
    }
}

TEST(ClipTransport, plays_round_and_round_by_the_clock) {
    ClipTransport transport(100, 60.0);
    transport.advance(0.5);
    EXPECT_EQ(transport.frame(), 30U);
    transport.advance(1.5);
    EXPECT_EQ(transport.frame(), 20U) << "120 frames after the start";
    transport.advance(-1.0);
    EXPECT_EQ(transport.frame(), 20U);
}

TEST(ClipTransport, stands_still_in_a_pause) {
    ClipTransport transport(100, 60.0);
    EXPECT_TRUE(transport.handle({.key = Key::space}));
    EXPECT_TRUE(transport.handle({.key = Key::space, .is_repeat = true})) << "a held key";
    transport.advance(0.5);
    EXPECT_EQ(transport.frame(), 0U);
    EXPECT_TRUE(transport.picture().is_paused);
    EXPECT_TRUE(transport.handle({.key = Key::space}));
    transport.advance(0.5);
    EXPECT_EQ(transport.frame(), 30U);
}

TEST(ClipTransport, steps_by_one_and_ten_and_stops_at_the_ends) {
    ClipTransport transport(100, 60.0, 50);
    const auto after = [&](Key key, bool has_shift) {
        EXPECT_TRUE(transport.handle({.key = key, .has_shift = has_shift}));
        return transport.frame();
    };
    EXPECT_EQ(after(Key::right, false), 51U);
    EXPECT_EQ(after(Key::left, true), 41U);
    EXPECT_EQ(after(Key::end, false), 99U);
    EXPECT_EQ(after(Key::right, true), 99U);
    EXPECT_EQ(after(Key::home, false), 0U);
    EXPECT_EQ(after(Key::left, false), 0U);
    EXPECT_TRUE(transport.is_paused());
}

TEST(ClipTransport, goes_to_the_number_typed) {
    ClipTransport transport(1000, 60.0);
    type(transport, "12");
    EXPECT_EQ(transport.picture().typed, "12");
    EXPECT_EQ(transport.picture().frame, 0U);
    type(transport, "39");
    EXPECT_TRUE(transport.handle({.key = Key::backspace}));
    EXPECT_TRUE(transport.handle({.key = Key::enter}));
    EXPECT_EQ(transport.frame(), 123U);
    EXPECT_TRUE(transport.is_paused());
    type(transport, "99999999999999999999");
    EXPECT_TRUE(transport.handle({.key = Key::enter}));
    EXPECT_EQ(transport.frame(), 999U) << "beyond the end is the end";
    type(transport, "5");
    EXPECT_TRUE(transport.handle({.key = Key::escape})) << "forgets the number";
    EXPECT_EQ(transport.frame(), 999U);
}

TEST(ClipTransport, plays_at_any_rate_also_backward) {
    ClipTransport transport(100, 50.0);
    transport.set_rate(4.0);
    transport.advance(0.1);
    EXPECT_EQ(transport.frame(), 20U);
    transport.set_rate(-2.0);
    transport.advance(0.3);
    EXPECT_EQ(transport.frame(), 90U) << "thirty frames back from 20, round the start";
    transport.set_rate(0.1);
    transport.advance(1.1);
    EXPECT_EQ(transport.frame(), 95U);
    transport.set_rate(9.0);
    EXPECT_EQ(transport.rate(), ClipTransport::kHighestRate);
    transport.set_rate(-9.0);
    EXPECT_EQ(transport.rate(), ClipTransport::kLowestRate);
}

TEST(ClipTransport, rate_keys_step_over_a_standstill) {
    ClipTransport transport(100, 50.0);
    const auto after = [&](Key key, bool has_shift = false) {
        EXPECT_TRUE(transport.handle({.key = key, .has_shift = has_shift}));
        return transport.rate();
    };
    EXPECT_DOUBLE_EQ(after(Key::down), 0.75);
    EXPECT_DOUBLE_EQ(after(Key::down), 0.5);
    EXPECT_DOUBLE_EQ(after(Key::down), 0.25);
    EXPECT_DOUBLE_EQ(after(Key::down), -0.25);
    EXPECT_DOUBLE_EQ(after(Key::up), 0.25);
    EXPECT_DOUBLE_EQ(after(Key::up, true), 0.3);
    EXPECT_DOUBLE_EQ(after(key_of(U'r')), 1.0);
    for (int i = 0; i < 40; ++i) {
        after(Key::up);
    }
    EXPECT_DOUBLE_EQ(transport.rate(), 4.0);
}

TEST(ClipTransport, commas_and_clicks_lead_to_frames) {
    ClipTransport transport(101, 50.0, 50);
    EXPECT_TRUE(transport.handle({.key = key_of(U'.')}));
    EXPECT_EQ(transport.frame(), 51U);
    EXPECT_TRUE(transport.handle({.key = key_of(U',')}));
    EXPECT_EQ(transport.frame(), 50U);
    transport.go_to_share(0.25);
    EXPECT_EQ(transport.frame(), 25U);
    EXPECT_TRUE(transport.is_paused()) << "a click on the bar does not start it";
    transport.go_to_share(7.0);
    EXPECT_EQ(transport.frame(), 100U);
    transport.toggle_pause();
    EXPECT_FALSE(transport.is_paused());
    transport.go_to(1000);
    EXPECT_EQ(transport.frame(), 100U);
    EXPECT_TRUE(transport.is_paused());
}

TEST(ClipTransport, leaves_other_keys_to_the_window) {
    ClipTransport transport(10, 60.0);
    for (const KeyEvent& key : {KeyEvent{.key = Key::escape},
                                KeyEvent{.key = Key::enter},
                                KeyEvent{.key = key_of(U'q')},
                                KeyEvent{.key = Key::right, .has_control = true}}) {
        EXPECT_FALSE(transport.handle(key));
    }
    EXPECT_FALSE(transport.is_paused());
}

TEST(ClipTransport, of_one_frame_stays_there) {
    ClipTransport transport(1, 60.0);
    transport.advance(3.3);
    EXPECT_EQ(transport.frame(), 0U);
    EXPECT_TRUE(transport.handle({.key = Key::right}));
    EXPECT_EQ(transport.frame(), 0U);
}

}  // namespace
}  // namespace raks::engine
