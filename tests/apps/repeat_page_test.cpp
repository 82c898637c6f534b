#include "apps/reports/repeat_page.hpp"

#include <gtest/gtest.h>

#include <string>

#include "tests/training/discovery/stepping_dance.hpp"

namespace raks::apps::repeat_page_test {
namespace {

std::size_t times(const std::string& text, const std::string& what) {
    std::size_t count = 0;
    for (std::size_t at = text.find(what); at != std::string::npos; at = text.find(what, at + 1)) {
        ++count;
    }
    return count;
}

TEST(RepeatPage, shows_every_repeat_as_a_strip_and_which_is_learnt) {
    motion::test::SteppingDance dance;
    dance.raised = {1};
    dance.repeats = 3;
    motion::DiscoveredClips found;
    found.clips.resize(2);
    found.clips[0].take = "<1>";
    found.clips[0].clip = motion::test::stepping_clip(dance);
    found.clips[0].found.beats = 8;
    found.clips[0].found.seconds = 2.88;
    for (int r = 0; r < 3; ++r) {
        found.clips[0].found.repeats.push_back(
            {60.0 * dance.count_1(r), 60.0 * dance.count_1(r + 1), r == 1 ? 0.9 : 0.1, r != 1});
    }
    found.clips[1].take = "2";
    found.clips[1].found.none_because = "nothing in it repeats";
    const std::string page = draw_repeats(found, "basic");
    EXPECT_EQ(page, draw_repeats(found, "basic"));
    EXPECT_EQ(times(page, "<h3"), 3U);
    EXPECT_EQ(times(page, ": learnt</h3>"), 2U);
    EXPECT_EQ(times(page, "an outlier, left out</h3>"), 1U);
    EXPECT_EQ(times(page, "<circle"), 3U * 17U) << "a body on every half beat";
    EXPECT_NE(page.find("<h2>&lt;1&gt;</h2>"), std::string::npos);
    EXPECT_NE(page.find("nothing in it repeats"), std::string::npos);
}

}  // namespace
}  // namespace raks::apps::repeat_page_test
