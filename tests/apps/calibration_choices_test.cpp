#include "apps/raks_capture/calibration_choices.hpp"

#include <gtest/gtest.h>

#include <string>

namespace raks::apps {
namespace {

TEST(CalibrationChoices, read_back) {
    CalibrationChoices choices;
    EXPECT_TRUE(choices.are_none());
    EXPECT_EQ(*parse_calibration_choices(calibration_choices_text(choices), "c"), choices);
    choices = {
        .every = 0.25, .coefficients = 8, .floor = 95.0, .floor_picture = {}, .clocks = "a b"};
    EXPECT_EQ(*parse_calibration_choices(calibration_choices_text(choices), "c"), choices);
    choices.floor.reset();
    choices.floor_picture = 12;
    EXPECT_EQ(*parse_calibration_choices(calibration_choices_text(choices), "c"), choices);
}

TEST(CalibrationChoices, of_now_count_before_those_of_before) {
    const CalibrationChoices before{
        .every = 0.25, .coefficients = 8, .floor = 95.0, .floor_picture = {}, .clocks = "a"};
    const CalibrationChoices now{
        .every = {}, .coefficients = 5, .floor = {}, .floor_picture = 3, .clocks = {}};
    const CalibrationChoices all = now.over(before);
    EXPECT_EQ(all.every, 0.25);
    EXPECT_EQ(all.coefficients, 5);
    EXPECT_FALSE(all.floor);
    EXPECT_EQ(all.floor_picture, 3);
    EXPECT_EQ(all.clocks, "a");
    EXPECT_EQ(CalibrationChoices{}.over(before), before);
}

TEST(CalibrationChoices, that_are_none_are_refused) {
    const auto why = [](const std::string& text) {
        const auto read = parse_calibration_choices(
            "format = \"raks-calibration\"\nversion = 1\n" + text, "c.toml");
        return read ? std::string() : read.error().message;
    };
    EXPECT_NE(why("coefficients = 6\n").find("5 or 8"), std::string::npos);
    EXPECT_NE(why("floor = -1.0\n").find("floor"), std::string::npos);
    EXPECT_NE(why("floor = nan\n").find("floor"), std::string::npos);
    EXPECT_NE(why("floor = 1.0\nfloor_picture = 2\n").find("leave one"), std::string::npos);
    EXPECT_NE(why("flor = 1.0\n").find("floor"), std::string::npos);
    EXPECT_FALSE(parse_calibration_choices("format = \"raks-rig\"\n", "c"));
}

}  // namespace
}  // namespace raks::apps
