#include "engine/outputs/video_output.hpp"

#include <gtest/gtest.h>

#include <condition_variable>

#include "base/sleep_until.hpp"

namespace raks::engine {
namespace {

/// Keeps the first byte of each picture that it is sent.
class KeptPictures final : public VideoSink {
 public:
    void send(std::span<const std::uint8_t> rgba) override {
        const std::lock_guard lock(mutex_);
        seen_.push_back(rgba.front());
        count_sent();
        changed_.notify_all();
    }
    [[nodiscard]] std::vector<std::uint8_t> wait_for(std::size_t pictures) {
        std::unique_lock lock(mutex_);
        changed_.wait(lock, [&] { return seen_.size() >= pictures; });
        return seen_;
    }

 private:
    std::mutex mutex_;
    std::condition_variable changed_;
    std::vector<std::uint8_t> seen_;
};

constexpr VideoFormat kSmall{.width = 16, .height = 16, .rate_numerator = 100};

struct Running {
    explicit Running(const VideoFormat& format = kSmall) {
        auto made = std::make_unique<KeptPictures>();
        sink = made.get();
        std::vector<VideoOutput::Named> sinks;
        sinks.push_back({"kept", std::move(made)});
        output = std::make_unique<VideoOutput>(std::move(sinks), format);
    }
    KeptPictures* sink;
    std::unique_ptr<VideoOutput> output;
};

HostTime clock_now() { return std::chrono::time_point_cast<Nanos>(HostClock::now()); }

TEST(VideoOutput, sends_nothing_before_the_first_picture_and_repeats_the_last) {
    const Running running;
    std::vector<std::uint8_t> picture(kSmall.bytes(), 7);
    const auto due = running.output->wanted(clock_now());
    ASSERT_TRUE(due);
    running.output->give(*due, picture);
    const auto seen = running.sink->wait_for(4);
    EXPECT_EQ(seen.front(), 7);
    EXPECT_EQ(seen.at(3), 7);
    EXPECT_GE(running.output->repeated(), 2U);
    ASSERT_EQ(running.output->losses().size(), 1U);
}

// Far apart, so that no moment passes within the test.
TEST(VideoOutput, wants_each_picture_once_and_not_far_ahead) {
    constexpr VideoFormat kSlow{.width = 16, .height = 16, .rate_numerator = 1};
    const Running running(kSlow);
    const std::vector<std::uint8_t> picture(kSlow.bytes());
    const HostTime now = clock_now();
    const auto first = running.output->wanted(now);
    ASSERT_TRUE(first);
    EXPECT_EQ(running.output->wanted(now), first) << "it was not given yet";
    running.output->give(*first, picture);
    const auto second = running.output->wanted(now);
    ASSERT_TRUE(second);
    EXPECT_EQ(*second - *first, std::chrono::seconds(1));
    running.output->give(*second, picture);
    EXPECT_FALSE(running.output->wanted(now)) << "two are ahead";
    const auto later = running.output->wanted(now + std::chrono::seconds(10));
    ASSERT_TRUE(later);
    EXPECT_GT(*later, now + std::chrono::seconds(10)) << "what is too late is passed over";
    EXPECT_LE(*later, now + std::chrono::seconds(11));
}

TEST(VideoOutput, sends_pictures_in_their_order) {
    const Running running;
    for (std::uint8_t number = 1; number <= 20;) {
        if (const auto due = running.output->wanted(clock_now())) {
            running.output->give(*due, std::vector<std::uint8_t>(kSmall.bytes(), number++));
        } else {
            sleep_until(clock_now() + std::chrono::milliseconds(1));
        }
    }
    const auto seen = running.sink->wait_for(20);
    EXPECT_TRUE(std::is_sorted(seen.begin(), seen.end()));
    EXPECT_GE(seen.back(), 15);
}

TEST(VideoFormat, counts_time_exactly_at_television_rates) {
    constexpr VideoFormat kNtsc{.rate_numerator = 30'000, .rate_denominator = 1001};
    EXPECT_EQ(kNtsc.time_of(30'000), std::chrono::seconds(1001));
    EXPECT_EQ(kNtsc.time_of(1), Nanos(33'366'666));
}

}  // namespace
}  // namespace raks::engine
