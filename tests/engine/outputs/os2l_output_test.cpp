#include "engine/outputs/os2l_output.hpp"

#include <gtest/gtest.h>

#include <nlohmann/json.hpp>
#include <vector>

#include "tests/support/peers.hpp"

namespace raks::engine {
namespace {

using std::chrono::milliseconds;

/// A light program that listens, and a clock that is turned by hand.
class Os2l : public ::testing::Test {
 protected:
    void SetUp() override {
        auto opened = open_os2l(desk_.place());
        ASSERT_TRUE(opened) << opened.error().message;
        output_ = std::move(*opened);
        ASSERT_TRUE(connect());
    }
    [[nodiscard]] bool connect() {
        for (int i = 0; i < 3; ++i) {
            turn(milliseconds(600));
        }
        const bool is_accepted = desk_.accept();
        turn(milliseconds(100));
        return is_accepted;
    }
    void turn(Nanos later, std::optional<Nanos> next_beat_in = std::nullopt) {
        now_ += later;
        OutputTurn turn{now_};
        if (next_beat_in) {
            turn.next_beat = now_ + *next_beat_in;
        }
        output_->turn(turn);
    }
    void tell_beat(bool is_change = false) {
        OutputMoment moment;
        moment.notice.is_change = is_change;
        moment.notice.paced_tempo = Bpm(120.5);
        moment.notice.confidence = 0.9F;
        moment.heard_at = now_;
        output_->tell(moment);
    }
    void tell_drop() {
        OutputMoment moment;
        moment.notice.kind = Notice::Kind::event;
        moment.notice.event = MusicEvent::Kind::drop;
        moment.heard_at = now_;
        output_->tell(moment);
    }
    void hear(MusicPart part, DanceId genre = DanceId::none, DanceId danced = DanceId::none) {
        MusicState music;
        music.part = part;
        music.genre = genre;
        FeedFigure figure;
        figure.dance = danced;
        output_->hear({music, figure, dances_});
    }
    static DanceList two_dances() {
        DanceInfo polka;
        polka.name = "polka";
        DanceInfo tango;
        tango.name = "tango";
        return DanceList({polka, tango});
    }
    static std::string button(const std::string& name, const std::string& state) {
        return R"({"evt":"btn","name":")" + name + R"(","state":")" + state + "\"}\n";
    }

    test::TcpListener desk_;
    DanceList dances_ = two_dances();
    HostTime now_ = host_now();
    std::unique_ptr<Output> output_;
};

TEST_F(Os2l, beats_are_one_object_a_line) {
    tell_beat(true);
    turn(milliseconds(0));
    EXPECT_EQ(desk_.read(),
              R"({"evt":"beat","change":true,"pos":0,"bpm":120.5,"strength":0.9})"
              "\n");
    tell_beat();
    turn(milliseconds(500));
    EXPECT_EQ(desk_.read(),
              R"({"evt":"beat","change":false,"pos":1,"bpm":120.5,"strength":0.9})"
              "\n");
    EXPECT_EQ(output_->sent(), 2U);
}

TEST_F(Os2l, two_messages_are_never_nearer_than_60_ms_and_the_beat_goes_first) {
    tell_drop();
    tell_beat();
    turn(milliseconds(0), milliseconds(500));
    EXPECT_TRUE(desk_.read().starts_with(R"({"evt":"beat")"));
    turn(milliseconds(59), milliseconds(441));
    EXPECT_EQ(output_->sent(), 1U);
    ASSERT_TRUE(output_->due());
    EXPECT_EQ(*output_->due(), now_ + milliseconds(1));
    turn(milliseconds(1), milliseconds(440));
    EXPECT_EQ(desk_.read(), button("raks-drop", "on"));
    // It would be too near before the next beat.
    turn(milliseconds(2'000), milliseconds(59));
    EXPECT_EQ(output_->sent(), 2U);
    tell_beat();
    turn(milliseconds(59), milliseconds(500));
    EXPECT_TRUE(desk_.read().starts_with(R"({"evt":"beat")"));
    turn(milliseconds(60), milliseconds(440));
    EXPECT_EQ(desk_.read(), button("raks-drop", "off"));
}

TEST_F(Os2l, buttons_follow_the_part_and_the_dance) {
    hear(MusicPart::breakdown, DanceId{0});
    turn(milliseconds(0));
    EXPECT_EQ(desk_.read(), button("raks-breakdown", "on"));
    turn(milliseconds(60));
    EXPECT_EQ(desk_.read(), button("raks-polka", "on"));
    hear(MusicPart::playing, DanceId{0}, DanceId{1});
    for (const auto& [name, state] : {std::pair("raks-breakdown", "off"),
                                      std::pair("raks-polka", "off"),
                                      std::pair("raks-tango", "on")}) {
        turn(milliseconds(60));
        EXPECT_EQ(desk_.read(), button(name, state));
    }
}

TEST_F(Os2l, a_button_that_waited_a_second_says_nothing_any_more) {
    tell_drop();
    for (int i = 0; i < 30; ++i) {
        turn(milliseconds(40), milliseconds(50));
    }
    turn(milliseconds(0));
    EXPECT_EQ(output_->sent(), 0U);
    EXPECT_EQ(output_->dropped(), 1U);
}

TEST_F(Os2l, what_the_desk_says_is_thrown_away) {
    desk_.write(std::string(200'000, 'x'));
    for (int i = 0; i < 100; ++i) {
        turn(milliseconds(5));
    }
    tell_beat();
    turn(milliseconds(5));
    EXPECT_TRUE(desk_.read().starts_with(R"({"evt":"beat")"));
}

TEST_F(Os2l, a_desk_that_goes_is_said_once_and_found_again) {
    const auto lose = [&] {
        desk_.hang_up();
        // Until it is noticed; a beat to a desk that has gone is lost.
        for (int i = 0; i < 100 && !output_->dropped(); ++i) {
            tell_beat();
            turn(milliseconds(100));
        }
    };
    lose();
    const auto line = output_->take_trouble();
    ASSERT_TRUE(line);
    EXPECT_TRUE(line->starts_with(desk_.place())) << *line;
    ASSERT_TRUE(connect());
    tell_beat();
    turn(milliseconds(100));
    EXPECT_TRUE(desk_.read().starts_with(R"({"evt":"beat")"));
    lose();
    EXPECT_FALSE(output_->take_trouble()) << "quiet from then on";
}

}  // namespace
}  // namespace raks::engine
