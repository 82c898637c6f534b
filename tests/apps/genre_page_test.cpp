#include "apps/reports/genre_page.hpp"

#include <gtest/gtest.h>

#include <string>

namespace raks::apps {
namespace {

/// Two genres; of the second no piece was judged.
GenrePage small_page() {
    audio::GenreTally tally;
    tally.macro_recall = 0.75;
    tally.confusion = {{0.75, 0.25, 0.0}, {0.0, 0.0, 0.0}, {0.0, 0.0, 0.0}};
    tally.pieces = {4, 0, 0};
    tally.reliability[7] = {2.0, 1.5, 1.0};
    GenrePage page;
    page.title = "a <b> & c";
    page.genres = {"salsa", "waltz"};
    page.rows = {{"fused", 1.0, tally}, {"fused", 5.0, tally}};
    page.files = {{"good.ogg", "salsa", 0.9}, {"<bad>.ogg", "salsa", 0.1}};
    return page;
}

bool has(const std::string& text, const std::string& part) {
    return text.find(part) != std::string::npos;
}

TEST(GenrePage, shows_what_is_taken_for_what_of_genres_that_were_judged) {
    const std::string html = draw_genre_page(small_page());
    EXPECT_TRUE(has(html,
                    "<td>salsa</td><td class=\"own\">0.75</td><td class=\"wrong\">0.25</td>"
                    "<td>4</td>"));
    EXPECT_FALSE(has(html, "<td>waltz</td>"));
    EXPECT_EQ(html, draw_genre_page(small_page()));
}

TEST(GenrePage, charts_have_a_dot_a_window_on_axes_with_numbers) {
    const std::string html = draw_genre_page(small_page());
    // 560 x 280 with 46, 8, 10 and 34 around: 1 s is a tenth of the width, .75 a quarter down.
    EXPECT_TRUE(has(html, "<circle cx=\"96.6\" cy=\"69.0\""));
    EXPECT_TRUE(has(html, "<circle cx=\"299.0\" cy=\"69.0\""));
    EXPECT_TRUE(has(html, ">10</text>"));
}

TEST(GenrePage, names_the_files_that_fail_and_none_is_markup) {
    const std::string html = draw_genre_page(small_page());
    EXPECT_TRUE(has(html, "a &lt;b&gt; &amp; c"));
    EXPECT_TRUE(has(html, "&lt;bad&gt;.ogg"));
    EXPECT_FALSE(has(html, "good.ogg"));
}

}  // namespace
}  // namespace raks::apps
