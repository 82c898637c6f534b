#include "audio/evaluate/beat_corpus.hpp"

#include <gtest/gtest.h>

#include <algorithm>

#include "base/file.hpp"
#include "base/pending_file.hpp"
#include "base/random.hpp"
#include "tests/support/temporary_folder.hpp"

namespace raks::audio {
namespace {

namespace fs = std::filesystem;

const std::string kIndex =
    "name\tclass\tseconds\nwaltz\ttempo\t38\nsalsa_a\tsalsa\t38\n# a remark\n";
const std::string kBeats = "0.5486\t1\n0.9939\t2\n1.4614\t3\n1.8953\t4\n";

TEST(ParseBeats, reads_times_and_bar_positions) {
    const auto beats = parse_beats("# annotated\r\n1.25 1\r\n\r\n 2.5\t2.0 ignored\n", "x.beats");
    ASSERT_TRUE(beats) << beats.error().message;
    EXPECT_EQ(beats->times, (std::vector<double>{1.25, 2.5}));
    EXPECT_EQ(beats->bar_positions, (std::vector<int>{1, 2}));
    const auto sorted = parse_beats("3\n-0.004\n2.5\n", "x.beats");
    ASSERT_TRUE(sorted) << sorted.error().message;
    EXPECT_EQ(sorted->times, (std::vector<double>{-0.004, 2.5, 3.0}));
    EXPECT_TRUE(sorted->bar_positions.empty());
    EXPECT_TRUE(parse_beats("", "x.beats")->times.empty());
}

TEST(ParseBeats, refuses_anything_else_with_one_line) {
    const struct {
        const char* text;
        const char* message;
    } table[] = {
        {"1.0\nbeat\n", "x: line 2: time is \"beat\", must be seconds from -10 to 1000000"},
        {"nan\n", "x: line 1: time is \"nan\", must be seconds from -10 to 1000000"},
        {"inf\n", "x: line 1: time is \"inf\", must be seconds from -10 to 1000000"},
        {"1e7\n", "x: line 1: time is \"1e7\", must be seconds from -10 to 1000000"},
        {"-11\n", "x: line 1: time is \"-11\", must be seconds from -10 to 1000000"},
        {"1,5\n", "x: line 1: time is \"1,5\", must be seconds from -10 to 1000000"},
        {"1.0\x01\n", "x: line 1: time is \"1.0?\", must be seconds from -10 to 1000000"},
        {"1.0 q\n", "x: line 1: bar position is \"q\", must be a whole number from 0 to 64"},
        {"1.0 1.5\n", "x: line 1: bar position is \"1.5\", must be a whole number from 0 to 64"},
        {"1.0 -1\n", "x: line 1: bar position is \"-1\", must be a whole number from 0 to 64"},
        {"1.0 65\n", "x: line 1: bar position is \"65\", must be a whole number from 0 to 64"},
        {"1.0 1\n2.0\n", "x: line 2: must have a bar position in all lines or none"},
        {"1.0\n\n2.0 1\n", "x: line 3: must have a bar position in all lines or none"},
    };
    for (const auto& row : table) {
        const auto beats = parse_beats(row.text, "x");
        ASSERT_FALSE(beats) << row.text;
        EXPECT_EQ(beats.error().message, row.message);
    }
}

TEST(ParseBeats, reads_back_what_is_written) {
    const BeatList beats{{-0.000001, 0.5, 1.234567, 4000.000001}, {4, 1, 0, 3}};
    const auto again = parse_beats(beats_text(beats), "x");
    ASSERT_TRUE(again) << again.error().message;
    EXPECT_EQ(again->times, beats.times);
    EXPECT_EQ(again->bar_positions, beats.bar_positions);
    EXPECT_EQ(beats_text({{1.5}, {}}), "1.500000\n");
}

TEST(ParseBeatIndex, reads_names_and_classes_in_order) {
    const auto rows = parse_beat_index(kIndex, "index.tsv");
    ASSERT_TRUE(rows) << rows.error().message;
    ASSERT_EQ(rows->size(), 2U);
    EXPECT_EQ((*rows)[0].name, "waltz");
    EXPECT_EQ((*rows)[1].category, "salsa");
    EXPECT_EQ(parse_beat_index("class\tx\tname\r\nsalsa\t\ta b\r\n", "i")->front().name, "a b");
}

TEST(ParseBeatIndex, refuses_bad_tables_with_one_line) {
    const struct {
        std::string text;
        const char* message;
    } table[] = {
        {"", "i: has no column \"name\" (tab-separated)"},
        {"name class\na b\n", "i: has no column \"name\" (tab-separated)"},
        {"name\tgenre\na\tb\n", "i: has no column \"class\" (tab-separated)"},
        {"name\tclass\n", "i: lists no excerpts"},
        {"name\tclass\na\n", "i: line 2: is cut off: name or class is missing"},
        {"name\tclass\na\t\n", "i: line 2: name or class is empty"},
        {"name\tclass\n\tx\n", "i: line 2: name or class is empty"},
        {"name\tclass\n../a\tx\n", "i: line 2: name is \"../a\", must be a plain file name"},
        {"name\tclass\na/b\tx\n", "i: line 2: name is \"a/b\", must be a plain file name"},
        {"name\tclass\na\x01\tx\n", "i: line 2: name is \"a?\", must be a plain file name"},
        {"name\tclass\na\t.x\n", "i: line 2: class is \".x\", must be a plain name"},
        {"name\tclass\na\tx\n\na\ty\n", "i: line 4: \"a\" comes twice"},
        {"name\tclass\n" + std::string(201, 'n') + "\tx\n",
         "i: line 2: name is \"nnnnnnnnnnnnnnnnnnnn\", must be a plain file name"},
    };
    for (const auto& row : table) {
        const auto rows = parse_beat_index(row.text, "i");
        ASSERT_FALSE(rows) << row.text;
        EXPECT_EQ(rows.error().message, row.message);
    }
}

/// Whatever is in a file: a result, or one printable line that names the file.
template <typename Parsed>
void expect_result_or_one_line(const Parsed& parsed) {
    if (!parsed) {
        const std::string& line = parsed.error().message;
        EXPECT_EQ(line.rfind("bad: ", 0), 0U) << line;
        EXPECT_TRUE(std::all_of(line.begin(), line.end(), [](char c) {
            return c >= ' ' && c <= '~';
        })) << line;
        EXPECT_LT(line.size(), 200U);
    }
}

TEST(MangledBeatFiles, cut_at_every_offset) {
    for (std::size_t size = 0; size <= kBeats.size(); ++size) {
        expect_result_or_one_line(parse_beats(kBeats.substr(0, size), "bad"));
    }
    for (std::size_t size = 0; size <= kIndex.size(); ++size) {
        expect_result_or_one_line(parse_beat_index(kIndex.substr(0, size), "bad"));
    }
}

TEST(MangledBeatFiles, flipped_bits) {
    for (std::uint64_t round = 0; round < 4000; ++round) {
        SCOPED_TRACE("round " + std::to_string(round));
        const CounterRandom random(3, round);
        std::string bent = round % 2 == 0 ? kBeats : kIndex;
        const std::uint64_t flips = 1 + random.below(0, 6);
        for (std::uint64_t i = 1; i <= flips; ++i) {
            char& byte = bent[random.below(2 * i, bent.size())];
            byte = static_cast<char>(byte ^ (1 << random.below(2 * i + 1, 8)));
        }
        expect_result_or_one_line(parse_beats(bent, "bad"));
        const auto rows = parse_beat_index(bent, "bad");
        expect_result_or_one_line(rows);
        for (const BeatIndexRow& row : rows.value_or(std::vector<BeatIndexRow>())) {
            EXPECT_EQ(fs::path(row.name).filename(), row.name) << "leads out of the folder";
        }
    }
}

class BeatCorpusTest : public ::testing::Test {
 protected:
    void SetUp() override {
        write("index.tsv", kIndex);
        write("waltz.beats", kBeats);
        write("waltz.ogg", "sound");
        write("salsa_a.beats", "1.0 1\n2.0 2\n");
        write("salsa_a.flac", "sound");
    }

    void write(const char* name, const std::string& text) const {
        ASSERT_TRUE(write_file(folder_ / name, text));
    }
    [[nodiscard]] std::string error() const {
        const auto corpus = load_beat_corpus(folder_.path());
        return corpus ? "" : corpus.error().message;
    }
    [[nodiscard]] std::string path(const char* name) const { return (folder_ / name).string(); }

    raks::test::TemporaryFolder folder_;
};

TEST_F(BeatCorpusTest, loads_excerpts_in_the_order_of_the_index) {
    const auto corpus = load_beat_corpus(folder_.path());
    ASSERT_TRUE(corpus) << corpus.error().message;
    ASSERT_EQ(corpus->size(), 2U);
    EXPECT_EQ((*corpus)[0].name, "waltz");
    EXPECT_EQ((*corpus)[0].reference.bar_positions, (std::vector<int>{1, 2, 3, 4}));
    EXPECT_EQ((*corpus)[1].category, "salsa");
    EXPECT_EQ((*corpus)[1].audio, folder_ / "salsa_a.flac");
}

TEST_F(BeatCorpusTest, names_the_file_that_is_missing_or_bad) {
    write("salsa_a.beats", "1.0 1\n1.0 2\n");
    EXPECT_EQ(error(), path("salsa_a.beats") + ": has two beats at 1 s");
    write("salsa_a.beats", "# nothing\n");
    EXPECT_EQ(error(), path("salsa_a.beats") + ": has no beats; an annotation needs some");
    write("salsa_a.beats", "<html>\n");
    EXPECT_EQ(error(),
              path("salsa_a.beats") +
                  ": line 1: time is \"<html>\", must be seconds from -10 to 1000000");
    fs::remove(folder_ / "waltz.ogg");
    EXPECT_EQ(
        error(),
        path("waltz.ogg") + ": is missing; neither is there a .wav, .flac, .mp3, .opus, .m4a");
    fs::remove(folder_ / "waltz.beats");
    EXPECT_EQ(error(), path("waltz.beats") + ": cannot be opened: No such file or directory");
    fs::remove(folder_ / "index.tsv");
    EXPECT_EQ(error(), path("index.tsv") + ": cannot be opened: No such file or directory");
}

TEST_F(BeatCorpusTest, estimates_come_back_as_saved) {
    const BeatEstimate estimate{{{0.5, 1.0}, {1, 2}}, std::vector<double>{1.5}};
    ASSERT_TRUE(save_beat_estimate(folder_.path(), "mine", estimate));
    const auto again = load_beat_estimate(folder_.path(), "mine");
    ASSERT_TRUE(again) << again.error().message;
    ASSERT_TRUE(*again);
    EXPECT_EQ((*again)->beats.times, estimate.beats.times);
    EXPECT_EQ((*again)->beats.bar_positions, estimate.beats.bar_positions);
    EXPECT_EQ((*again)->predicted, estimate.predicted);
    EXPECT_EQ(load_beat_estimate(folder_.path(), "waltz")->value().predicted, std::nullopt);
    EXPECT_EQ(load_beat_estimate(folder_.path(), "unheard").value().has_value(), false);
    write("mine.pred", "soon\n");
    EXPECT_EQ(
        load_beat_estimate(folder_.path(), "mine").error().message,
        path("mine.pred") + ": line 1: time is \"soon\", must be seconds from -10 to 1000000");
}

}  // namespace
}  // namespace raks::audio
