#include "engine/live/sleep_watch.hpp"

#include <gtest/gtest.h>

namespace raks::engine {
namespace {

using std::chrono::milliseconds;
using std::chrono::seconds;

TEST(SleepWatch, tells_how_long_the_computer_slept_once) {
    SleepWatch watch;
    EXPECT_EQ(watch.look(seconds(500), seconds(100)), std::nullopt) << "slept before we began";
    EXPECT_EQ(watch.look(seconds(501), seconds(101)), std::nullopt);
    EXPECT_EQ(watch.look(seconds(3602), seconds(102)), std::optional<Nanos>(seconds(3100)));
    EXPECT_EQ(watch.look(seconds(3603), seconds(103)), std::nullopt);
}

TEST(SleepWatch, the_clocks_own_jitter_is_no_sleep) {
    SleepWatch watch;
    EXPECT_EQ(watch.look(seconds(10), seconds(10)), std::nullopt);
    EXPECT_EQ(watch.look(seconds(11) + milliseconds(20), seconds(11)), std::nullopt);
    EXPECT_EQ(watch.look(seconds(12) - milliseconds(20), seconds(12)), std::nullopt);
}

TEST(SleepWatch, an_awake_computer_did_not_sleep) {
    SleepWatch watch;
    EXPECT_EQ(watch.look(), std::nullopt);
    EXPECT_EQ(watch.look(), std::nullopt);
}

}  // namespace
}  // namespace raks::engine
