#include "render/gl/frame_limiter.hpp"

#include <gtest/gtest.h>

namespace raks::render {
namespace {

using std::chrono::milliseconds;

HostTime at(Nanos since_start) { return HostTime(std::chrono::seconds(1000) + since_start); }

TEST(FrameLimiter, a_fast_loop_is_held_at_the_period_without_drift) {
    FrameLimiter limiter(50.0, FrameLimiter::Pace::exact);
    HostTime now = at(Nanos(0));
    now = limiter.next_due(now);  // the first picture waits for nothing
    EXPECT_EQ(now, at(Nanos(0)));
    for (int picture = 1; picture <= 1000; ++picture) {
        now = limiter.next_due(now + milliseconds(3));
        ASSERT_EQ(now, at(picture * milliseconds(20)));
    }
}

TEST(FrameLimiter, a_late_picture_is_not_followed_by_a_burst) {
    FrameLimiter limiter(50.0, FrameLimiter::Pace::exact);
    (void)limiter.next_due(at(Nanos(0)));
    EXPECT_EQ(limiter.next_due(at(milliseconds(95))), at(milliseconds(95)));
    EXPECT_EQ(limiter.next_due(at(milliseconds(96))), at(milliseconds(115)));
}

TEST(FrameLimiter, a_loop_that_vsync_paces_never_sleeps) {
    FrameLimiter limiter(60.0, FrameLimiter::Pace::behind_vsync);
    for (int picture = 0; picture < 1000; ++picture) {
        const HostTime now = at(nanos_from_seconds(picture / 60.0));
        ASSERT_LE(limiter.next_due(now), now) << "picture " << picture;
    }
}

TEST(FrameLimiter, sleeping_until_a_moment_that_has_passed_returns) {
    sleep_until(HostTime{});
    const HostTime due = std::chrono::time_point_cast<Nanos>(HostClock::now()) + milliseconds(2);
    sleep_until(due);
    EXPECT_GE(HostClock::now(), due);
}

}  // namespace
}  // namespace raks::render
