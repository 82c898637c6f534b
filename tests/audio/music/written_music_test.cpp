#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <set>
#include <string>
#include <string_view>

#include "audio/music/instruments/soundfont_band.hpp"
#include "audio/music/score/arrangement.hpp"
#include "audio/music/score/other_music.hpp"
#include "tests/audio/music/shipped_styles.hpp"
#include "tests/support/dances.hpp"
#include "training/genre/written_corpus.hpp"

namespace raks::audio {
namespace {

TEST(WrittenMusic, every_genre_has_rhythms_to_learn_and_one_to_leave_out) {
    const auto dances = raks::test::shipped_dances();
    std::size_t genres = 0;
    for (const std::string_view dance : dances->names()) {
        const auto rhythms = shipped_styles().rhythms_for(dance);
        if (rhythms.empty()) {
            continue;  // danced, but not recognised
        }
        ++genres;
        int kept = 0;
        int left_out = 0;
        for (const RhythmStyle* style : rhythms) {
            ++(style->label->use == DanceLabel::Use::always ? kept : left_out);
        }
        EXPECT_GE(kept, 3) << dance;
        EXPECT_GE(left_out, 1) << dance;
    }
    EXPECT_GE(genres, 6U);
}

TEST(WrittenMusic, arrangements_are_playable_and_repeatable) {
    const StyleBook& book = shipped_styles();
    std::uint64_t number = 0;
    for (const RhythmStyle& style : book.rhythms) {
        Dice dice(3, number);
        Dice again(3, number);
        ++number;
        const Score score = arrange(book, style, 32, dice);
        EXPECT_EQ(score.notes.size(), arrange(book, style, 32, again).notes.size());
        EXPECT_FALSE(score.notes.empty()) << style.name;
        for (const ScoreNote& note : score.notes) {
            ASSERT_TRUE(note.beat >= 0.0 && note.key >= 0 && note.key < 128 && note.program >= 0 &&
                        note.program < 128 && note.channel >= 0 && note.channel < 16)
                << style.name << " key " << note.key;
        }
    }
}

TEST(WrittenMusic, what_cannot_be_danced_to_is_playable_repeatable_and_of_many_kinds) {
    constexpr double kSeconds = 4.0;
    std::set<std::string> names;
    for (std::uint64_t number = 0; number < 60; ++number) {
        Dice dice(5, number);
        Dice again(5, number);
        const WrittenPiece piece = undanceable_piece(shipped_styles(), kSeconds, dice);
        const WrittenPiece same = undanceable_piece(shipped_styles(), kSeconds, again);
        names.insert(piece.name);
        EXPECT_EQ(piece.dance, "");
        EXPECT_EQ(piece.samples, same.samples);
        ASSERT_EQ(piece.performance.notes.size(), same.performance.notes.size());
        double before = 0.0;
        for (const PlayedNote& note : piece.performance.notes) {
            ASSERT_TRUE(note.time >= before && note.length > 0.0) << piece.name;
            ASSERT_TRUE(note.key >= 0 && note.key < 128 && note.program >= 0 &&
                        note.program < 128 && note.velocity > 0 && note.velocity < 128 &&
                        note.channel >= 0 && note.channel < 16)
                << piece.name << " key " << note.key;
            before = note.time;
        }
    }
    EXPECT_EQ(names, (std::set<std::string>{"people", "no pulse", "pads", "solo", "orchestra"}));
}

TEST(WrittenMusic, needs_rhythms_for_each_dance_and_for_none) {
    StyleBook book = shipped_styles();
    WrittenCorpusPlan plan{
        .styles = &book, .soundfonts = {"none.sf2"}, .pieces = 1, .feature_plan = {}};
    const auto without = [&](const char* dance, DanceLabel::Use use) {
        book = shipped_styles();
        std::erase_if(book.rhythms, [&](const RhythmStyle& style) {
            return style.label && style.label->dance == dance && style.label->use == use;
        });
        const auto corpus = write_corpus(plan);
        return corpus ? "no error" : corpus.error().message;
    };
    using Use = DanceLabel::Use;
    EXPECT_EQ(without("", Use::always), "the styles of music have no rhythm with dance = \"none\"");
    plan.families = WrittenCorpusPlan::Families::held_out;
    EXPECT_EQ(without("waltz", Use::held_out),
              "the styles of music have no rhythm with dance = \"waltz\" that is held out");
    plan.families = WrittenCorpusPlan::Families::always;
    EXPECT_EQ(without("rock", Use::always),
              "the styles of music have no rhythm with dance = \"rock\" that is always used");
}

TEST(PlayerBand, takes_every_soundfont_and_stays_near_what_they_have) {
    std::set<std::size_t> soundfonts;
    for (std::uint64_t number = 0; number < 20; ++number) {
        Dice dice(6, number);
        const PlayerBand band = draw_band(4, dice);
        const auto check = [&](const BandPlayer& player, double most_semitones) {
            soundfonts.insert(player.soundfont);
            EXPECT_LE(std::abs(player.semitones), most_semitones);
            EXPECT_TRUE(player.brightness <= 0.0 && player.brightness >= -2.5);
            EXPECT_TRUE(std::abs(player.decay) <= 1.0 && player.level >= -8.0 &&
                        player.level <= 4.0);
        };
        for (const BandPlayer& player : band.channels) {
            check(player, 0.3);
            EXPECT_EQ(player.semitones, band.channels[0].semitones) << "a band is in tune";
        }
        for (const BandPlayer& drummer : band.drummers) {
            check(drummer, 4.0);
        }
        EXPECT_LT(*std::max_element(band.drummer_of_key.begin(), band.drummer_of_key.end()),
                  band.drummers.size());
    }
    EXPECT_EQ(soundfonts, (std::set<std::size_t>{0, 1, 2, 3}));
}

TEST(PlayerBand, the_same_dice_draw_the_same_band_and_others_another) {
    Dice dice(6, 1);
    Dice again(6, 1);
    Dice other(6, 2);
    const PlayerBand band = draw_band(3, dice);
    EXPECT_EQ(band, draw_band(3, again));
    EXPECT_NE(band, draw_band(3, other));
}

}  // namespace
}  // namespace raks::audio
