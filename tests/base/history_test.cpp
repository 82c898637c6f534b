#include "base/history.hpp"

#include <gtest/gtest.h>

#include <vector>

namespace raks {
namespace {

TEST(History, goes_back_and_forth_through_every_step) {
    History<int> history(1);
    history.change(2);
    history.change(3);
    EXPECT_EQ(history.now(), 3);
    history.undo();
    EXPECT_EQ(history.now(), 2);
    history.undo();
    EXPECT_EQ(history.now(), 1);
    EXPECT_FALSE(history.can_undo());
    history.undo();
    EXPECT_EQ(history.now(), 1);
    history.redo();
    history.redo();
    EXPECT_EQ(history.now(), 3);
    EXPECT_FALSE(history.can_redo());
    history.redo();
    EXPECT_EQ(history.now(), 3);
}

TEST(History, forgets_what_was_taken_back_once_something_new_is_done) {
    History<int> history(1);
    history.change(2);
    history.undo();
    history.change(5);
    EXPECT_FALSE(history.can_redo());
    history.undo();
    EXPECT_EQ(history.now(), 1);
}

TEST(History, counts_no_step_that_changes_nothing) {
    History<int> history(1);
    history.change(1);
    EXPECT_FALSE(history.can_undo());
    history.change(2);
    history.undo();
    history.change(1);
    EXPECT_TRUE(history.can_redo()) << "and what was taken back stays";
}

TEST(History, knows_whether_the_saved_value_is_back) {
    History<std::vector<int>> history({1});
    EXPECT_TRUE(history.is_saved());
    history.change({1, 2});
    EXPECT_FALSE(history.is_saved());
    history.undo();
    EXPECT_TRUE(history.is_saved());
    history.redo();
    history.mark_saved();
    EXPECT_TRUE(history.is_saved());
    history.undo();
    EXPECT_FALSE(history.is_saved());
}

TEST(History, keeps_a_bounded_number_of_steps) {
    constexpr int kSteps = 2 * static_cast<int>(History<int>::kMostSteps);
    History<int> history(0);
    for (int i = 1; i <= kSteps; ++i) {
        history.change(i);
    }
    while (history.can_undo()) {
        history.undo();
    }
    EXPECT_EQ(history.now(), kSteps - static_cast<int>(History<int>::kMostSteps));
}

}  // namespace
}  // namespace raks
