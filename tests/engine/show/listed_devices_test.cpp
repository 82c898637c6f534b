#include "engine/show/listed_devices.hpp"

#include <gtest/gtest.h>

namespace raks::engine {
namespace {

TEST(ListedDevices, are_read_as_the_command_prints_them) {
    const auto devices = parse_devices(R"({"format": "raks-devices", "version": 2, "devices": [
        {"number": 0, "name": "Monitor of Speakers", "id": "s.monitor", "host_api": "PipeWire",
         "inputs": 2, "outputs": 0, "monitor": true, "monitor_of": "Speakers", "level_dbfs": -12.5},
        {"name": "Speakers", "host_api": "PipeWire", "inputs": 0, "outputs": 2}, 7]})");
    ASSERT_TRUE(devices) << devices.error().message;
    ASSERT_EQ(devices->size(), 2U);
    EXPECT_EQ((*devices)[0].name, "Monitor of Speakers");
    EXPECT_EQ((*devices)[0].monitor_of, "Speakers");
    EXPECT_TRUE((*devices)[0].is_input);
    EXPECT_FALSE((*devices)[0].is_output);
    EXPECT_EQ((*devices)[0].level_dbfs, -12.5F);
    EXPECT_TRUE((*devices)[1].is_output);
    EXPECT_FALSE((*devices)[1].level_dbfs);
}

TEST(ListedDevices, what_is_no_such_document_is_an_error) {
    for (const char* const text : {"",
                                   "no sound",
                                   "[]",
                                   "{}",
                                   R"({"devices": 3})",
                                   R"({"devices": [{"name": 3}]})",
                                   R"({"devices": [{"inputs": "two"}]})"}) {
        EXPECT_FALSE(parse_devices(text)) << text;
    }
}

}  // namespace
}  // namespace raks::engine
