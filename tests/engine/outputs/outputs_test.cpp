#include "engine/outputs/outputs.hpp"

#include <gtest/gtest.h>

#include <functional>
#include <mutex>
#include <string>

namespace raks::engine {
namespace {

using std::chrono::milliseconds;

/// What an output was told, for the test's thread.
struct Told {
    std::mutex mutex;
    std::vector<Notice> notices;
    std::vector<Nanos> early;  // of the notices: so long before it was heard
    std::vector<HopIndex> hops;
    std::vector<std::string> titles;
};
Told told;

class KeptOutput final : public Output {
 public:
    using Output::Output;
    void tell(const OutputMoment& moment) override {
        const std::lock_guard lock(told.mutex);
        told.notices.push_back(moment.notice);
        told.early.push_back(moment.heard_at - host_now());
        count_sent();
    }
    void hear(const OutputHop& hop) override {
        const std::lock_guard lock(told.mutex);
        told.hops.push_back(hop.music.hop);
    }
    void name_song(const SongName& song) override {
        const std::lock_guard lock(told.mutex);
        told.titles.push_back(song.title);
    }
    std::optional<std::string> take_trouble() override {
        return std::exchange(has_said_, true) ? std::nullopt : std::optional<std::string>("x: oh");
    }

 private:
    bool has_said_ = false;
};

constexpr OutputKind kKept{"kept",
                           "PLACE",
                           "for the test",
                           true,
                           [](const std::string&) { return Expected<void>(); },
                           [](const std::string& target) -> Expected<std::unique_ptr<Output>> {
                               TargetReader reader(target);
                               return std::make_unique<KeptOutput>(reader.timing());
                           }};

class OutputsThread : public ::testing::Test {
 protected:
    void SetUp() override {
        const std::lock_guard lock(told.mutex);
        told.notices.clear();
        told.early.clear();
        told.hops.clear();
        told.titles.clear();
    }
    void open(const std::string& target) {
        auto opened = Outputs::open({{&kKept, target}});
        ASSERT_TRUE(opened) << opened.error().message;
        outputs_ = std::move(*opened);
        feed_ = std::make_shared<MusicFeed>();
        outputs_->follow(feed_, std::make_shared<DanceList>());
        // It has looked once.
        wait_until(
            [&] { return !outputs_->take_lines().empty() || outputs_->status()[0].sent > 0; });
    }
    /// Music at 120 BPM whose first hop sounds `ahead` from now; hops are told up to `hops`.
    void play(Nanos ahead, int hops) {
        ClockLine line;
        line.is_running = true;
        line.host_anchor = host_now() + ahead;
        feed_->set_clock(line);
        for (int hop = 0; hop < hops; ++hop) {
            MusicState state;
            state.hop = hop;
            state.time = time_of_hop(hop);
            state.grid.confidence = 0.9F;
            feed_->tell({state, {}});
        }
    }
    static void wait_until(const std::function<bool()>& is_so) {
        while (!is_so()) {
            std::this_thread::yield();
        }
    }
    static std::size_t notices() {
        const std::lock_guard lock(told.mutex);
        return told.notices.size();
    }

    std::unique_ptr<Outputs> outputs_;
    std::shared_ptr<MusicFeed> feed_;
};

TEST_F(OutputsThread, tells_hops_and_beats_when_they_are_heard_and_not_before) {
    open("x");
    play(milliseconds(50), 60);
    wait_until([] { return notices() == 2; });
    const std::lock_guard lock(told.mutex);
    EXPECT_EQ(told.notices[0].count, 1);
    EXPECT_EQ(told.notices[1].count, 2);
    EXPECT_LE(told.early[0], Nanos(1)) << "a beat is never told before it is heard";
    EXPECT_LE(told.early[1], Nanos(1));
    for (std::size_t i = 0; i < told.hops.size(); ++i) {
        EXPECT_EQ(told.hops[i], static_cast<HopIndex>(i));
    }
    EXPECT_GE(told.hops.size(), 50U) << "hops come before the beat that sounds with them";
}

TEST_F(OutputsThread, tells_earlier_by_the_lead) {
    open("x,lead=80");
    play(milliseconds(300), 20);
    wait_until([] { return notices() == 1; });
    const std::lock_guard lock(told.mutex);
    EXPECT_LE(told.early[0], milliseconds(80) + Nanos(1));
}

TEST_F(OutputsThread, waits_for_a_loudspeaker_that_is_late) {
    open("x");
    feed_->set_heard_after(milliseconds(300));
    play(-milliseconds(250), 20);
    wait_until([] { return notices() == 1; });
    const std::lock_guard lock(told.mutex);
    EXPECT_LE(told.early[0], Nanos(1)) << "handed over 250 ms ago, heard in 50 ms";
}

TEST(OutputWish, is_kept_as_a_text_and_read_again) {
    for (const char* text : {"osc 127.0.0.1:9000,lead=30", "os2l desk", "wled multicast"}) {
        const auto wish = parse_output_wish(text);
        ASSERT_TRUE(wish) << wish.error().message;
        EXPECT_EQ(wish->text(), text);
    }
    EXPECT_EQ(parse_output_wish("ocs x:1").error().message,
              "output \"ocs\" is unknown; did you mean \"osc\"?");
    EXPECT_EQ(parse_output_wish("osc").error().message,
              "--osc: \"\" is no target; write HOST:PORT, a port is 1 to 65535");
}

TEST_F(OutputsThread, shows_how_each_stands) {
    open("x,factor=2");
    const auto status = outputs_->status();
    ASSERT_EQ(status.size(), 1U);
    EXPECT_EQ(status[0].name, "--kept x,factor=2");
    EXPECT_EQ(status[0].trouble, "x: oh");
    play(milliseconds(10), 60);
    wait_until([] { return notices() == 3; });
    wait_until([&] { return outputs_->status()[0].sent == 3; });
    const std::lock_guard lock(told.mutex);
    EXPECT_FALSE(told.notices[1].is_counted) << "half way";
}

TEST_F(OutputsThread, tells_a_song_where_it_is_another_one) {
    open("x");
    const auto titles = [] {
        const std::lock_guard lock(told.mutex);
        return told.titles;
    };
    for (const char* title : {"one", "one", "two"}) {
        outputs_->name_song({title, "somebody"});
        wait_until([&] { return !titles().empty() && titles().back() == title; });
    }
    EXPECT_EQ(titles(), (std::vector<std::string>{"one", "two"}));
}

}  // namespace
}  // namespace raks::engine
