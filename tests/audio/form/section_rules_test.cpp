#include "audio/form/section_rules.hpp"

#include <gtest/gtest.h>

namespace raks::audio {
namespace {

/// A band through a limiter: its bars hardly differ.
FullBand limited() {
    return {
        .usual = {.low = 40.0F, .level = -10.0F, .top = 43.0F, .low_onsets = 0.1F, .onsets = 0.3F},
        .low_spread = 1.2F,
        .level_spread = 0.6F,
        .top_spread = 2.0F};
}

TEST(SectionRules, drums_that_leave_are_a_breakdown_whatever_the_level) {
    const FullBand full = limited();
    EXPECT_LT(calmness(full.usual, full), kFullBelow);
    StretchSound guitars = full.usual;
    guitars.top -= 12.0F;
    guitars.low -= 6.0F;
    EXPECT_GT(calmness(guitars, full), 0.5F);
    EXPECT_GT(calmness(guitars, full) - calmness(full.usual, full), kLeastStep);
}

TEST(SectionRules, a_softer_verse_of_the_whole_band_is_none) {
    const FullBand full = limited();
    StretchSound verse = full.usual;
    for (const auto part : {&StretchSound::low, &StretchSound::level, &StretchSound::top}) {
        verse.*part -= 3.0F;
    }
    EXPECT_LT(calmness(verse, full), 0.0F);
}

TEST(SectionRules, what_comes_in_is_louder_and_has_all_that_was_not_there) {
    const StretchSound band = limited().usual;
    StretchSound guitar = band;
    guitar.level -= 5.0F;
    guitar.low -= 8.0F;
    guitar.top -= 15.0F;
    EXPECT_TRUE(comes_in(guitar, band));
    // A further layer of a song that grows.
    StretchSound hats = band;
    hats.top -= 20.0F;
    EXPECT_FALSE(comes_in(hats, band));
    StretchSound bass = band;
    bass.low -= 20.0F;
    EXPECT_FALSE(comes_in(bass, band));
}

}  // namespace
}  // namespace raks::audio
