#include "engine/midi/midi_parser.hpp"

#include <gtest/gtest.h>

#include <vector>

#include "base/random.hpp"
#include "tests/support/realtime_guard.hpp"

namespace raks::engine {
namespace {

using Kind = MidiMessage::Kind;
using Bytes = std::vector<std::uint8_t>;

std::vector<MidiMessage> parse_bytes(const Bytes& bytes) {
    MidiParser parser;
    std::vector<MidiMessage> messages;
    for (const std::uint8_t byte : bytes) {
        if (const auto message = parser.take(byte)) {
            messages.push_back(*message);
        }
    }
    return messages;
}

MidiMessage message(Kind kind, int channel, int number, int value) {
    return {kind,
            static_cast<std::uint8_t>(channel),
            static_cast<std::uint8_t>(number),
            static_cast<std::uint8_t>(value),
            {}};
}

TEST(MidiParser, reads_what_controllers_say) {
    struct Row {
        const char* what;
        Bytes bytes;
        std::vector<MidiMessage> messages;
    };
    const std::vector<Row> rows = {
        {"note", {0x90, 60, 100}, {message(Kind::note, 1, 60, 100)}},
        {"note let go", {0x93, 60, 0}, {message(Kind::note, 4, 60, 0)}},
        {"note off has a speed, which is no value",
         {0x8F, 60, 64},
         {message(Kind::note, 16, 60, 0)}},
        {"controller", {0xB1, 7, 127}, {message(Kind::control, 2, 7, 127)}},
        {"program", {0xC0, 5}, {message(Kind::program, 1, 5, 127)}},
        {"running status",
         {0xB0, 1, 10, 1, 11, 2, 12},
         {message(Kind::control, 1, 1, 10),
          message(Kind::control, 1, 1, 11),
          message(Kind::control, 1, 2, 12)}},
        {"running status of one byte",
         {0xC2, 1, 2},
         {message(Kind::program, 3, 1, 127), message(Kind::program, 3, 2, 127)}},
        {"real-time bytes within a message",
         {0x90, 0xF8, 60, 0xFE, 0xF8, 100, 0xFA, 61, 99},
         {message(Kind::note, 1, 60, 100), message(Kind::note, 1, 61, 99)}},
        {"system-exclusive data",
         {0xB0, 1, 2, 0xF0, 0x7E, 1, 2, 3, 0xF8, 4, 0xF7, 0xB0, 3, 4},
         {message(Kind::control, 1, 1, 2), message(Kind::control, 1, 3, 4)}},
        {"system-exclusive data ends running status",
         {0xB0, 1, 2, 0xF0, 0xF7, 5, 6},
         {message(Kind::control, 1, 1, 2)}},
        {"system-exclusive data without an end",
         {0xF0, 1, 2, 3, 0x90, 60, 1},
         {message(Kind::note, 1, 60, 1)}},
        {"song position", {0xF2, 1, 2, 0x90, 60, 1}, {message(Kind::note, 1, 60, 1)}},
        {"pitch bend, pressures",
         {0xE0, 1, 2, 0xD0, 3, 4, 0xA0, 60, 7, 0xB0, 1, 1},
         {message(Kind::control, 1, 1, 1)}},
        {"cut short", {0x90, 60, 0xB0, 1, 2}, {message(Kind::control, 1, 1, 2)}},
        {"data from nowhere", {1, 2, 3, 0x90, 60, 1}, {message(Kind::note, 1, 60, 1)}},
    };
    for (const auto& [what, bytes, messages] : rows) {
        EXPECT_EQ(parse_bytes(bytes), messages) << what;
    }
}

TEST(MidiParser, keeps_the_rules_of_the_audio_thread) {
    const CounterRandom random(3);
    MidiParser parser;
    std::size_t messages = 0;
    test::RealtimeScope scope;
    for (std::uint64_t i = 0; i < 20'000; ++i) {
        messages += parser.take(static_cast<std::uint8_t>(random.below(i, 256))) ? 1U : 0U;
    }
    const auto found = scope.stop();
    EXPECT_TRUE(found.is_clean()) << found.describe();
    EXPECT_GT(messages, 100U);
}

}  // namespace
}  // namespace raks::engine
