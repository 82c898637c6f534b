#include "engine/live/sound_tap.hpp"

#include <gtest/gtest.h>

#include <thread>

#include "tests/support/realtime_guard.hpp"

namespace raks::engine {
namespace {

constexpr SampleRate kRate(48'000);

TEST(SoundTap, gives_pieces_as_they_were_put_in_stereo) {
    SoundTap tap;
    SoundTap::Piece piece;
    EXPECT_FALSE(tap.take(piece));
    tap.set_source(3);
    tap.put(StreamTime(Nanos(5)), kRate, std::vector<float>{1, 2, 3, 4}, 2);
    tap.set_source(4);
    tap.put(StreamTime(Nanos(6)), SampleRate(44'100), std::vector<float>{1, 2}, 1);
    tap.put(StreamTime(Nanos(7)), kRate, std::vector<float>{1, 2, 9, 3, 4, 9}, 3);
    ASSERT_TRUE(tap.take(piece));
    EXPECT_EQ(piece.source, 3U);
    EXPECT_EQ(piece.begins, StreamTime(Nanos(5)));
    EXPECT_EQ(piece.rate, 48'000);
    EXPECT_EQ(piece.stereo, (std::vector<float>{1, 2, 3, 4}));
    ASSERT_TRUE(tap.take(piece));
    EXPECT_EQ(piece.source, 4U);
    EXPECT_EQ(piece.rate, 44'100);
    EXPECT_EQ(piece.stereo, (std::vector<float>{1, 1, 2, 2}));
    ASSERT_TRUE(tap.take(piece));
    EXPECT_EQ(piece.stereo, (std::vector<float>{1, 2, 3, 4}));
    EXPECT_FALSE(tap.take(piece));
}

TEST(SoundTap, drops_whole_pieces_where_nobody_takes_them) {
    SoundTap tap;
    const std::vector<float> block(2 * SoundTap::kMostFrames, 0.5F);
    test::RealtimeScope scope;
    for (int i = 0; i < 4000; ++i) {
        tap.put(kRate.time_of(i * 512), kRate, block, 2);
    }
    EXPECT_TRUE(scope.stop().is_clean()) << scope.stop().describe();
    EXPECT_GT(tap.dropped(), 0U);
    SoundTap::Piece piece;
    std::uint64_t frames = 0;
    while (tap.take(piece)) {
        ASSERT_EQ(piece.stereo.size(), block.size());
        EXPECT_EQ(piece.begins, kRate.time_of(static_cast<std::int64_t>(frames)));
        frames += SoundTap::kMostFrames;
    }
    EXPECT_EQ(frames + tap.dropped(), 4000U * SoundTap::kMostFrames);
}

TEST(SoundTap, shows_a_reader_on_another_thread_whole_pieces_alone) {
    SoundTap tap;
    constexpr int kPieces = 3000;
    std::thread writer([&] {
        for (int i = 1; i <= kPieces; ++i) {
            const std::vector<float> block(static_cast<std::size_t>(2 * (i % 100 + 1)),
                                           static_cast<float>(i));
            tap.put(StreamTime(Nanos(i)), kRate, block, 2);
        }
    });
    SoundTap::Piece piece;
    std::int64_t last = 0;
    std::size_t taken = 0;
    while (last < kPieces) {
        if (!tap.take(piece)) {
            std::this_thread::yield();
            continue;
        }
        const std::int64_t number = piece.begins.time_since_epoch().count();
        ASSERT_GT(number, last);
        ASSERT_EQ(piece.stereo.size(), static_cast<std::size_t>(2 * (number % 100 + 1)));
        ASSERT_EQ(piece.stereo.front(), static_cast<float>(number));
        ASSERT_EQ(piece.stereo.back(), static_cast<float>(number));
        last = number;
        taken += piece.stereo.size() / 2;
    }
    writer.join();
    EXPECT_EQ(tap.dropped(), 0U) << taken;
}

}  // namespace
}  // namespace raks::engine
