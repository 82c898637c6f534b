#include "motion/skeleton/formats/frame_rate.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <string>

#include "motion/skeleton/formats/bvh.hpp"

#include <fmt/format.h>

namespace raks::motion::frame_rate_test {
namespace {

TEST(FrameRate, digits_that_a_header_rounds_or_cuts_are_the_known_rate) {
    const struct {
        const char* digits;
        double rate;
    } table[] = {{"0.0333", 30.0},
                 {"0.0333333", 30.0},
                 {".033333", 30.0},
                 {"0.033367", 30000.0 / 1001.0},
                 {"0.03336667", 30000.0 / 1001.0},
                 {"0.0334", 30000.0 / 1001.0},
                 {"0.0167", 60.0},
                 {"0.04166", 24.0},
                 {"0.04167", 24.0},
                 {"0.041708", 24000.0 / 1001.0},
                 {"0.04", 25.0},
                 {"0.0166667", 60.0},
                 {"0.01667", 60.0},
                 {"1.6667e-2", 60.0},
                 {"0.008333", 120.0},
                 {"0.0083", 120.0},
                 {"0.008342", 120000.0 / 1001.0},
                 {"0.00417", 240.0},
                 {"0.0041667", 240.0},
                 {"0.0125", 80.0},
                 {"0.01", 100.0},
                 {"0.5", 2.0},
                 {"0.002", 500.0}};
    for (const auto& row : table) {
        const WrittenRate written = rate_of_frame_time(row.digits, std::stod(row.digits));
        EXPECT_DOUBLE_EQ(written.frames_per_second, row.rate) << row.digits;
        EXPECT_EQ(written.warning, "") << row.digits;
    }
}

TEST(FrameRate, other_rates_stay_what_they_are) {
    for (const std::string digits : {"0.0345", "0.021", "0.12345", "0.00071"}) {
        const double seconds = std::stod(digits);
        EXPECT_NEAR(
            rate_of_frame_time(digits, seconds).frames_per_second, 1.0 / seconds, 0.06 / seconds)
            << digits;
    }
    EXPECT_DOUBLE_EQ(rate_of_frame_time("0.0345", 0.0345).frames_per_second, 1.0 / 0.0345);
}

TEST(FrameRate, digits_that_leave_it_open_are_said) {
    const WrittenRate written = rate_of_frame_time("0.017", 0.017);
    EXPECT_EQ(written.frames_per_second, 60.0);
    EXPECT_EQ(written.warning,
              "its frame time of 0.017 s is rounded; taken for 60 frames a second (--fps)");
    EXPECT_EQ(rate_of_frame_time("0.03", 0.03).frames_per_second, 30.0);
}

TEST(FrameRate, is_what_the_reader_gives) {
    const std::string text =
        "HIERARCHY\nROOT a\n{\nOFFSET 0 0 0\nCHANNELS 3 Zrotation Xrotation Yrotation\n}\n"
        "MOTION\nFrames: 1\nFrame Time: 0.0333\n0 0 0\n";
    const auto clip = parse_bvh(text, "x.bvh");
    ASSERT_TRUE(clip) << clip.error().message;
    EXPECT_EQ(clip->frames_per_second, 30.0);
}

}  // namespace
}  // namespace raks::motion::frame_rate_test
