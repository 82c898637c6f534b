#include "engine/midi/midi_map.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <chrono>

#include "engine/control/remote_request.hpp"
#include "tests/support/mangled.hpp"

namespace raks::engine {
namespace {

using Kind = MidiMessage::Kind;

constexpr const char* kBox = "knob box";
constexpr const char* kMapHead = "format = \"raks-midi\"\nversion = 1\n";

MidiMessage control(int number, int value, int channel = 1) {
    return {Kind::control,
            static_cast<std::uint8_t>(channel),
            static_cast<std::uint8_t>(number),
            static_cast<std::uint8_t>(value),
            HostTime(std::chrono::seconds(number))};
}
MidiMessage note(int number, int value) {
    MidiMessage message = control(number, value);
    message.kind = Kind::note;
    return message;
}

MidiMap map_of(const MidiMessage& message, const MidiWish& wish) {
    MidiMap map;
    EXPECT_TRUE(map.set({kBox, MidiControl::of(message), wish}));
    return map;
}

std::string fault_of_map(const std::string& toml) {
    const auto map = MidiMap::parse(toml, "midi.toml");
    return map ? "" : map.error().message;
}

std::string control_with(const std::string& line) {
    return std::string(kMapHead) +
           "[[control]]\ndevice = \"box\"\nmessage = \"control\"\nchannel = 1\nnumber = 7\n" + line;
}

TEST(MidiMap, says_what_was_written) {
    MidiMap map;
    ASSERT_TRUE(map.set({"box \"A\" \\", MidiControl{Kind::note, 10, 36}, {Action::tap_tempo}}));
    ASSERT_TRUE(
        map.set({kBox, MidiControl{Kind::control, 1, 21}, {Action::nudge_beats, 0.0, true}}));
    ASSERT_TRUE(map.set({kBox, MidiControl{Kind::program, 16, 127}, {Action::volume, -0.05}}));
    // The control of a device has one thing to ask for.
    ASSERT_TRUE(map.set({kBox, MidiControl{Kind::control, 1, 21}, {Action::seek, 5.0}}));
    const auto read = MidiMap::parse(map.to_toml(), "midi.toml");
    ASSERT_TRUE(read) << read.error().message << '\n' << map.to_toml();
    ASSERT_EQ(read->entries().size(), 3U);
    EXPECT_EQ(read->to_toml(), map.to_toml());
    EXPECT_EQ(*read->find(kBox, {Kind::control, 1, 21}), (MidiWish{Action::seek, 5.0}));
    EXPECT_EQ(*read->find(kBox, {Kind::program, 16, 127}), (MidiWish{Action::volume, -0.05}));
    EXPECT_EQ(read->find(kBox, {Kind::note, 10, 36}), nullptr);
}

TEST(MidiMap, forgets_what_a_device_asks_for) {
    MidiMap map = map_of(note(1, 1), {Action::tap_tempo});
    ASSERT_TRUE(map.set({kBox, {Kind::note, 1, 2}, {Action::tap_tempo}}));
    EXPECT_EQ(map.controls_of(kBox, {Action::tap_tempo}).size(), 2U);
    map.forget("another", {Action::tap_tempo});
    map.forget(kBox, {Action::tap_tempo});
    EXPECT_TRUE(map.entries().empty());
}

TEST(MidiMap, complains_in_one_line_with_its_place) {
    EXPECT_EQ(fault_of_map("format = \"x\"\nversion = 1\n"),
              "midi.toml: format must be \"raks-midi\"");
    EXPECT_EQ(fault_of_map("format = \"raks-midi\"\nversion = 2\n"),
              "midi.toml: version must be a number up to 1; is Raks older than the file?");
    EXPECT_EQ(fault_of_map(std::string(kMapHead) + "control = 5\n"),
              "midi.toml: line 3: control must be a list of tables, [[control]]");
    struct Row {
        const char* line;
        const char* part;
    };
    for (const auto& [line, part] :
         {Row{"action = \"tab\"\nby = \"press\"\n", "tap"},
          Row{"action = \"quit\"\nby = \"press\"\n", "no control asks"},
          Row{"action = \"tap\"\n", "needs by = \"press\""},
          Row{"action = \"tap\"\nby = \"turn\"\n", "takes no turns"},
          Row{"action = \"tap\"\nby = \"press\"\nknob = 1\n", "knob"},
          Row{"action = \"nudge\"\nby = \"press\"\nvalue = 900.0\n", "900 ms is too far"},
          Row{"action = \"select-figure\"\nby = \"press\"\nvalue = 1.5\n", "whole number"}}) {
        const std::string fault = fault_of_map(control_with(line));
        EXPECT_NE(fault.find(part), std::string::npos) << line << fault;
        EXPECT_EQ(fault.find('\n'), std::string::npos) << fault;
    }
}

TEST(MidiMap, survives_any_damage) {
    const std::string good = control_with("action = \"nudge\"\nby = \"press\"\nvalue = -10.0\n");
    ASSERT_EQ(fault_of_map(good), "");
    for (std::size_t end = 0; end < good.size(); ++end) {
        static_cast<void>(fault_of_map(good.substr(0, end)));
    }
    for (std::uint64_t seed = 1; seed <= 300; ++seed) {
        static_cast<void>(fault_of_map(test::mangled(good, {.seed = seed})));
    }
}

TEST(MidiWishes, are_all_that_keys_ask_for_but_the_end) {
    const auto wishes = midi_wishes([](Action) { return true; });
    const auto has = [&](const MidiWish& wish) {
        return std::find(wishes.begin(), wishes.end(), wish) != wishes.end();
    };
    EXPECT_TRUE(has({Action::tap_tempo}));
    EXPECT_TRUE(has({Action::nudge_beats, -10.0}));
    EXPECT_TRUE(has({Action::nudge_beats, 10.0}));
    EXPECT_TRUE(has({Action::nudge_beats, 0.0, true}));
    EXPECT_TRUE(has({Action::select_figure, 9.0}));
    EXPECT_FALSE(has({Action::quit}));
    EXPECT_FALSE(has({Action::learn_midi}));
    for (const MidiWish& wish : wishes) {
        EXPECT_EQ(std::count(wishes.begin(), wishes.end(), wish), 1) << in_words(wish);
        MidiMap map;
        ASSERT_TRUE(map.set({kBox, {Kind::control, 1, 1}, wish}));
        EXPECT_TRUE(MidiMap::parse(map.to_toml(), "midi.toml")) << map.to_toml();
    }
    EXPECT_EQ(in_words({Action::nudge_beats, -10.0}), "beats earlier, later: -10 ms");
    EXPECT_EQ(in_words({Action::nudge_beats, 0.0, true}), "beats earlier, later: by a knob");
}

TEST(MidiReader, a_press_asks_once_with_its_moment) {
    MidiReader reader;
    const MidiMap keys = map_of(note(36, 1), {Action::tap_tempo});
    const std::vector<MidiMessage> pressed = {note(36, 90), note(36, 0), note(36, 1), note(37, 9)};
    const auto taps = reader.requests(keys, kBox, pressed);
    ASSERT_EQ(taps.size(), 2U);
    EXPECT_EQ(taps[0].action, Action::tap_tempo);
    EXPECT_EQ(taps[0].came, pressed[0].came);
    EXPECT_TRUE(reader.requests(keys, "another box", pressed).empty());
    // A button that sends a controller: down, held, up, down.
    const MidiMap button = map_of(control(64, 1), {Action::nudge_beats, 10.0});
    const auto nudges = reader.requests(
        button,
        kBox,
        std::vector{control(64, 127), control(64, 127), control(64, 0), control(64, 100)});
    ASSERT_EQ(nudges.size(), 2U);
    EXPECT_EQ(nudges[0].value, 10.0);
}

TEST(MidiReader, a_knob_never_jumps_and_its_turns_are_one_request) {
    MidiReader reader;
    const MidiMap map = map_of(control(7, 0), {Action::volume, 0.0, true});
    EXPECT_TRUE(reader.requests(map, kBox, std::vector{control(7, 100)}).empty())
        << "it stands somewhere: nothing is asked for";
    const auto softer =
        reader.requests(map, kBox, std::vector{control(7, 99), control(7, 95), control(7, 90)});
    ASSERT_EQ(softer.size(), 1U);
    EXPECT_NEAR(softer[0].value, -0.10, 1e-9);
    const auto louder = reader.requests(map, kBox, std::vector{control(7, 127), control(7, 0)});
    ASSERT_EQ(louder.size(), 1U);
    EXPECT_NEAR(louder[0].value, -0.90, 1e-9);
    // Each request is one that the table takes as it is.
    const auto far = reader.requests(map, kBox, std::vector{control(7, 127)});
    ASSERT_EQ(far.size(), 1U);
    EXPECT_EQ(take_value(row_of(Action::volume), far[0].value)->remark, "");
}

TEST(MidiReader, a_flood_asks_for_no_more_than_there_is_room_for) {
    MidiReader reader;
    const MidiMap map = map_of(note(36, 1), {Action::tap_tempo});
    const std::vector<MidiMessage> flood(10'000, note(36, 90));
    EXPECT_EQ(reader.requests(map, kBox, flood).size(), MidiReader::kMostRequests);
}

}  // namespace
}  // namespace raks::engine
