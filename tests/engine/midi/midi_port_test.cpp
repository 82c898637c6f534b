#include "engine/midi/midi_port.hpp"

#include <gtest/gtest.h>

namespace raks::engine {
namespace {

TEST(MidiPort, is_found_by_a_part_of_its_name) {
    EXPECT_TRUE(is_midi_port_meant("a2j:nanoKONTROL2 [24] (capture): MIDI 1", "nanokontrol"));
    EXPECT_TRUE(is_midi_port_meant("jack_mclk_dump:mclk_in", "MCLK"));
    EXPECT_FALSE(is_midi_port_meant("system:midi_capture_1", "nano"));
}

TEST(MidiPort, has_a_name_without_the_numbers_of_the_day) {
    EXPECT_EQ(midi_device_name("a2j:nanoKONTROL2 [24] (capture): nanoKONTROL2 MIDI 1"),
              "a2j:nanoKONTROL2 (capture): nanoKONTROL2 MIDI 1");
    EXPECT_EQ(midi_device_name("nanoKONTROL2:nanoKONTROL2 MIDI 1 20:0"),
              "nanoKONTROL2:nanoKONTROL2 MIDI 1");
    EXPECT_EQ(midi_device_name("Midi-Bridge:X-TOUCH MINI 2:(capture_0) X-TOUCH"),
              "Midi-Bridge:X-TOUCH MINI 2:(capture_0) X-TOUCH");
    EXPECT_EQ(midi_device_name("[7]"), "");
    EXPECT_EQ(midi_device_name("a\nb"), "a?b");
}

}  // namespace
}  // namespace raks::engine
