#include "engine/setup/device_offsets.hpp"

#include <gtest/gtest.h>

#include <string>

#include "tests/support/mangled.hpp"

namespace raks::engine {
namespace {

using std::chrono::microseconds;
using std::chrono::milliseconds;

std::string fault_of_offsets(const std::string& toml) {
    const auto offsets = DeviceOffsets::parse(toml, "devices.toml");
    return offsets ? "" : offsets.error().message;
}

constexpr const char* kHead = "format = \"raks-device-offsets\"\nversion = 1\n";

TEST(DeviceOffsetsFile, says_what_was_written) {
    DeviceOffsets offsets;
    offsets.set({"Kitchen \"JBL\" \\ 5", milliseconds(143), "loop"});
    offsets.set({"H\xc3\xb6rer", microseconds(-1500), "tap"});
    offsets.set({"Kitchen \"JBL\" \\ 5", milliseconds(150), "tap"});
    const auto read = DeviceOffsets::parse(offsets.to_toml(), "devices.toml");
    ASSERT_TRUE(read) << read.error().message << '\n' << offsets.to_toml();
    ASSERT_EQ(read->entries().size(), 2U);
    EXPECT_EQ(read->of("Kitchen \"JBL\" \\ 5"), milliseconds(150));
    EXPECT_EQ(read->of("H\xc3\xb6rer"), microseconds(-1500));
    EXPECT_EQ(read->of("Kitchen"), std::nullopt);
    EXPECT_EQ(read->entries()[0].measured, "tap");
}

TEST(DeviceOffsetsFile, keeps_names_of_any_bytes) {
    DeviceOffsets offsets;
    offsets.set({"a\nb\x80\x1b", milliseconds(5), "tap"});
    const auto read = DeviceOffsets::parse(offsets.to_toml(), "devices.toml");
    ASSERT_TRUE(read) << read.error().message;
    EXPECT_EQ(read->of("a\nb\x80\x1b"), milliseconds(5));
    EXPECT_FALSE(read->of("")) << "a device without a name has none";
}

TEST(DeviceOffsets, of_a_monitor_are_those_of_its_loudspeaker_unless_it_has_its_own) {
    DeviceOffsets offsets;
    offsets.set({"Speakers", milliseconds(143), "loop"});
    EXPECT_EQ(offsets.of("Monitor of Speakers", "Speakers"), milliseconds(143));
    offsets.set({"Monitor of Speakers", milliseconds(-2), "tap"});
    EXPECT_EQ(offsets.of("Monitor of Speakers", "Speakers"), milliseconds(-2));
    EXPECT_EQ(in_words(milliseconds(143)), "143.0 ms later");
    EXPECT_EQ(in_words(microseconds(-500)), "0.5 ms earlier");
}

TEST(DeviceOffsetsFile, forgets_one_device) {
    DeviceOffsets offsets;
    offsets.set({"a", milliseconds(5), "tap"});
    EXPECT_TRUE(offsets.forget("a"));
    EXPECT_FALSE(offsets.forget("a"));
    EXPECT_TRUE(offsets.entries().empty());
}

TEST(DeviceOffsetsFile, is_refused_where_writing_it_again_would_lose_something) {
    EXPECT_EQ(fault_of_offsets(std::string(kHead)), "");
    EXPECT_EQ(fault_of_offsets(""),
              "devices.toml: format is not \"raks-device-offsets\"; this is another kind of file");
    EXPECT_EQ(fault_of_offsets("format = \"raks-device-offsets\"\nversion = 2\n"),
              "devices.toml: version 2 is not known to this Raks (it reads version 1)");
    EXPECT_NE(fault_of_offsets(std::string(kHead) + "devices = []\n").find("line 3"),
              std::string::npos);
    EXPECT_NE(fault_of_offsets(std::string(kHead) + "[[device]]\nname = \"a\"\n").find("offset_ms"),
              std::string::npos);
    EXPECT_NE(fault_of_offsets(std::string(kHead) +
                               "[[device]]\nname = \"a\"\noffset_ms = 2001\nmeasured = \"tap\"\n")
                  .find("offset_ms is 2001, must be"),
              std::string::npos);
    EXPECT_NE(fault_of_offsets(std::string(kHead) + "device = 3\n").find("list of tables"),
              std::string::npos);
    EXPECT_NE(fault_of_offsets(std::string(kHead) + "[[\n"), "");
}

TEST(DeviceOffsetsFile, that_is_damaged_ends_in_one_line) {
    DeviceOffsets offsets;
    offsets.set({"Monitor of Speakers", milliseconds(143), "loop"});
    offsets.set({"Headphones", milliseconds(-20), "tap"});
    for (std::uint64_t seed = 0; seed < 2000; ++seed) {
        const std::string error = fault_of_offsets(
            test::mangled(offsets.to_toml(), {.seed = seed, .bytes = 1 + seed % 7}));
        EXPECT_EQ(error.find('\n'), std::string::npos) << error;
        EXPECT_TRUE(error.empty() || error.starts_with("devices.toml")) << error;
    }
}

}  // namespace
}  // namespace raks::engine
