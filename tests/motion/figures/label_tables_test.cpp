#include "motion/figures/label_tables.hpp"

#include <gtest/gtest.h>

#include <string>
#include <utility>
#include <vector>

#include "base/random.hpp"

namespace raks::motion {
namespace {

const std::string kHeader =
    "take\trole\tstart\tend\tfigure\tstart_count\tbeats\tconfidence\tsplit\n";
const std::string kRow = "60_02\tlead\t311\t484\tbasic\t1\t8\t0.9\ttrain\n";

TEST(LabelTables, read_labels_whatever_the_line_ends_and_order_of_columns) {
    const Expected<std::vector<FigureLabel>> labels = parse_labels(
        "# a "
        "remark\r\nfigure\tbeats\tend\tstart\trole\ttake\r\n\r\nbasic\t8\t484\t311\tfollow\t61_02",
        "l.tsv");
    ASSERT_TRUE(labels) << labels.error().message;
    ASSERT_EQ(labels->size(), 1U);
    EXPECT_EQ((*labels)[0].take, "61_02");
    EXPECT_EQ((*labels)[0].role, DanceRole::follow);
    EXPECT_EQ((*labels)[0].start, 311U);
    EXPECT_EQ((*labels)[0].end, 484U);
    EXPECT_EQ((*labels)[0].confidence, 1.0);
    EXPECT_EQ((*labels)[0].line, 4U);
}

TEST(LabelTables, labels_that_are_written_read_back) {
    FigureLabel label;
    label.take = "60_02";
    label.role = DanceRole::follow;
    label.start = 311;
    label.end = 484;
    label.figure = "basic";
    label.confidence = 0.93;
    const std::vector<FigureLabel> labels = {label};
    const std::vector<std::string> remarks = {"edit me"};
    const std::string text = labels_text(labels, remarks);
    EXPECT_EQ(text.substr(0, 10), "# edit me\n");
    const Expected<std::vector<FigureLabel>> read = parse_labels(text, "l.tsv");
    ASSERT_TRUE(read) << read.error().message;
    ASSERT_EQ(read->size(), 1U);
    EXPECT_EQ((*read)[0].take, "60_02");
    EXPECT_EQ((*read)[0].role, DanceRole::follow);
    EXPECT_EQ((*read)[0].start, 311U);
    EXPECT_EQ((*read)[0].end, 484U);
    EXPECT_EQ((*read)[0].figure, "basic");
    EXPECT_EQ((*read)[0].beats, 8);
    EXPECT_EQ((*read)[0].confidence, 0.93);
}

TEST(LabelTables, refuse_bad_labels_with_line_and_value) {
    const struct {
        std::string text;
        std::string message;
    } table[] = {
        {"", "l.tsv: is empty, must start with a line of column names"},
        {"take\tstart\tend\tfigure\tbeats\n", "l.tsv: has no column \"role\" (tab-separated)"},
        {kHeader + "60_02\tlead\t484\t311\tbasic\t1\t8\t0.9\ttrain\n",
         "l.tsv: line 2: end is 311, must be after start (484)"},
        {kHeader + "60_02\tlead\t311\t312\tbasic\t1\t8\t0.9\ttrain\n",
         "l.tsv: line 2: 1 frames for 8 beats: must be at least 4 a beat"},
        {kHeader + "60_02\tlead\t311\t484\tbasic\t1\t0\t0.9\ttrain\n",
         "l.tsv: line 2: beats is 0, must lie in [1, 64]"},
        {kHeader + "60_02\tlead\tx\t484\tbasic\t1\t8\t0.9\ttrain\n",
         "l.tsv: line 2: start is \"x\", must be a number"},
        {kHeader + "60_02\tlead\t-3\t484\tbasic\t1\t8\t0.9\ttrain\n",
         "l.tsv: line 2: start is -3, must lie in [0, 1000000000]"},
        {kHeader + "60_02\tlead\t31.5\t484\tbasic\t1\t8\t0.9\ttrain\n",
         "l.tsv: line 2: start is 31.5, must be a whole number"},
        {kHeader + "60_02\tlead\t311\t484\tbasic\t1\t8\tnan\ttrain\n",
         "l.tsv: line 2: confidence is nan, must lie in [0, 1]"},
        {kHeader + "60_02\tboss\t311\t484\tbasic\t1\t8\t0.9\ttrain\n",
         "l.tsv: line 2: role is \"boss\", must be lead or follow"},
        {kHeader + "60_02\tlead\t311\n", "l.tsv: line 2: has no end"},
        {kHeader + kRow + "60_02\tlead\t480\t650\tbasic\t1\t8\t0.9\ttrain\n",
         "l.tsv: line 3: 60_02 480-650 overlaps line 2 (311-484)"},
    };
    for (const auto& row : table) {
        const Expected<std::vector<FigureLabel>> labels = parse_labels(row.text, "l.tsv");
        ASSERT_FALSE(labels) << row.message;
        EXPECT_EQ(labels.error().message, row.message);
    }
}

TEST(LabelTables, read_counts_and_refuse_those_that_do_not_rise) {
    const Expected<std::vector<CountTime>> counts =
        parse_counts("take_pair\tcount\tframe\tdancing\n02\t1\t4.71\t0\n02\t2\t26.5\t0\n", "c.tsv");
    ASSERT_TRUE(counts) << counts.error().message;
    EXPECT_EQ((*counts)[1].count, 2);
    EXPECT_EQ((*counts)[1].frame, 26.5);
    const Expected<std::vector<CountTime>> falling =
        parse_counts("take\tcount\tframe\n02\t1\t30\n02\t2\t26.5\n", "c.tsv");
    ASSERT_FALSE(falling);
    EXPECT_EQ(falling.error().message,
              "c.tsv: line 3: frame is 26.5, must be after the count before (30)");
}

TEST(LabelTables, read_beats_of_takes_and_refuse_bad_ones_in_one_line) {
    const std::string header = "take\ttime\thalf\tused\n";
    const auto beats = parse_take_beats(header + "a\t0.5\t1\t1\na\t1\t2\t0\nb\t0.2\t2\t1\n", "x");
    ASSERT_TRUE(beats) << beats.error().message;
    ASSERT_EQ(beats->size(), 3U);
    EXPECT_EQ((*beats)[1].take, "a");
    EXPECT_EQ((*beats)[1].half, 2);
    EXPECT_FALSE((*beats)[1].is_used);
    EXPECT_EQ((*beats)[2].line, 4U);
    const std::vector<std::pair<std::string, std::string>> bad = {
        {"", "x: is empty, must start with a line of column names"},
        {header, "x: holds no beats, must have a row for each"},
        {"take\ttime\thalf\n", "x: has no column \"used\" (tab-separated)"},
        {header + "a\t1\t1\t1\na\t1\t2\t1\n",
         "x: line 3: time is 1, must be after the beat before (1)"},
        {header + "a\t2\t1\t1\na\t1\t2\t1\n",
         "x: line 3: time is 1, must be after the beat before (2)"},
        {header + "a\t-1\t1\t1\n", "x: line 2: time is -1, must lie in [0, 86400]"},
        {header + "a\tnan\t1\t1\n", "x: line 2: time is nan, must lie in [0, 86400]"},
        {header + "a\t1\t3\t1\n", "x: line 2: half is 3, must lie in [1, 2]"},
        {header + "a\t1\t1\tyes\n", "x: line 2: used is \"yes\", must be a number"},
        {header + "a\t1\t1\n", "x: line 2: has no used"},
        {header + "\t1\t1\t1\n", "x: line 2: take is empty, must be the clip's name"}};
    for (const auto& [text, line] : bad) {
        const auto refused = parse_take_beats(text, "x");
        ASSERT_FALSE(refused) << text;
        EXPECT_EQ(refused.error().message, line);
    }
}

TEST(LabelTables, read_capture_faults) {
    const Expected<std::vector<CaptureFault>> faults =
        parse_faults("take\tfrom\tto\tjoints\n60_01\t0\t3\tlHand,rHand\n", "g.tsv");
    ASSERT_TRUE(faults) << faults.error().message;
    EXPECT_EQ((*faults)[0].to, 3U);
    EXPECT_FALSE(parse_faults("take\tfrom\tto\tjoints\n60_01\t5\t3\tall\n", "g.tsv"));
}

TEST(LabelTables, survive_cuts_at_every_byte_and_flipped_bytes) {
    const std::string good = kHeader + kRow + "60_03\tlead\t1\t200\tbasic\t1\t8\t1\ttest\n";
    for (std::size_t length = 0; length < good.size(); ++length) {
        const auto labels = parse_labels(std::string_view(good).substr(0, length), "l");
        EXPECT_TRUE(labels || labels.error().message.find('\n') == std::string::npos);
    }
    const CounterRandom random(8);
    for (std::uint64_t i = 0; i < 3000; ++i) {
        std::string text = good;
        text[random.below(2 * i, text.size())] = static_cast<char>(random.below(2 * i + 1, 256));
        const auto labels = parse_labels(text, "l");
        if (labels) {
            for (const FigureLabel& label : *labels) {
                EXPECT_GE(label.end, label.start + 4 * static_cast<std::size_t>(label.beats));
            }
        }
    }
}

}  // namespace
}  // namespace raks::motion
