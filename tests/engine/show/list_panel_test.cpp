#include "engine/show/list_panel.hpp"

#include <gtest/gtest.h>

#include <string>
#include <utility>
#include <vector>

namespace raks::engine {
namespace {

/// What a list has told its offer, as "take 0 2 typed" and "check 0 1".
using Told = std::vector<std::string>;

class TwoPages final : public ListOffer {
 public:
    explicit TwoPages(Told& told, std::vector<render::ListRow>& rows) : told_(told), rows_(rows) {}

    [[nodiscard]] std::vector<ListPage> pages() override {
        ListPage named{.title = "Save", .rows = {{.text = "save it"}}};
        named.finds_typed = false;
        return {{.title = "First", .rows = rows_}, std::move(named)};
    }
    [[nodiscard]] bool take(std::size_t page, std::size_t row, std::string_view typed) override {
        told_.push_back("take " + std::to_string(page) + " " + std::to_string(row) + " " +
                        std::string(typed));
        return true;
    }
    void check(std::size_t page, std::size_t row) override {
        told_.push_back("check " + std::to_string(page) + " " + std::to_string(row));
    }

 private:
    Told& told_;
    std::vector<render::ListRow>& rows_;
};

class ListPanelTest : public ::testing::Test {
 protected:
    void SetUp() override { open(); }
    void open() { panel_.open(std::make_unique<TwoPages>(told_, rows_), "things"); }
    void press(Key key) { EXPECT_TRUE(panel_.handle({.key = key})); }
    void type(std::string_view text) {
        for (const char c : text) {
            press(key_of(static_cast<char32_t>(c)));
        }
    }
    [[nodiscard]] std::string chosen() {
        const auto look = panel_.look();
        return look && look->chosen < look->rows.size() ? look->rows[look->chosen].text : "";
    }

    Told told_;
    std::vector<render::ListRow> rows_ = {{.text = "LISTEN TO", .is_title = true},
                                          {.text = "Microphone"},
                                          {.text = "Monitor", .is_current = true},
                                          {.text = "PLAY ON", .is_title = true},
                                          {.text = "Phones", .is_checked = true}};
    ListPanel panel_;
};

TEST_F(ListPanelTest, begins_at_what_is_in_use_and_goes_over_titles) {
    EXPECT_EQ(chosen(), "Monitor");
    press(Key::down);
    EXPECT_EQ(chosen(), "Phones");
    press(Key::down);
    EXPECT_EQ(chosen(), "Phones") << "the end";
    press(Key::home);
    EXPECT_EQ(chosen(), "Microphone");
    press(Key::up);
    EXPECT_EQ(chosen(), "Microphone") << "a title cannot be chosen";
    press(Key::end);
    press(Key::enter);
    EXPECT_EQ(told_, Told{"take 0 4 "});
    EXPECT_FALSE(panel_.is_open());
}

TEST_F(ListPanelTest, typing_finds_and_taking_back_shows_all_again) {
    type("pho");
    EXPECT_EQ(chosen(), "Microphone") << "the first of two that hold it";
    type("nes");
    EXPECT_EQ(chosen(), "Phones");
    ASSERT_EQ(panel_.look()->rows.size(), 1U) << "titles are of no use here";
    press(Key::enter);
    EXPECT_EQ(told_, Told{"take 0 4 phones"}) << "the row's own number";
    open();
    type("nothing of this name");
    EXPECT_EQ(chosen(), "");
    press(Key::enter);
    EXPECT_EQ(told_.size(), 1U) << "nothing to take";
    for (int i = 0; i < 30; ++i) {
        press(Key::backspace);
    }
    EXPECT_EQ(panel_.look()->rows.size(), rows_.size());
}

TEST_F(ListPanelTest, space_checks_where_there_is_a_box_and_is_a_letter_elsewhere) {
    press(Key::end);
    press(Key::space);
    EXPECT_EQ(told_, Told{"check 0 4"});
    press(Key::home);
    press(Key::space);
    EXPECT_EQ(panel_.look()->typed, " ");
}

TEST_F(ListPanelTest, a_page_that_takes_a_text_gives_it_with_capitals) {
    press(Key::tab);
    EXPECT_EQ(chosen(), "save it");
    EXPECT_TRUE(panel_.handle({.key = key_of(U'm'), .has_shift = true}));
    type("y show");
    press(Key::enter);
    EXPECT_EQ(told_, Told{"take 1 0 My show"});
}

TEST_F(ListPanelTest, characters_are_taken_back_whole) {
    for (const char32_t c : {U'\u00e9', U'\u4e2d', U'\U0001F3B5'}) {
        EXPECT_TRUE(panel_.handle({.key = static_cast<Key>(c)}));
    }
    EXPECT_EQ(panel_.look()->typed, "\u00e9\u4e2d\U0001F3B5");
    press(Key::backspace);
    press(Key::backspace);
    EXPECT_EQ(panel_.look()->typed, "\u00e9");
}

TEST_F(ListPanelTest, the_chosen_row_stays_so_while_others_come_and_go) {
    rows_.insert(rows_.begin() + 1, {.text = "Line in"});
    EXPECT_EQ(panel_.look()->rows.size(), 6U);
    rows_.resize(2);
    EXPECT_EQ(panel_.look()->rows.size(), 2U);
    rows_.clear();
    EXPECT_EQ(chosen(), "");
    press(Key::enter);
    EXPECT_TRUE(told_.empty());
}

TEST_F(ListPanelTest, is_worked_by_a_pointer) {
    panel_.scroll(-1.0);
    EXPECT_EQ(chosen(), "Phones");
    panel_.click(render::OverlaySpot{render::PanelPart::list_box, 4});
    panel_.click(render::OverlaySpot{render::PanelPart::ground});
    panel_.click(render::OverlaySpot{render::PanelPart::list_row, 99});
    EXPECT_TRUE(panel_.is_open());
    panel_.click(render::OverlaySpot{render::PanelPart::list_row, 1});
    EXPECT_EQ(told_, (Told{"check 0 4", "take 0 1 "}));
    open();
    panel_.click(render::OverlaySpot{render::PanelPart::list_page, 1});
    EXPECT_EQ(panel_.page(), 1U);
    panel_.click(std::nullopt);
    EXPECT_FALSE(panel_.is_open()) << "beside it";
}

TEST_F(ListPanelTest, leaves_other_keys_to_others_and_all_of_them_while_it_is_closed) {
    EXPECT_FALSE(panel_.handle({.key = Key::f2}));
    EXPECT_FALSE(panel_.handle({.key = key_of(U'q'), .has_control = true}));
    press(Key::escape);
    EXPECT_FALSE(panel_.is_open());
    EXPECT_EQ(panel_.name(), "");
    EXPECT_FALSE(panel_.handle({.key = Key::enter}));
    EXPECT_FALSE(panel_.look());
}

TEST(ListSearch, finds_each_word_in_any_order) {
    EXPECT_TRUE(is_found("", "anything"));
    EXPECT_TRUE(is_found("two one", "One and Two"));
    EXPECT_FALSE(is_found("two three", "One and Two"));
}

}  // namespace
}  // namespace raks::engine
