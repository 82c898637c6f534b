// What training reads: a kept corpus and MIDI files, good and bad.
#include <gtest/gtest.h>

#include <cmath>
#include <filesystem>

#include "audio/evaluate/beat_corpus.hpp"
#include "audio/music/score/midi_scores.hpp"
#include "base/file.hpp"
#include "base/pending_file.hpp"
#include "base/random.hpp"
#include "tests/audio/music/shipped_styles.hpp"
#include "tests/support/temporary_folder.hpp"
#include "training/beat/corpus.hpp"

namespace raks::audio {
namespace {

class TrainingFiles : public ::testing::Test {
 protected:
    /// 4 bars of 4/4 in a MIDI file of one track: a note on every quarter.
    static std::string midi() {
        std::string track;
        const auto add = [&track](std::initializer_list<int> bytes) {
            for (const int byte : bytes) {
                track.push_back(static_cast<char>(byte));
            }
        };
        add({0, 0xFF, 0x58, 4, 4, 2, 24, 8});
        for (int quarter = 0; quarter < 16; ++quarter) {
            add({0, 0x99, 36, 100, 96, 0x89, 36, 0});
        }
        add({0, 0xFF, 0x2F, 0});
        const auto size = static_cast<char>(track.size());
        return std::string("MThd\0\0\0\6\0\0\0\1\0\x60MTrk\0\0\0", 21) + size + track;
    }
    void write_pack(const std::string& file, const std::string& index) {
        EXPECT_TRUE(write_file(folder_ / "one.mid", file));
        EXPECT_TRUE(write_file(folder_ / "index.tsv", index));
    }
    static constexpr const char* kIndex =
        "file\tset\tkind\tbpm_quarter\ttime_signature\none.mid\tfreedoom\tsong\t120\t4/4\n";
    raks::test::TemporaryFolder folder_;
};

TEST_F(TrainingFiles, midi_becomes_a_score_in_beats) {
    write_pack(midi(), kIndex);
    const auto stretches = read_midi_pack(folder_.path());
    ASSERT_TRUE(stretches) << stretches.error().message;
    ASSERT_EQ(stretches->size(), 1U);
    const Score& score = stretches->front().score;
    EXPECT_NEAR(score.bpm, 120.0, 1e-6);
    ASSERT_EQ(score.notes.size(), 16U);
    EXPECT_EQ(score.bar_position.size(), 16U);
    for (std::size_t i = 0; i < score.notes.size(); ++i) {
        EXPECT_NEAR(score.notes[i].beat, static_cast<double>(i), 1e-9);
        EXPECT_EQ(score.bar_position[i], static_cast<int>(i % 4) + 1);
    }
}

TEST_F(TrainingFiles, a_bad_pack_is_named_in_one_line) {
    EXPECT_FALSE(read_midi_pack(folder_.path())) << "no index";
    write_pack("no midi", kIndex);
    const auto bad = read_midi_pack(folder_.path());
    ASSERT_FALSE(bad);
    EXPECT_NE(bad.error().message.find("one.mid"), std::string::npos);
    write_pack(midi(), "file\tset\n");
    const auto column = read_midi_pack(folder_.path());
    ASSERT_FALSE(column);
    EXPECT_NE(column.error().message.find("kind"), std::string::npos);
}

TEST_F(TrainingFiles, mangled_midi_ends_in_an_error_or_a_score) {
    const std::string good = midi();
    for (std::size_t length = 0; length < good.size(); length += 5) {
        write_pack(good.substr(0, length), kIndex);
        static_cast<void>(read_midi_pack(folder_.path()));
    }
    const CounterRandom random(3);
    for (std::uint64_t i = 0; i < 200; ++i) {
        std::string text = good;
        text[random.below(2 * i, text.size())] = static_cast<char>(random.below(2 * i + 1, 256));
        write_pack(text, kIndex);
        if (const auto stretches = read_midi_pack(folder_.path())) {
            for (const MidiStretch& stretch : *stretches) {
                EXPECT_LT(stretch.score.bar_position.size(), 1'000'000U);
            }
        }
    }
}

// 5 kB with a bar's signature every 19,000 quarters.
TEST_F(TrainingFiles, a_file_that_claims_thousands_of_hours_gives_an_hour_at_most) {
    const auto bytes = read_file(RAKS_SOURCE_DIR "/tests/fuzz/corpus/midi/far_apart.mid");
    ASSERT_TRUE(bytes);
    const auto stretches = midi_stretches(*bytes, {"far_apart.mid", "freedoom"});
    ASSERT_TRUE(stretches) << stretches.error().message;
    std::size_t beats = 0;
    for (const MidiStretch& stretch : *stretches) {
        beats += stretch.score.bar_position.size();
    }
    EXPECT_LE(beats, 20'000U);
}

TEST_F(TrainingFiles, a_column_that_stands_twice_moves_no_other) {
    const auto rows = parse_midi_index(
        "file\tfile\tset\tkind\tbpm_quarter\ttime_signature\na.mid\tb.mid\tgroove\tbeat\t90\t3/4\n",
        "index.tsv");
    ASSERT_TRUE(rows) << rows.error().message;
    ASSERT_EQ(rows->size(), 1U);
    EXPECT_EQ(rows->front().file, "a.mid");
    EXPECT_EQ(rows->front().set, "groove");
    EXPECT_EQ(rows->front().bpm, 90.0);
}

TEST_F(TrainingFiles, a_kept_corpus_is_the_same_again) {
    std::vector<TrainingExcerpt> corpus(2);
    corpus[0] = {"salsa", "mambo", std::vector<float>(36 * 7, 0.25F), {{0.5, 1}, {1.0, 2}}};
    corpus[1] = {"", "", {}, {}};
    ASSERT_TRUE(save_corpus(corpus, folder_ / "corpus"));
    const auto read = load_corpus(folder_ / "corpus");
    ASSERT_TRUE(read) << read.error().message;
    ASSERT_EQ(read->size(), 2U);
    EXPECT_EQ((*read)[0].family, "salsa");
    EXPECT_EQ((*read)[0].style, "mambo");
    EXPECT_EQ((*read)[0].hops(), 7U);
    EXPECT_EQ((*read)[0].beats[1].bar_position, 2);
    EXPECT_EQ((*read)[0].mel, corpus[0].mel);
}

TEST_F(TrainingFiles, a_damaged_corpus_is_refused) {
    std::vector<TrainingExcerpt> corpus(1);
    corpus[0] = {"pop", "funk", std::vector<float>(36 * 3, 1.0F), {{0.5, 1}}};
    ASSERT_TRUE(save_corpus(corpus, folder_ / "corpus"));
    const std::string good = *read_file(folder_ / "corpus");
    for (std::size_t length = 0; length < good.size(); ++length) {
        if (length == 12) {
            continue;  // a whole head: an empty corpus
        }
        ASSERT_TRUE(write_file(folder_ / "cut", good.substr(0, length)));
        EXPECT_FALSE(load_corpus(folder_ / "cut")) << length;
    }
    std::string huge = good;
    huge[12 + 8] = huge[12 + 15] = '\x7F';  // a size that no file holds
    ASSERT_TRUE(write_file(folder_ / "cut", huge));
    EXPECT_FALSE(load_corpus(folder_ / "cut"));
}

TEST_F(TrainingFiles, a_corpus_of_numbers_that_nothing_can_be_learnt_from_is_refused) {
    const TrainingExcerpt good{"pop", "funk", std::vector<float>(36 * 3, 1.0F), {{0.5, 1}}};
    for (const double number : {std::nan(""), HUGE_VAL, 1e30, -1.0}) {
        std::vector<TrainingExcerpt> corpus = {good};
        corpus[0].mel[40] = static_cast<float>(number);
        ASSERT_TRUE(save_corpus(corpus, folder_ / "corpus"));
        EXPECT_FALSE(load_corpus(folder_ / "corpus")) << number;
    }
    for (const PlayedBeat& beat : {PlayedBeat{std::nan(""), 1}, PlayedBeat{0.5, -1}}) {
        std::vector<TrainingExcerpt> corpus = {good};
        corpus[0].beats = {beat};
        ASSERT_TRUE(save_corpus(corpus, folder_ / "corpus"));
        EXPECT_FALSE(load_corpus(folder_ / "corpus")) << beat.time;
    }
}

TEST_F(TrainingFiles, tempi_and_signatures_of_the_index_are_read_strictly) {
    const std::string head = "file\tset\tkind\tbpm_quarter\ttime_signature\n";
    for (const char* row : {"a.mid\tgroove\tbeat\tnan\t4/4\n",
                            "a.mid\tgroove\tbeat\t0x78\t4/4\n",
                            "a.mid\tgroove\tbeat\t120\t4/0\n",
                            "a.mid\tgroove\tbeat\t120\t-4/4\n",
                            "a.mid\tgroove\tbeat\t1e99\t4/4\n"}) {
        ASSERT_TRUE(write_file(folder_ / "index.tsv", head + row));
        const auto refused = read_midi_pack(folder_.path());
        ASSERT_FALSE(refused) << row;
        EXPECT_NE(refused.error().message.find("index.tsv: line 2: "), std::string::npos)
            << refused.error().message;
    }
}

TEST_F(TrainingFiles, written_music_is_a_folder_that_trackers_are_judged_by) {
    write_pack(midi(), kIndex);
    const std::filesystem::path music = folder_ / "music";
    CorpusPlan plan{&shipped_styles(), folder_.path(), {folder_ / "none.sf2"}, 1, 12.0};
    // Some seed's first piece is our own generator's, which takes no soundfont.
    Expected<void> written = fail("none written");
    for (plan.seed = 1; !written && plan.seed < 200; ++plan.seed) {
        written = write_music_folder(plan, music);
        EXPECT_EQ(std::filesystem::exists(music), written.has_value());
    }
    ASSERT_TRUE(written) << written.error().message;
    const auto read = load_beat_corpus(music);
    ASSERT_TRUE(read) << read.error().message;
    ASSERT_EQ(read->size(), 1U);
    EXPECT_EQ(read->front().category, "own");
    EXPECT_GT(read->front().reference.times.size(), 8U);
    const auto again = write_music_folder(plan, music);
    ASSERT_FALSE(again);
    EXPECT_NE(again.error().message.find("not an empty folder"), std::string::npos)
        << again.error().message;
}

TEST_F(TrainingFiles, music_needs_rhythms_to_write_it_in) {
    write_pack(midi(), kIndex);
    StyleBook book;
    CorpusPlan plan{&book, folder_.path(), {folder_ / "none.sf2"}, 1, 12.0};
    const auto none = make_corpus(plan);
    ASSERT_FALSE(none);
    EXPECT_EQ(none.error().message,
              "the styles of music have no rhythm for the beat tracker's training");
    book.rhythms.emplace_back().family = "pop";
    plan.with_machines = true;
    const auto no_machines = make_corpus(plan);
    ASSERT_FALSE(no_machines);
    EXPECT_EQ(no_machines.error().message,
              "the styles of music have no rhythm that machines play (machines = true)");
}

}  // namespace
}  // namespace raks::audio
