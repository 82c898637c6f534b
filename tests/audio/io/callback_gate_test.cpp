#include "audio/io/callback_gate.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <thread>

#include "tests/audio/io/long_block.hpp"
#include "tests/support/realtime_guard.hpp"

namespace raks::audio {
namespace {

/// Counts what reaches it, and answers with ones.
class Counter final : public StreamCallback {
 public:
    void on_input(std::span<const float> interleaved,
                  int width,
                  const BlockTime& time) noexcept RAKS_NONBLOCKING override {
        ++inputs;
        samples = interleaved.size();
        channels = width;
        first_frame = time.first_frame;
    }
    void on_output(std::span<float> interleaved,
                   int width,
                   const BlockTime& time) noexcept RAKS_NONBLOCKING override {
        ++outputs;
        channels = width;
        first_frame = time.first_frame;
        std::fill(interleaved.begin(), interleaved.end(), 1.0F);
    }

    int inputs = 0;
    int outputs = 0;
    int channels = 0;
    std::size_t samples = 0;
    std::int64_t first_frame = 0;
};

struct Blocks {
    std::array<float, 512> in{};
    std::array<float, 512> out{};  // a device hands it over zeroed
};

TEST(CallbackGate, blocks_before_it_opens_are_silence_and_reach_no_one) {
    CallbackGate gate;
    Counter counter;
    Blocks blocks;
    gate.on_input(blocks.in, 2, {0, {}, false});
    gate.on_output(blocks.out, 2, {0, {}, false});
    EXPECT_EQ(counter.inputs + counter.outputs, 0);
    EXPECT_EQ(blocks.out, decltype(blocks.out){});
}

TEST(CallbackGate, open_hands_each_block_on_as_it_is) {
    CallbackGate gate;
    Counter counter;
    Blocks blocks;
    gate.open(counter);
    gate.on_input(blocks.in, 8, {77, {}, false});
    EXPECT_EQ(counter.inputs, 1);
    EXPECT_EQ(counter.samples, blocks.in.size());
    EXPECT_EQ(counter.channels, 8);
    EXPECT_EQ(counter.first_frame, 77);
    gate.on_output(blocks.out, 2, {78, {}, false});
    EXPECT_EQ(counter.outputs, 1);
    EXPECT_EQ(counter.channels, 2);
    EXPECT_EQ(counter.first_frame, 78);
    EXPECT_EQ(blocks.out.back(), 1.0F);
}

TEST(CallbackGate, closed_again_blocks_pass_by) {
    CallbackGate gate;
    Counter counter;
    Blocks blocks;
    gate.open(counter);
    gate.close();
    gate.on_input(blocks.in, 2, {0, {}, false});
    gate.on_output(blocks.out, 2, {0, {}, false});
    EXPECT_EQ(counter.inputs + counter.outputs, 0);
    EXPECT_EQ(blocks.out, decltype(blocks.out){});
}

TEST(CallbackGate, closing_waits_for_the_block_that_is_on_its_way) {
    CallbackGate gate;
    test::LongBlock block;
    gate.open(block);
    std::thread device([&] { gate.on_input({}, 1, {0, {}, false}); });
    block.wait_for_begin();
    bool had_ended = false;
    std::thread closer([&] {
        gate.close();
        had_ended = block.has_ended();
    });
    block.let_end();
    closer.join();
    device.join();
    EXPECT_TRUE(had_ended);
}

TEST(CallbackGate, opening_and_callbacks_keep_the_real_time_rules) {
    CallbackGate gate;
    Counter counter;
    Blocks blocks;
    raks::test::RealtimeScope scope;
    gate.on_output(blocks.out, 2, {0, {}, false});
    gate.open(counter);
    gate.on_output(blocks.out, 2, {0, {}, false});
    gate.close();
    EXPECT_TRUE(scope.stop().is_clean()) << scope.stop().describe();
    EXPECT_EQ(counter.outputs, 1);
}

}  // namespace
}  // namespace raks::audio
