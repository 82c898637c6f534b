#include <gtest/gtest.h>

#include <array>
#include <atomic>
#include <memory>
#include <thread>
#include <vector>

#include "base/channels/audio_ring.hpp"
#include "base/channels/event_queue.hpp"
#include "base/channels/latest_value.hpp"
#include "base/channels/retire_queue.hpp"
#include "base/random.hpp"
#include "tests/support/realtime_guard.hpp"

namespace raks {
namespace {

/// A payload that can tear: far larger than any atomic, every word derived from the seed.
struct Payload {
    std::uint64_t seed = 0;
    std::array<std::uint64_t, 31> words{};

    static Payload of(std::uint64_t seed) {
        Payload payload;
        payload.seed = seed;
        const CounterRandom random(seed);
        for (std::size_t i = 0; i < payload.words.size(); ++i) {
            payload.words[i] = random.bits(i);
        }
        return payload;
    }
    [[nodiscard]] bool is_whole() const { return words == of(seed).words; }
};
static_assert(!std::atomic<Payload>::is_always_lock_free, "the payload must be able to tear");

TEST(LatestValue, reads_a_default_first_and_then_the_newest) {
    LatestValue<int> value;
    bool is_new = true;
    EXPECT_EQ(value.read(&is_new), 0);
    EXPECT_FALSE(is_new);
    value.write(1);
    value.write(2);
    EXPECT_EQ(value.read(&is_new), 2);
    EXPECT_TRUE(is_new);
    EXPECT_EQ(value.read(&is_new), 2);
    EXPECT_FALSE(is_new);
}

TEST(LatestValue, a_part_that_is_filled_in_is_read_with_what_the_slot_held) {
    LatestValue<std::array<int, 2>> channel;
    channel.write_with([](std::array<int, 2>& slot) { slot[0] = 7; });
    EXPECT_EQ(channel.read(), (std::array<int, 2>{7, 0}));
    bool is_new = false;
    channel.write_with([](std::array<int, 2>& slot) { slot = {8, 9}; });
    EXPECT_EQ(channel.read(&is_new), (std::array<int, 2>{8, 9}));
    EXPECT_TRUE(is_new);
}

TEST(LatestValue, values_are_whole_and_never_go_back) {
    constexpr std::uint64_t kWrites = 100'000;
    auto value = std::make_unique<LatestValue<Payload>>();
    value->write(Payload::of(0));
    std::thread writer([&] {
        for (std::uint64_t i = 1; i <= kWrites; ++i) {
            value->write(Payload::of(i));
        }
    });
    std::uint64_t last = 0;
    while (last < kWrites) {
        const Payload& payload = value->read();
        ASSERT_TRUE(payload.is_whole());
        ASSERT_GE(payload.seed, last);
        last = payload.seed;
    }
    writer.join();
}

TEST(EventQueue, keeps_order_counts_what_it_drops_and_works_with_one_slot) {
    for (const std::size_t capacity : {1U, 2U, 3U, 7U}) {
        EventQueue<int> queue(capacity);
        int event = -1;
        EXPECT_FALSE(queue.pop(event));
        EXPECT_EQ(event, -1);
        for (int round = 0; round < 20; ++round) {  // wraps the index many times
            for (int i = 0; i < static_cast<int>(capacity); ++i) {
                EXPECT_TRUE(queue.push(i));
            }
            EXPECT_FALSE(queue.push(99));
            for (int i = 0; i < static_cast<int>(capacity); ++i) {
                ASSERT_TRUE(queue.pop(event));
                EXPECT_EQ(event, i);
            }
        }
        EXPECT_EQ(queue.dropped(), 20U);
    }
}

TEST(EventQueue, events_are_whole_and_in_order_between_threads) {
    constexpr std::uint64_t kEvents = 60'000;
    EventQueue<Payload> queue(8);
    std::thread producer([&] {
        for (std::uint64_t i = 0; i < kEvents;) {
            if (queue.push(Payload::of(i))) {
                ++i;
            } else {
                std::this_thread::yield();
            }
        }
    });
    Payload payload;
    for (std::uint64_t expected = 0; expected < kEvents;) {
        if (!queue.pop(payload)) {
            std::this_thread::yield();
            continue;
        }
        ASSERT_EQ(payload.seed, expected);
        ASSERT_TRUE(payload.is_whole());
        ++expected;
    }
    producer.join();
}

TEST(AudioRing, gives_back_every_sample_for_any_block_sizes) {
    const CounterRandom random(5);
    AudioRing ring(101);
    std::vector<float> block(150);
    std::uint64_t draw = 0;
    int written = 0;
    int read = 0;
    while (read < 20'000) {
        const std::size_t want = random.below(draw++, 120);
        for (std::size_t i = 0; i < want; ++i) {
            block[i] = static_cast<float>(written + static_cast<int>(i));
        }
        const std::size_t free = ring.writable();
        const std::size_t took = ring.write(std::span(block).first(want));
        EXPECT_EQ(took, std::min(want, free));
        written += static_cast<int>(took);
        const std::size_t got = ring.read(std::span(block).first(random.below(draw++, 120)));
        for (std::size_t i = 0; i < got; ++i) {
            ASSERT_EQ(block[i], static_cast<float>(read++));
        }
    }
}

TEST(AudioRing, samples_stay_in_order_between_threads) {
    constexpr int kSamples = 1'000'000;  // exact in float
    AudioRing ring(1000);
    std::thread writer([&] {
        std::array<float, 64> block{};
        int next = 0;
        while (next < kSamples) {
            for (std::size_t i = 0; i < block.size(); ++i) {
                block[i] = static_cast<float>(next + static_cast<int>(i));
            }
            const std::size_t left = static_cast<std::size_t>(kSamples - next);
            next +=
                static_cast<int>(ring.write(std::span(block).first(std::min(block.size(), left))));
        }
    });
    std::array<float, 100> block{};
    int expected = 0;
    while (expected < kSamples) {
        const std::size_t got = ring.read(block);
        for (std::size_t i = 0; i < got; ++i) {
            ASSERT_EQ(block[i], static_cast<float>(expected++));
        }
    }
    writer.join();
}

struct Counted {
    explicit Counted(int& alive) : alive_(alive) { ++alive_; }
    ~Counted() { --alive_; }
    Counted(const Counted&) = delete;
    Counted& operator=(const Counted&) = delete;
    int& alive_;
};

TEST(RetireQueue, frees_on_the_collecting_side_only) {
    int alive = 0;
    RetireQueue<Counted> queue(2);
    std::array<std::unique_ptr<Counted>, 3> objects;
    for (auto& object : objects) {
        object = std::make_unique<Counted>(alive);
    }
    test::RealtimeScope scope;
    EXPECT_TRUE(queue.retire(objects[0]));
    EXPECT_TRUE(queue.retire(objects[1]));
    EXPECT_FALSE(queue.retire(objects[2]));  // full: still ours
    EXPECT_TRUE(scope.stop().is_clean()) << scope.stop().describe();
    EXPECT_EQ(alive, 3);
    EXPECT_NE(objects[2], nullptr);
    EXPECT_EQ(queue.collect(), 2U);
    EXPECT_EQ(alive, 1);
    EXPECT_TRUE(queue.retire(objects[2]));
}

TEST(RetireQueue, what_was_not_collected_is_freed_at_the_end) {
    int alive = 0;
    {
        RetireQueue<Counted> queue(2);
        auto object = std::make_unique<Counted>(alive);
        ASSERT_TRUE(queue.retire(object));
    }
    EXPECT_EQ(alive, 0);
}

}  // namespace
}  // namespace raks
