#include "engine/control/action_table.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <filesystem>
#include <limits>
#include <set>
#include <string>
#include <string_view>
#include <utility>

#include "base/file.hpp"

namespace raks::engine {
namespace {

constexpr double kInfinity = std::numeric_limits<double>::infinity();

KeyEvent event_of(const ActionKey& key) { return {.key = key.key, .has_shift = key.has_shift}; }

TEST(ActionTable, has_every_action_once_in_order) {
    ASSERT_EQ(action_table().size(), kActionCount);
    for (std::size_t i = 0; i < kActionCount; ++i) {
        EXPECT_EQ(static_cast<std::size_t>(action_table()[i].action), i);
        EXPECT_EQ(&row_of(static_cast<Action>(i)), &action_table()[i]);
    }
}

/// The row of an action in the manual's table: "| `seek` | Left, Right | ... |".
std::string manual_row(const std::string& page, std::string_view name) {
    std::size_t at = page.find("\n| `" + std::string(name) + "`");
    if (at == std::string::npos) {  // the second of two in a row
        at = page.find(", `" + std::string(name) + "` |");
        at = at == std::string::npos ? at : page.rfind('\n', at);
    }
    return at == std::string::npos ? "" : page.substr(at + 1, page.find('\n', at + 1) - at - 1);
}

TEST(ActionTable, is_in_the_manual_with_all_keys) {
    const auto page = read_file(std::filesystem::path(RAKS_SOURCE_DIR) / "docs/reference/keys.md");
    ASSERT_TRUE(page) << page.error().message;
    for (const ActionRow& row : action_table()) {
        const std::string told = manual_row(*page, row.name);
        EXPECT_NE(told, "") << "docs/reference/keys.md: " << row.name << " is missing";
        const bool is_range = row.action == Action::select_figure;  // "1 to 9"
        for (const ActionKey& key : row.keys()) {
            EXPECT_TRUE(is_range || told.find(key.name) != std::string::npos)
                << row.name << ": " << key.name;
        }
    }
}

TEST(ActionTable, every_action_has_a_name_a_line_of_help_and_a_key_of_its_own) {
    std::set<std::string_view> names;
    std::set<std::string_view> helps;
    for (const ActionRow& row : action_table()) {
        EXPECT_TRUE(names.insert(row.name).second) << row.name;
        EXPECT_TRUE(helps.insert(row.help).second) << row.help;
        EXPECT_EQ(row.name.find_first_not_of("abcdefghijklmnopqrstuvwxyz-"), std::string::npos)
            << row.name << ": small letters and hyphens, as a path of OSC or a shell's word";
        EXPECT_FALSE(row.name.empty());
        EXPECT_FALSE(row.help.empty());
        // What takes a name or sets a value can be asked for by a remote control alone.
        const bool sets = row.value && row.value->kind == ValueKind::level;
        EXPECT_TRUE(!row.keys().empty() || row.text != TextKind::none || sets) << row.name;
    }
}

TEST(ActionTable, no_key_asks_for_two_things) {
    std::set<std::pair<Key, bool>> keys;
    std::set<std::string_view> names;
    for (const ActionRow& row : action_table()) {
        for (const ActionKey& key : row.keys()) {
            EXPECT_TRUE(keys.insert({key.key, key.has_shift}).second) << key.name;
            EXPECT_TRUE(names.insert(key.name).second) << key.name;
        }
    }
}

TEST(ActionTable, every_key_asks_for_its_row_with_its_value) {
    for (const ActionRow& row : action_table()) {
        for (const ActionKey& key : row.keys()) {
            EXPECT_EQ(request_of(event_of(key)), (ActionRequest{row.action, key.value}))
                << key.name;
        }
    }
}

TEST(ActionTable, every_key_gives_a_value_that_its_action_takes_as_it_is) {
    for (const ActionRow& row : action_table()) {
        for (const ActionKey& key : row.keys()) {
            const auto taken = take_value(row, key.value);
            ASSERT_TRUE(taken) << key.name << taken.error().message;
            EXPECT_EQ(taken->value, key.value) << key.name;
            EXPECT_EQ(taken->remark, "") << key.name;
            EXPECT_EQ(row.value.has_value(), key.value != 0.0) << key.name;
        }
    }
}

TEST(ActionTable, every_name_is_found_and_a_wrong_one_gets_the_nearest) {
    for (const ActionRow& row : action_table()) {
        const auto found = find_action(row.name);
        ASSERT_TRUE(found) << row.name;
        EXPECT_EQ(*found, &row);
    }
    const auto near = find_action("half-tmpo");
    ASSERT_FALSE(near);
    EXPECT_EQ(near.error().message,
              "action \"half-tmpo\" is unknown; did you mean \"half-tempo\"?");
    EXPECT_FALSE(find_action(""));
}

TEST(ActionTable, keys_give_the_steps_that_the_manual_names) {
    EXPECT_EQ(request_of({.key = Key::left}), (ActionRequest{Action::seek, -5.0}));
    EXPECT_EQ(request_of({.key = Key::right}), (ActionRequest{Action::seek, 5.0}));
    EXPECT_EQ(request_of({.key = Key::left, .has_shift = true}),
              (ActionRequest{Action::seek, -30.0}));
    EXPECT_EQ(request_of({.key = Key::right, .has_shift = true}),
              (ActionRequest{Action::seek, 30.0}));
    EXPECT_EQ(request_of({.key = Key::up}), (ActionRequest{Action::volume, 0.05}));
    EXPECT_EQ(request_of({.key = key_of(U',')}), (ActionRequest{Action::nudge_beats, -10.0}));
    EXPECT_EQ(request_of({.key = Key::page_up}), (ActionRequest{Action::latency, 5.0}));
    EXPECT_EQ(request_of({.key = key_of(U'7')}), (ActionRequest{Action::select_figure, 7.0}));
}

TEST(ActionTable, characters_count_as_typed_whether_or_not_shift_made_them) {
    const ActionRequest help{Action::toggle_help, 0.0};
    EXPECT_EQ(request_of({.key = key_of(U'?'), .has_shift = true}), help);
    EXPECT_EQ(request_of({.key = key_of(U'?'), .has_shift = false}), help);
    EXPECT_EQ(request_of({.key = key_of(U'S'), .has_shift = true}),
              (ActionRequest{Action::toggle_figure_view, 0.0}));
}

TEST(ActionTable, a_held_key_repeats_steps_alone) {
    for (const ActionRow& row : action_table()) {
        const bool is_step = row.value && row.value->kind == ValueKind::step;
        for (const ActionKey& key : row.keys()) {
            KeyEvent event = event_of(key);
            event.is_repeat = true;
            EXPECT_EQ(request_of(event).has_value(), is_step) << key.name;
        }
    }
}

TEST(ActionTable, unknown_keys_and_control_ask_for_nothing) {
    EXPECT_EQ(request_of({.key = key_of(U'z')}), std::nullopt);
    EXPECT_EQ(request_of({.key = Key::f2, .has_control = true}), std::nullopt);
    EXPECT_EQ(request_of({.key = Key{}}), std::nullopt);
    EXPECT_EQ(request_of({.key = key_of(U'q'), .has_control = true}), std::nullopt);
}

TEST(ActionTable, a_step_too_far_is_clamped_and_that_is_said) {
    struct Case {
        Action action;
        double given;
        double taken;
        const char* remark;
    };
    const std::array cases = {
        Case{Action::seek, 1e9, 36'000.0, "action seek: 1e+09 s is too far, 36000 s is taken"},
        Case{Action::volume, -1.5, -1.0, "action volume: -1.5 is too far, -1 is taken"},
        Case{Action::nudge_beats, 501.0, 500.0, "action nudge: 501 ms is too far, 500 ms is taken"},
        Case{Action::change_tempo,
             -kInfinity,
             -100.0,
             "action tempo: -inf BPM is too far, -100 BPM is taken"},
        Case{Action::latency, 500.0, 500.0, ""},
        Case{Action::quit, 1e300, 0.0, ""},
    };
    for (const Case& row : cases) {
        const auto taken = take_value(row_of(row.action), row.given);
        ASSERT_TRUE(taken) << row.remark;
        EXPECT_EQ(taken->value, row.taken) << row.remark;
        EXPECT_EQ(taken->remark, row.remark);
    }
}

TEST(ActionTable, values_that_mean_nothing_are_refused) {
    struct Case {
        Action action;
        double given;
        const char* error;
    };
    const std::array cases = {
        Case{Action::seek, std::nan(""), "action seek: its value is not a number"},
        Case{Action::quit, std::nan(""), "action quit: its value is not a number"},
        Case{Action::select_figure,
             0.0,
             "action select-figure: 0 must be a whole number from 1 to 64"},
        Case{Action::select_figure,
             2.5,
             "action select-figure: 2.5 must be a whole number from 1 to 64"},
        Case{Action::select_figure,
             kInfinity,
             "action select-figure: inf must be a whole number from 1 to 64"},
    };
    for (const Case& row : cases) {
        const auto taken = take_value(row_of(row.action), row.given);
        ASSERT_FALSE(taken) << row.error;
        EXPECT_EQ(taken.error().message, row.error);
    }
}

}  // namespace
}  // namespace raks::engine

namespace raks::engine {
namespace {

std::vector<HelpLine> all_lines() {
    return help_lines([](Action) { return true; });
}

const HelpLine* line_of(const std::vector<HelpLine>& lines, std::string_view text) {
    const auto at = std::find_if(
        lines.begin(), lines.end(), [&](const HelpLine& line) { return line.text == text; });
    return at == lines.end() ? nullptr : &*at;
}

TEST(HelpLines, say_each_thing_once_with_its_keys_group_by_group) {
    const auto lines = all_lines();
    std::set<std::string_view> texts;
    for (const HelpLine& line : lines) {
        EXPECT_TRUE(texts.insert(line.text).second) << line.text;
        EXPECT_FALSE(line.keys.empty()) << line.text;
        EXPECT_FALSE(title_of(line.group).empty());
    }
    EXPECT_TRUE(std::is_sorted(lines.begin(), lines.end(), [](const auto& a, const auto& b) {
        return a.group < b.group;
    }));
}

TEST(HelpLines, put_keys_of_one_thing_on_one_line) {
    using Keys = std::vector<std::string>;
    const auto lines = all_lines();
    ASSERT_NE(line_of(lines, "back, forward 5 s"), nullptr);
    EXPECT_EQ(line_of(lines, "back, forward 5 s")->keys, (Keys{"Left", "Right"}));
    EXPECT_EQ(line_of(lines, "back, forward 30 s")->keys, (Keys{"Shift+Left", "Shift+Right"}));
    EXPECT_EQ(line_of(lines, "full screen")->keys, (Keys{"F", "F11"}));
    EXPECT_EQ(line_of(lines, "this figure")->keys,
              (Keys{"1", "2", "3", "4", "5", "6", "7", "8", "9"}));
}

TEST(HelpLines, name_every_key_of_the_table) {
    std::set<std::string> named;
    for (const HelpLine& line : all_lines()) {
        named.insert(line.keys.begin(), line.keys.end());
    }
    for (const ActionRow& row : action_table()) {
        for (const ActionKey& key : row.keys()) {
            EXPECT_EQ(named.count(std::string(key.name)), 1U) << key.name;
        }
    }
}

TEST(HelpLines, leave_out_what_is_not_there) {
    const auto lines = help_lines([](Action action) { return action == Action::quit; });
    ASSERT_EQ(lines.size(), 1U);
    EXPECT_EQ(lines[0].text, "quit");
    EXPECT_TRUE(help_lines([](Action) { return false; }).empty());
}

TEST(ActionTable, a_text_is_one_line_of_utf8_and_a_backdrop_is_one) {
    const ActionRow& preset = row_of(Action::choose_preset);
    EXPECT_TRUE(check_text(preset, "My show \u00e9"));
    EXPECT_TRUE(check_text(preset, std::string(255, 'x')));
    for (const std::string& bad :
         {std::string(), std::string(256, 'x'), std::string("a\nb"), std::string("\xff")}) {
        EXPECT_FALSE(check_text(preset, bad)) << bad;
    }
    const ActionRow& backdrop = row_of(Action::next_backdrop);
    for (const char* const good : {"stage", "transparent", "#00ff00"}) {
        EXPECT_TRUE(check_text(backdrop, good)) << good;
    }
    EXPECT_FALSE(check_text(backdrop, "green"));
    EXPECT_EQ(check_text(row_of(Action::quit), "now").error().message,
              "action quit: it takes no name");
}

}  // namespace
}  // namespace raks::engine
