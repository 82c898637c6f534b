// The styles of music that come with Raks, and what is written in them.
#include "tests/audio/music/shipped_styles.hpp"

#include <gtest/gtest.h>

#include <cstdint>

#include "audio/music/score/arrangement.hpp"
#include "audio/music/styles/style_book.hpp"
#include "base/hash.hpp"

#include <fmt/format.h>

namespace raks::audio {
namespace {

/// The sum of a score, six digits of its beats: the same on every machine.
std::uint64_t sum_of(const Score& score, std::uint64_t sum) {
    for (const ScoreNote& note : score.notes) {
        sum = hash_of(fmt::format("{:.6f} {:.6f} {} {} {} {:.4f} {:.1f}\n",
                                  note.beat,
                                  note.length,
                                  note.channel,
                                  note.key,
                                  note.program,
                                  note.velocity,
                                  note.cents),
                      sum);
    }
    for (const int position : score.bar_position) {
        sum = hash_of(fmt::format("{} ", position), sum);
    }
    return hash_of(fmt::format("{:.4f} {:.4f} {:.4f} {}\n",
                               score.bpm,
                               score.lowest_bpm,
                               score.highest_bpm,
                               score.is_complete ? 1 : 0),
                   sum);
}

// What a shipped model was learnt from can be written again only while these sums stay. Who adds a
// rhythm changes them on purpose.
TEST(ShippedStyles, write_the_music_that_they_always_wrote) {
    const StyleBook& book = shipped_styles();
    std::uint64_t drums = hash_of("");
    for (const RhythmStyle* style : book.rhythms_for_beats()) {
        for (std::uint64_t seed = 0; seed < 4; ++seed) {
            Dice dice(21, seed);
            drums = sum_of(drum_score(*style, 48, dice), drums);
        }
    }
    EXPECT_EQ(drums, 0xa599fa0ce46a742fULL);
    std::uint64_t arranged = hash_of("");
    for (const RhythmStyle& style : book.rhythms) {
        for (std::uint64_t seed = 0; style.label && seed < 8; ++seed) {
            Dice dice(22, seed);
            const auto scales =
                seed % 2 == 1 ? OrientalScales::quarter_tones : OrientalScales::semitones;
            arranged = sum_of(arrange(book, style, 48, dice, scales), arranged);
        }
    }
    EXPECT_EQ(arranged, 0xf896e1f297d0f2bfULL);
}

TEST(ShippedStyles, are_what_they_always_were) {
    const StyleBook& book = shipped_styles();
    EXPECT_EQ(book.rhythms.size(), 91U);
    EXPECT_EQ(book.palettes.size(), 7U);
    EXPECT_EQ(fingerprint(book), 0x2f6535f4f7965903ULL);
}

}  // namespace
}  // namespace raks::audio
