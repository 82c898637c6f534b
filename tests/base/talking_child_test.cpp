// Talks with programs of ours whose other end may say anything, too little, or nothing.
#include "base/talking_child.hpp"

#include <gtest/gtest.h>

#include <array>
#include <string>
#include <string_view>

#include "base/talk_answer.hpp"

namespace raks {
namespace {

constexpr TalkDeadline kPast{};

class Talking : public testing::Test {
 protected:
    Talking() { EXPECT_TRUE(ends_.make_sockets(SOCK_STREAM)); }

    void say(std::string_view words) {
        EXPECT_EQ(send_all(ends_.childs.number, std::as_bytes(std::span(words)), kNever),
                  Talk::good);
    }
    Talk receive_eight(const Patience& patience) {
        std::array<std::byte, 8> bytes{};
        return receive_all(ends_.ours.number, bytes, patience);
    }
    TalkAnswer answer_of(const Expected<std::span<const std::byte>>& made, bool is_caged) {
        EXPECT_EQ(send_answer(ends_.childs.number, made, is_caged), Talk::good);
        TalkAnswer answer;
        EXPECT_EQ(receive_answer(ends_.ours.number, made_, kNever, answer), Talk::good);
        return answer;
    }

    TalkEnds ends_;
    std::array<std::byte, 4> made_{};
};

TEST_F(Talking, with_one_who_says_too_little_ends_as_patience_does) {
    say("1234");
    EXPECT_EQ(receive_eight(until(kPast)), Talk::late);
    EXPECT_EQ(receive_eight(until(kNever, [] { return true; })), Talk::stopped);
    EXPECT_EQ(wait_to_receive(ends_.ours.number, until(kPast)), Talk::late);
    ends_.childs.close();
    EXPECT_EQ(wait_to_receive(ends_.ours.number, until(kNever)), Talk::good);
    EXPECT_EQ(receive_eight(until(kNever)), Talk::broke);
}

TEST_F(Talking, gives_what_was_made_or_why_not_in_one_line) {
    const std::array<std::byte, 4> made{std::byte{1}, std::byte{2}, std::byte{3}, std::byte{4}};
    const TalkAnswer good = answer_of(made, true);
    EXPECT_TRUE(good.done);
    EXPECT_TRUE(good.is_caged);
    EXPECT_EQ(made_, made);
    EXPECT_FALSE(is_any_child_uncaged());
    const TalkAnswer bad = answer_of(fail("broken\n" + std::string(5000, 'x')), false);
    ASSERT_FALSE(bad.done);
    EXPECT_EQ(bad.done.error().message.rfind("broken?x", 0), 0U);
    EXPECT_LE(bad.done.error().message.size(), 1000U);
    EXPECT_FALSE(bad.is_caged);
    EXPECT_TRUE(is_any_child_uncaged());
}

}  // namespace
}  // namespace raks
