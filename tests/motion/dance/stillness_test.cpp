#include "motion/dance/dynamics/stillness.hpp"

#include <gtest/gtest.h>

namespace raks::motion::stillness_test {
namespace {

StreamTime at(double seconds) { return stream_time_from_seconds(seconds); }

TEST(Stillness, slows_down_evenly_and_stands_at_its_moment) {
    Stillness still;
    still.begin(at(10.0), Beats(4.0), 3.0, Beats(4.3));
    EXPECT_NEAR(still.phase(at(10.0)).count(), 4.0, 1e-9);
    EXPECT_NEAR(still.phase(at(10.001)).count(), 4.003, 1e-4) << "at full speed first";
    EXPECT_FALSE(still.is_at_rest(at(10.19)));
    EXPECT_TRUE(still.is_at_rest(at(10.201))) << "twice the time that 0.3 beats take";
    EXPECT_NEAR(still.phase(at(10.201)).count(), 4.3, 1e-9);
    EXPECT_NEAR(still.phase(at(20.0)).count(), 4.3, 1e-9);
    double before = 4.0;
    for (int ms = 1; ms < 300; ++ms) {
        const double phase = still.phase(at(10.0 + 0.001 * ms)).count();
        ASSERT_GE(phase, before);
        ASSERT_LE(phase - before, 0.0031);
        before = phase;
    }
}

TEST(Stillness, keeps_its_posture_until_it_begins_anew) {
    Stillness still;
    still.begin(at(1.0), Beats(1.0), 2.0, Beats(1.2));
    EXPECT_FALSE(still.posture());
    still.keep(Pose());
    EXPECT_TRUE(still.posture());
    still.begin(at(5.0), Beats(3.0), 2.0, Beats(3.2));
    EXPECT_FALSE(still.posture());
}

}  // namespace
}  // namespace raks::motion::stillness_test
