#include "engine/show/help_list.hpp"

#include <gtest/gtest.h>

#include "engine/control/action_table.hpp"

namespace raks::engine {
namespace {

TEST(HelpList, turns_its_pages_and_closes_behind_the_last) {
    HelpList help;
    const std::vector<render::HelpRow> rows = {{"WINDOW", {"Q"}, "quit"}};
    help.turn(rows);
    help.set_pages(2);
    render::OverlayState overlay;
    help.show(overlay);
    EXPECT_EQ(overlay.help_page, 0U);
    help.turn(rows);
    help.show(overlay);
    EXPECT_EQ(overlay.help_page, 1U);
    help.turn(rows);
    EXPECT_FALSE(help.is_open());
}

TEST(HelpList, a_key_can_be_pressed_by_a_click_on_it) {
    HelpList help;
    help.turn({{"PLAYING", {"Shift+Left", "F99"}, "something"}});
    const auto key = help.key_at({render::PanelPart::key, 0, 0});
    ASSERT_TRUE(key);
    EXPECT_EQ(key->key, Key::left);
    EXPECT_TRUE(key->has_shift);
    EXPECT_FALSE(help.key_at({render::PanelPart::key, 0, 1})) << "no key";
    EXPECT_FALSE(help.key_at({render::PanelPart::key, 0, 2}));
    EXPECT_FALSE(help.key_at({render::PanelPart::key, 1, 0}));
    EXPECT_FALSE(help.key_at({render::PanelPart::list_row, 0, 0}));
}

TEST(HelpList, every_name_in_the_table_is_that_of_its_key) {
    for (const ActionRow& row : action_table()) {
        for (const ActionKey& key : row.keys()) {
            const auto named = key_named(key.name);
            ASSERT_TRUE(named) << key.name;
            EXPECT_EQ(request_of(*named), (ActionRequest{row.action, key.value})) << key.name;
        }
    }
    EXPECT_FALSE(key_named(""));
    EXPECT_FALSE(key_named("F99"));
}

}  // namespace
}  // namespace raks::engine
