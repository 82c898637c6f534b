#include "render/overlay/text_format.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

namespace raks::render {
namespace {

TEST(TextFormat, times_read_as_on_a_player) {
    EXPECT_EQ(clock_text(0.0), "0:00");
    EXPECT_EQ(clock_text(65.9), "1:05");
    EXPECT_EQ(clock_text(3723.0), "1:02:03");
    EXPECT_EQ(clock_text(36'000.0), "10:00:00");
    EXPECT_EQ(clock_text(-3.0), "0:00");
    EXPECT_EQ(clock_text(std::nan("")), "0:00");
    EXPECT_EQ(clock_text(1e300), "100:00:00");
}

TEST(TextFormat, a_name_stays_on_one_line) {
    EXPECT_EQ(one_line("a\nb\tc\x7F"), "a b c ");
    EXPECT_EQ(one_line("caf\xC3\xA9"), "caf\xC3\xA9");
}

TEST(TextFormat, labels_begin_with_a_capital) {
    EXPECT_EQ(capitalized("salsa"), "Salsa");
    EXPECT_EQ(capitalized("cross_body_lead"), "Cross body lead");
    EXPECT_EQ(capitalized(""), "");
    EXPECT_EQ(capitalized("\xC3\xA9toile"), "\xC3\xA9toile");
}

TEST(TextFormat, the_meter_spans_60_decibels) {
    EXPECT_EQ(meter_fraction(-120.0F), 0.0F);
    EXPECT_EQ(meter_fraction(-60.0F), 0.0F);
    EXPECT_EQ(meter_fraction(-30.0F), 0.5F);
    EXPECT_EQ(meter_fraction(0.0F), 1.0F);
    EXPECT_EQ(meter_fraction(12.0F), 1.0F);
    EXPECT_EQ(meter_fraction(std::numeric_limits<float>::quiet_NaN()), 0.0F);
}

}  // namespace
}  // namespace raks::render
