#include "apps/reports/genre_plot.hpp"

#include <gtest/gtest.h>

#include <cmath>

namespace raks::apps {
namespace {

constexpr std::size_t kOwn = static_cast<std::size_t>(GenreVoice::own_parts);
constexpr std::size_t kTagger = static_cast<std::size_t>(GenreVoice::tagger);

bool has_text(const std::string& text, const std::string& part) {
    return text.find(part) != std::string::npos;
}
std::size_t count_texts(const std::string& text, const std::string& part) {
    std::size_t found = 0;
    for (std::size_t at = text.find(part); at != std::string::npos; at = text.find(part, at + 1)) {
        ++found;
    }
    return found;
}

// Ten seconds in which the own parts show salsa from the middle on; the tagger says house from 3 s.
GenreTrack small_track() {
    GenreTrack track;
    track.genres = {"salsa", "house", "waltz"};
    track.is_asked[kOwn] = track.is_asked[kTagger] = true;
    track.seconds = 10.0;
    for (int i = 1; i < 100; ++i) {
        GenreStep& step = track.steps.emplace_back();
        step.seconds = 0.1 * i;
        step.is_heard[kOwn] = true;
        step.is_heard[kTagger] = step.seconds > 3.0;
        step.shown[kOwn] = i < 50 ? 3 : 0;
        step.shown[kTagger] = i < 35 ? 3 : 1;
        const std::array<float, 4> own = {0.6F, 0.2F, 0.01F, 0.19F};
        const std::array<float, 4> tagger = {0.2F, 0.6F, 0.01F, 0.19F};
        for (std::size_t c = 0; c < own.size(); ++c) {
            step.logs[kOwn][c] = std::log(own[c]);
            step.logs[kTagger][c] = std::log(tagger[c]);
        }
    }
    return track;
}

TEST(GenrePlot, has_a_panel_for_each_who_was_asked) {
    const std::string svg = draw_genre_plot(small_track(), "a <clip>", 0);
    EXPECT_TRUE(has_text(svg, "<g id=\"own_parts\">"));
    EXPECT_TRUE(has_text(svg, "<g id=\"tagger\">"));
    EXPECT_FALSE(has_text(svg, "<g id=\"tags\">"));
    EXPECT_EQ(svg, draw_genre_plot(small_track(), "a <clip>", 0));
}

TEST(GenrePlot, says_the_truth_and_who_is_wrong_at_the_end) {
    const std::string svg = draw_genre_plot(small_track(), "a <clip>", 0);
    EXPECT_TRUE(has_text(svg, ">a &lt;clip&gt;: salsa</text>"));
    EXPECT_TRUE(has_text(svg, ">at the end: own parts salsa, tagger house (wrong)</text>"));
    EXPECT_TRUE(has_text(draw_genre_plot(small_track(), "b", 3), ">b: unknown</text>"));
}

TEST(GenrePlot, draws_the_likely_dances_the_truth_thicker) {
    const std::string svg = draw_genre_plot(small_track(), "a", 0);
    EXPECT_EQ(count_texts(svg, "stroke-width=\"3\""), 2U);
    EXPECT_EQ(count_texts(svg, "stroke-width=\"1.5\""), 4U)
        << "house and unknown of both, no waltz";
    EXPECT_FALSE(has_text(svg, ">waltz</text>"));
}

TEST(GenrePlot, the_band_names_what_is_shown) {
    const std::string svg = draw_genre_plot(small_track(), "a", 0);
    EXPECT_EQ(count_texts(svg, "text-anchor=\"middle\">salsa</text>"), 1U);
    EXPECT_EQ(count_texts(svg, "text-anchor=\"middle\">house</text>"), 1U);
    EXPECT_EQ(count_texts(svg, "text-anchor=\"middle\">unknown</text>"), 2U);
}

TEST(GenrePlot, a_file_in_which_nothing_was_heard_is_no_fault) {
    GenreTrack track = small_track();
    track.steps.clear();
    EXPECT_TRUE(has_text(draw_genre_plot(track, "a", 0), "nothing was heard"));
}

}  // namespace
}  // namespace raks::apps
