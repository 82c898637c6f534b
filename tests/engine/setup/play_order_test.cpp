#include "engine/setup/play_order.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <set>
#include <vector>

namespace raks::engine {
namespace {

using Files = std::vector<std::size_t>;

/// The files of `count` steps, or fewer where the order ends.
Files steps(PlayOrder& order, std::size_t count) {
    Files files;
    for (std::size_t i = 0; i < count && order.current(); ++i) {
        files.push_back(*order.current());
        order.go_on();
    }
    return files;
}

TEST(PlayOrder, goes_from_the_first_to_the_last_and_back) {
    PlayOrder order(3, {});
    EXPECT_TRUE(order.has_next());
    order.go_back();
    EXPECT_EQ(order.current(), 0U) << "nothing lies before the first";
    EXPECT_EQ(steps(order, 9), (Files{0, 1, 2}));
    EXPECT_EQ(order.current(), std::nullopt);
    EXPECT_FALSE(order.has_next());
    order.go_on();
    order.go_back();
    EXPECT_EQ(order.current(), 2U) << "from the end to the last";
    EXPECT_FALSE(order.has_next());
}

TEST(PlayOrder, repeated_begins_anew_in_both_directions) {
    PlayOrder order(2, {.repeats = true});
    EXPECT_EQ(steps(order, 5), (Files{0, 1, 0, 1, 0}));
    PlayOrder back(2, {.repeats = true});
    back.go_back();
    EXPECT_EQ(back.current(), 1U);
    EXPECT_TRUE(back.has_next());
}

TEST(PlayOrder, mixed_plays_each_file_once_a_round_in_an_order_of_the_seed) {
    PlayOrder order(20, {.shuffle_seed = 7, .repeats = true});
    const Files first = steps(order, 20);
    const Files second = steps(order, 20);
    EXPECT_EQ(std::set<std::size_t>(first.begin(), first.end()).size(), 20U);
    EXPECT_EQ(std::set<std::size_t>(second.begin(), second.end()).size(), 20U);
    EXPECT_FALSE(std::is_sorted(first.begin(), first.end()));
    EXPECT_NE(first, second);
    EXPECT_NE(first.back(), second.front());
    PlayOrder again(20, {.shuffle_seed = 7});
    EXPECT_EQ(steps(again, 99), first);
    PlayOrder other(20, {.shuffle_seed = 8});
    EXPECT_NE(steps(other, 99), first);
}

TEST(PlayOrder, no_file_follows_itself_where_there_are_others) {
    for (std::uint64_t seed = 0; seed < 100; ++seed) {
        PlayOrder order(2, {.shuffle_seed = seed, .repeats = true});
        const Files files = steps(order, 40);
        for (std::size_t i = 2; i < files.size(); i += 2) {
            EXPECT_NE(files[i - 1], files[i]) << seed;
        }
    }
}

TEST(PlayOrder, dropped_files_are_not_met_again) {
    PlayOrder order(3, {.repeats = true});
    order.go_on();
    order.drop_current();
    EXPECT_EQ(order.current(), 2U);
    EXPECT_EQ(steps(order, 4), (Files{2, 0, 2, 0}));
    PlayOrder last(2, {});
    last.go_on();
    last.drop_current();
    EXPECT_EQ(last.current(), std::nullopt);
    last.go_back();
    EXPECT_EQ(last.current(), 0U);
    last.drop_current();
    last.drop_current();
    EXPECT_EQ(last.current(), std::nullopt);
    EXPECT_FALSE(last.has_next());
    PlayOrder none(0, {.shuffle_seed = 1, .repeats = true});
    EXPECT_EQ(none.current(), std::nullopt);
    none.go_on();
    none.go_back();
    EXPECT_FALSE(none.has_next());
}

TEST(PlayOrder, files_can_be_added_and_gone_to) {
    PlayOrder order(2, {});
    order.go_on();
    order.append(2, 2);
    EXPECT_EQ(order.files(), (std::vector<std::size_t>{0, 1, 2, 3}));
    EXPECT_EQ(order.next(), 2U);
    order.go_to(3);
    EXPECT_EQ(order.current(), 3U);
    EXPECT_EQ(order.place(), 3U);
    EXPECT_FALSE(order.has_next());
    order.go_to(99);
    EXPECT_EQ(order.current(), std::nullopt);
    order.append(4, 1);
    EXPECT_EQ(order.current(), 4U) << "at the end: it is the next to play";
}

TEST(PlayOrder, what_follows_can_be_seen_and_left_out) {
    PlayOrder order(4, {});
    EXPECT_EQ(order.next(), 1U);
    order.drop_next();
    EXPECT_EQ(order.next(), 2U);
    order.go_on();
    order.drop_next();
    EXPECT_EQ(order.next(), std::nullopt);
    EXPECT_FALSE(order.has_next());
    order.go_back();
    EXPECT_EQ(order.current(), 0U);
    PlayOrder around(3, {.repeats = true});
    around.go_on();
    around.go_on();
    EXPECT_EQ(around.next(), 0U);
    around.drop_next();
    EXPECT_EQ(around.current(), 2U);
    EXPECT_EQ(around.next(), 1U);
    around.drop_next();
    EXPECT_EQ(around.next(), std::nullopt) << "itself";
    EXPECT_TRUE(around.has_next());
}

}  // namespace
}  // namespace raks::engine
