#include "base/suggest.hpp"

#include <gtest/gtest.h>

#include <array>

namespace raks {
namespace {

constexpr std::array<std::string_view, 3> kNames = {"stage", "workshop_dark", "studio_light"};

TEST(Suggest, a_slip_of_the_finger_finds_the_name) {
    EXPECT_EQ(nearest_name("stgae", kNames), "stage");
    EXPECT_EQ(nearest_name("Workshop-Dark", kNames), "workshop_dark");
    EXPECT_EQ(suggestion("stag", kNames), "; did you mean \"stage\"?");
}

TEST(Suggest, something_else_lists_what_is_known) {
    EXPECT_EQ(nearest_name("xyzzy", kNames), "");
    EXPECT_EQ(suggestion("xyzzy", kNames), "; known: stage, workshop_dark, studio_light");
}

// Names may come from files, as those of postures do.
TEST(Suggest, no_name_reaches_a_terminal_as_it_is) {
    constexpr std::array<std::string_view, 1> kOdd = {"sta\nge"};
    EXPECT_EQ(suggestion("stage", kOdd), "; did you mean \"sta?ge\"?");
    EXPECT_EQ(suggestion("xyzzy", kOdd), "; known: sta?ge");
    EXPECT_EQ(unknown_name("theme", "\x1b[2J", kNames),
              "theme \"?[2J\" is unknown; known: stage, workshop_dark, studio_light");
}

}  // namespace
}  // namespace raks
