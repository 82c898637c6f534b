#include "base/timed_commands.hpp"

#include <gtest/gtest.h>

#include <vector>

#include "tests/support/realtime_guard.hpp"

namespace raks {
namespace {

struct Command {
    int number = 0;
    StreamTime time{};
};

Command at(int number, int milliseconds) {
    return {number, StreamTime(std::chrono::milliseconds(milliseconds))};
}

std::vector<int> due(TimedCommands<Command, 3>& commands, int milliseconds) {
    std::vector<int> numbers;
    commands.run_due(at(0, milliseconds).time,
                     [&](const Command& command) { numbers.push_back(command.number); });
    return numbers;
}

TEST(TimedCommands, run_at_their_time_in_the_order_given) {
    TimedCommands<Command, 3> commands;
    commands.push(at(1, 20));
    commands.push(at(2, 10));
    commands.push(at(3, 0));
    EXPECT_EQ(due(commands, 9), std::vector{3});
    EXPECT_EQ(due(commands, 20), (std::vector{1, 2}));
    EXPECT_EQ(due(commands, 1000), std::vector<int>{});
}

TEST(TimedCommands, one_too_many_is_dropped_until_there_is_room) {
    TimedCommands<Command, 3> commands;
    for (const int number : {1, 2, 3}) {
        EXPECT_TRUE(commands.push(at(number, 10 * number)));
    }
    EXPECT_FALSE(commands.push(at(4, 0)));
    EXPECT_EQ(due(commands, 10), std::vector{1});
    EXPECT_TRUE(commands.push(at(5, 0)));
    EXPECT_EQ(due(commands, 10), std::vector{5});
    commands.clear();
    EXPECT_EQ(due(commands, 1000), std::vector<int>{});
}

TEST(TimedCommands, are_real_time) {
    TimedCommands<Command, 3> commands;
    int sum = 0;
    {
        const test::RealtimeScope scope;
        commands.push(at(1, 10));
        commands.push(at(2, 20));
        commands.run_due(at(0, 15).time, [&](const Command& command) { sum += command.number; });
    }
    EXPECT_EQ(sum, 1);
}

}  // namespace
}  // namespace raks
