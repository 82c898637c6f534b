#include "audio/genre/training/genre_page.hpp"

#include <gtest/gtest.h>

#include <string>

namespace raks::audio {
namespace {

/// Two genres; of the second no piece was judged.
GenrePage small_page() {
    GenreTally tally;
    tally.macro_recall = 0.75;
    tally.confusion = {{0.75, 0.25, 0.0}, {0.0, 0.0, 0.0}, {0.0, 0.0, 0.0}};
    tally.pieces = {4, 0, 0};
    tally.reliability[7] = {2.0, 1.5, 1.0};
    GenrePage page;
    page.title = "a <b> & c";
    page.genres = {Genre::salsa, Genre::waltz};
    page.rows = {{"fused", 1.0, tally}, {"fused", 5.0, tally}};
    page.files = {{"good.ogg", Genre::salsa, 0.9}, {"<bad>.ogg", Genre::salsa, 0.1}};
    return page;
}

bool has(const std::string& text, const std::string& part) {
    return text.find(part) != std::string::npos;
}

TEST(GenrePage, shows_confusion_and_dashes_where_nothing_was_judged) {
    const std::string html = genre_page(small_page());
    EXPECT_TRUE(has(html,
                    "<th>salsa</th><td style='background:rgba(30,132,73,0.45)'>0.75</td>"
                    "<td style='background:rgba(192,57,43,0.15)'>0.25</td><td>4</td>"));
    EXPECT_TRUE(has(html, "<th>waltz</th><td>-</td><td>-</td><td>0</td>"));
    EXPECT_EQ(html, genre_page(small_page()));
}

TEST(GenrePage, charts_have_a_dot_a_window_on_axes_with_numbers) {
    const std::string html = genre_page(small_page());
    // 560 x 300 with margins of 44: 1 s is a tenth of the width, .75 three quarters of the height.
    EXPECT_TRUE(has(html, "<circle cx='91.2' cy='97.0'"));
    EXPECT_TRUE(has(html, "<circle cx='280.0' cy='97.0'"));
    EXPECT_TRUE(has(html, "text-anchor='middle'>10</text>"));
}

TEST(GenrePage, names_the_files_that_fail_and_none_is_markup) {
    const std::string html = genre_page(small_page());
    EXPECT_TRUE(has(html, "a &lt;b&gt; &amp; c"));
    EXPECT_TRUE(has(html, "&lt;bad&gt;.ogg"));
    EXPECT_FALSE(has(html, "good.ogg"));
}

}  // namespace
}  // namespace raks::audio
