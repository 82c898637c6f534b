#include "audio/io/counted_blocks.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>

#include "tests/support/realtime_guard.hpp"

namespace raks::audio {
namespace {

/// Keeps the times it got, and answers with ones.
class Listener final : public StreamCallback {
 public:
    void on_input(std::span<const float>,
                  int,
                  const BlockTime& time) noexcept RAKS_NONBLOCKING override {
        last = time;
    }
    void on_output(std::span<float> block,
                   int,
                   const BlockTime& time) noexcept RAKS_NONBLOCKING override {
        last = time;
        was_silent = std::all_of(block.begin(), block.end(), [](float x) { return x == 0.0F; });
        std::fill(block.begin(), block.end(), 1.0F);
    }
    BlockTime last;
    bool was_silent = false;
};

TEST(CountedBlocks, counts_what_passes_without_breaking_the_real_time_rules) {
    CountedBlocks blocks(2);
    Listener listener;
    blocks.gate().open(listener);
    EXPECT_EQ(blocks.scheduling(), "unknown");
    std::array<float, 8> block{};
    block.fill(0.5F);
    raks::test::RealtimeScope scope;
    blocks.take_input(block, HostTime(Nanos(7)));
    blocks.note_xrun();
    blocks.take_output(block, HostTime(Nanos(9)));
    EXPECT_TRUE(scope.stop().is_clean()) << scope.stop().describe();
    EXPECT_EQ(listener.last.first_frame, 4);
    EXPECT_EQ(listener.last.entered, HostTime(Nanos(9)));
    EXPECT_TRUE(listener.last.is_xrun);
    EXPECT_TRUE(listener.was_silent) << "zeroed before it is filled";
    EXPECT_EQ(block.front(), 1.0F);
    EXPECT_EQ(blocks.callbacks(), 2U);
    EXPECT_EQ(blocks.xruns(), 1U);
    EXPECT_EQ(blocks.frames(), 8);
    EXPECT_EQ(blocks.block_frames(), 4);
    EXPECT_NE(blocks.scheduling(), "unknown");
}

TEST(CountedBlocks, an_xrun_is_told_once) {
    CountedBlocks blocks(1);
    Listener listener;
    blocks.gate().open(listener);
    blocks.note_xrun();
    const std::array<float, 4> block{};
    blocks.take_input(block, {});
    EXPECT_TRUE(listener.last.is_xrun);
    blocks.take_input(block, {});
    EXPECT_FALSE(listener.last.is_xrun);
}

TEST(CountedBlocks, without_a_callback_an_output_is_silent) {
    CountedBlocks blocks(2);
    std::array<float, 8> block{};
    block.fill(0.5F);
    blocks.take_output(block, {});
    EXPECT_EQ(block.front(), 0.0F);
}

}  // namespace
}  // namespace raks::audio
