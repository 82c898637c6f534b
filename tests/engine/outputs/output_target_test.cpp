#include "engine/outputs/output_target.hpp"

#include <gtest/gtest.h>

#include <array>

#include "engine/outputs/output.hpp"

namespace raks::engine {
namespace {

TEST(OutputTarget, has_a_host_a_port_and_options) {
    TargetReader reader("studio:9000,lead=-20.5,factor=0.5,prefix=/x");
    const HostPort place = reader.host_port({});
    EXPECT_EQ(place.host, "studio");
    EXPECT_EQ(place.port, 9000);
    const OutputTiming timing = reader.timing();
    EXPECT_EQ(timing.lead, -std::chrono::microseconds(20'500));
    EXPECT_EQ(timing.pace, BeatSchedule::Pace::half);
    EXPECT_EQ(reader.text("prefix"), "/x");
    EXPECT_TRUE(reader.finish());
}

TEST(OutputTarget, may_leave_out_a_usual_port_and_be_an_address_of_either_kind) {
    const auto read = [](const char* text) {
        TargetReader reader(text);
        const HostPort place = reader.host_port(9996);
        EXPECT_TRUE(reader.finish()) << text;
        return place.text();
    };
    EXPECT_EQ(read("desk"), "desk:9996");
    EXPECT_EQ(read("10.0.0.5"), "10.0.0.5:9996");
    EXPECT_EQ(read("[::1]"), "[::1]:9996");
    EXPECT_EQ(read("[fe80::1]:7"), "[fe80::1]:7");
}

TEST(OutputTarget, of_a_file_keeps_its_commas) {
    TargetReader reader = TargetReader::of_file("a,b=3,lead=10,c,factor=2,lead=40");
    EXPECT_EQ(reader.place(), "a,b=3,lead=10,c");
    EXPECT_EQ(reader.timing().lead, std::chrono::milliseconds(40));
    EXPECT_TRUE(reader.finish());
}

struct BadTarget {
    const char* option;
    const char* target;
    const char* fault;
};

class BadTargets : public ::testing::TestWithParam<BadTarget> {};

TEST_P(BadTargets, are_said_in_one_line) {
    const BadTarget& bad = GetParam();
    for (const OutputKind& kind : output_kinds()) {
        if (kind.option == bad.option) {
            const auto checked = kind.check(bad.target);
            ASSERT_FALSE(checked) << bad.target;
            EXPECT_EQ(checked.error().message, bad.fault);
            EXPECT_FALSE(kind.open(bad.target));
        }
    }
}

INSTANTIATE_TEST_SUITE_P(
    All,
    BadTargets,
    ::testing::Values(
        BadTarget{"osc", "", "\"\" is no target; write HOST:PORT, a port is 1 to 65535"},
        BadTarget{"osc", "desk", "\"desk\" is no target; write HOST:PORT, a port is 1 to 65535"},
        BadTarget{
            "osc", "desk:0", "\"desk:0\" is no target; write HOST:PORT, a port is 1 to 65535"},
        BadTarget{"osc",
                  "desk:70000",
                  "\"desk:70000\" is no target; write HOST:PORT, a port is 1 to 65535"},
        BadTarget{"osc", "desk:9,lead=91", "lead=91 must be -500 to 90"},
        BadTarget{"osc", "desk:9,lead=nan", "lead=nan must be -500 to 90"},
        BadTarget{"osc", "desk:9,lead=1,lead=2", "lead= is given twice"},
        BadTarget{"osc", "desk:9,led=1", "option \"led\" is unknown; did you mean \"lead\"?"},
        BadTarget{"osc", "desk:9,factor=3", "factor=3 must be 0.5, 1 or 2"},
        BadTarget{"osc", "desk:9,prefix=x", "prefix=x must begin with / and have none of #*,?[]{}"},
        BadTarget{"osc", "desk:9,rate=0.5", "rate= is 1 to 120 a second, with preset=raks alone"},
        BadTarget{"os2l",
                  "de sk",
                  "\"de sk\" is no target; write HOST or HOST:PORT, a port is 1 to 65535"},
        BadTarget{"os2l", "desk,rate=5", "option \"rate\" is unknown; known: lead, factor"},
        BadTarget{
            "vmc", "pc:0", "\"pc:0\" is no target; write HOST or HOST:PORT, a port is 1 to 65535"},
        BadTarget{"vmc", "pc,dancer=0", "dancer=0 must be 1 to 32"},
        BadTarget{"vmc", "pc,dancer=1.5", "dancer= counts the dancers: 1, 2, ..."},
        BadTarget{"vmc", "pc,rate=121", "rate=121 must be 1 to 120"},
        BadTarget{"vmc", "pc,travel=feet", "travel \"feet\" is unknown; known: hips, root, none"},
        BadTarget{"vmc", "pc,way=-1", "way=-1 must be 0 to 4"},
        BadTarget{"vmc", "pc,rotations=row", "rotations \"row\" is unknown; did you mean \"raw\"?"},
        BadTarget{"vmc", "pc,yaw=400", "yaw=400 must be -360 to 360"},
        BadTarget{
            "vmc",
            "pc,factor=2",
            "option \"factor\" is unknown; known: dancer, rate, travel, way, rotations, yaw, lead"},
        BadTarget{"lines", "beats,factor=x", "factor=x must be 0.5, 1 or 2"}));

}  // namespace
}  // namespace raks::engine
