#include "render/overlay/key_bindings.hpp"

#include <gtest/gtest.h>

#include <set>
#include <string>

namespace raks::render {
namespace {

TEST(KeyBindings, no_key_asks_for_two_actions) {
    std::set<std::pair<Key, bool>> seen;
    for (const KeyBinding& binding : key_bindings()) {
        EXPECT_TRUE(seen.insert({binding.key, binding.has_shift}).second) << binding.name;
    }
}

TEST(KeyBindings, every_action_has_a_key_and_one_line_of_help) {
    std::set<Action> bound;
    for (const KeyBinding& binding : key_bindings()) {
        bound.insert(binding.action);
        EXPECT_FALSE(binding.name.empty());
    }
    std::set<Action> explained;
    std::set<std::string_view> texts;
    for (const ActionHelp& help : action_help()) {
        EXPECT_TRUE(explained.insert(help.action).second) << help.text;
        EXPECT_TRUE(texts.insert(help.text).second) << help.text;
        EXPECT_FALSE(help.text.empty());
    }
    EXPECT_EQ(bound.size(), static_cast<std::size_t>(kActionCount));
    EXPECT_EQ(explained, bound);
}

TEST(KeyBindings, the_table_is_what_action_of_answers) {
    for (const KeyBinding& binding : key_bindings()) {
        EXPECT_EQ(action_of({.key = binding.key, .has_shift = binding.has_shift}), binding.action)
            << binding.name;
    }
}

TEST(KeyBindings, characters_count_as_typed_whether_or_not_shift_made_them) {
    EXPECT_EQ(action_of({.key = key_of(U'?'), .has_shift = true}), Action::toggle_help);
    EXPECT_EQ(action_of({.key = key_of(U'?'), .has_shift = false}), Action::toggle_help);
    EXPECT_EQ(action_of({.key = key_of(U'S'), .has_shift = true}), Action::toggle_figure_view);
}

TEST(KeyBindings, shift_makes_a_far_seek) {
    EXPECT_EQ(action_of({.key = Key::left}), Action::seek_back);
    EXPECT_EQ(action_of({.key = Key::left, .has_shift = true}), Action::seek_back_far);
}

TEST(KeyBindings, only_seeking_and_volume_repeat_while_held) {
    for (const KeyBinding& binding : key_bindings()) {
        const bool is_steady = binding.key == Key::left || binding.key == Key::right ||
                               binding.key == Key::up || binding.key == Key::down;
        EXPECT_EQ(action_of({.key = binding.key, .has_shift = binding.has_shift, .is_repeat = true})
                      .has_value(),
                  is_steady)
            << binding.name;
    }
}

TEST(KeyBindings, unknown_keys_and_control_ask_for_nothing) {
    EXPECT_EQ(action_of({.key = key_of(U'z')}), std::nullopt);
    EXPECT_EQ(action_of({.key = Key::f5}), std::nullopt);
    EXPECT_EQ(action_of({.key = key_of(U'q'), .has_control = true}), std::nullopt);
}

}  // namespace
}  // namespace raks::render
