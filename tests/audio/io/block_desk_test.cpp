#include "audio/io/block_desk.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>

#include "tests/support/realtime_guard.hpp"

namespace raks::audio {
namespace {

/// Keeps the times it got, and answers with ones.
class Listener final : public StreamCallback {
 public:
    void on_input(std::span<const float>, int, const BlockTime& time) noexcept override {
        last = time;
    }
    void on_output(std::span<float> block, int, const BlockTime& time) noexcept override {
        last = time;
        was_silent = std::all_of(block.begin(), block.end(), [](float x) { return x == 0.0F; });
        std::fill(block.begin(), block.end(), 1.0F);
    }
    BlockTime last;
    bool was_silent = false;
};

TEST(BlockDesk, counts_what_passes_without_breaking_the_real_time_rules) {
    BlockDesk desk(2);
    Listener listener;
    desk.gate().open(listener);
    EXPECT_EQ(desk.scheduling(), "unknown");
    std::array<float, 8> block{};
    block.fill(0.5F);
    raks::test::RealtimeScope scope;
    desk.take_input(block, HostTime(Nanos(7)));
    desk.note_xrun();
    desk.take_output(block, HostTime(Nanos(9)));
    EXPECT_TRUE(scope.stop().is_clean()) << scope.stop().describe();
    EXPECT_EQ(listener.last.first_frame, 4);
    EXPECT_EQ(listener.last.entered, HostTime(Nanos(9)));
    EXPECT_TRUE(listener.last.is_xrun);
    EXPECT_TRUE(listener.was_silent) << "zeroed before it is filled";
    EXPECT_EQ(block.front(), 1.0F);
    EXPECT_EQ(desk.callbacks(), 2U);
    EXPECT_EQ(desk.xruns(), 1U);
    EXPECT_EQ(desk.frames(), 8);
    EXPECT_EQ(desk.block_frames(), 4);
    EXPECT_NE(desk.scheduling(), "unknown");
}

TEST(BlockDesk, an_xrun_is_told_once) {
    BlockDesk desk(1);
    Listener listener;
    desk.gate().open(listener);
    desk.note_xrun();
    const std::array<float, 4> block{};
    desk.take_input(block, {});
    EXPECT_TRUE(listener.last.is_xrun);
    desk.take_input(block, {});
    EXPECT_FALSE(listener.last.is_xrun);
}

TEST(BlockDesk, without_a_callback_an_output_is_silent) {
    BlockDesk desk(2);
    std::array<float, 8> block{};
    block.fill(0.5F);
    desk.take_output(block, {});
    EXPECT_EQ(block.front(), 0.0F);
}

}  // namespace
}  // namespace raks::audio
