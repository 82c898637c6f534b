// Sockets to peers that are not as they should be: one line, then quiet, and never a wait.
#include <gtest/gtest.h>

#include <functional>

#include "engine/outputs/tcp_peer.hpp"
#include "engine/outputs/udp_peer.hpp"
#include "tests/support/peers.hpp"

namespace raks::engine {
namespace {

using std::chrono::milliseconds;
using std::chrono::seconds;

// A port at which nobody listens any more.
HostPort nobody() { return {"127.0.0.1", test::UdpReceiver().port()}; }

// Turns until something is said, on a clock that runs ahead; names are looked up meanwhile.
template <typename Peer>
std::optional<std::string> line_of(
    Peer& peer, const std::function<void()>& each = [] {}) {
    HostTime now = host_now();
    for (const HostTime end = host_now() + seconds(20); host_now() < end;) {
        peer.turn(now += milliseconds(50));
        each();
        if (auto line = peer.take_trouble()) {
            return line;
        }
    }
    return std::nullopt;
}

TEST(UdpPeer, sends_a_datagram_as_it_is) {
    test::UdpReceiver receiver;
    UdpPeer peer({"127.0.0.1", receiver.port()});
    const std::string bytes("a\0b", 3);
    EXPECT_TRUE(peer.send(bytes));
    EXPECT_EQ(receiver.take_all(), std::vector<std::string>{bytes});
    EXPECT_FALSE(peer.take_trouble());
}

TEST(UdpPeer, says_once_that_nobody_listens_and_sends_on) {
    const HostPort place = nobody();
    UdpPeer peer(place);
    const auto line = line_of(peer, [&] { static_cast<void>(peer.send(std::string("x"))); });
    ASSERT_TRUE(line);
    EXPECT_EQ(*line, place.text() + ": nobody listens there; it is sent on");
    for (int i = 0; i < 10; ++i) {
        static_cast<void>(peer.send(std::string("x")));
        EXPECT_FALSE(peer.take_trouble());
    }
    test::UdpReceiver back(place.port);
    static_cast<void>(peer.send(std::string("y")));
    EXPECT_TRUE(peer.send(std::string("z")));
    EXPECT_EQ(back.take_all(), (std::vector<std::string>{"y", "z"}));
}

TEST(UdpPeer, says_once_that_a_host_is_not_known) {
    UdpPeer peer({"no-such-host.invalid", 9000});
    EXPECT_FALSE(peer.send(std::string("x"))) << "it is still looked up";
    const auto line = line_of(peer);
    ASSERT_TRUE(line);
    EXPECT_TRUE(line->starts_with("no-such-host.invalid:9000: the host is not known (")) << *line;
    HostTime now = host_now();
    for (int i = 0; i < 10; ++i) {
        peer.turn(now += seconds(11));
        EXPECT_FALSE(peer.take_trouble());
    }
}

TEST(TcpPeer, says_once_that_it_is_refused_and_tries_again_ever_more_seldom) {
    const HostPort place = nobody();
    TcpPeer peer(place);
    const auto line = line_of(peer);
    ASSERT_TRUE(line);
    EXPECT_EQ(*line, place.text() + ": Connection refused; it is tried again, in silence");
    EXPECT_FALSE(peer.is_connected());
    EXPECT_FALSE(peer.send("x", host_now()));
    EXPECT_FALSE(peer.take_trouble());
    test::TcpListener back(place.port);
    HostTime now = host_now() + seconds(1);
    for (int i = 0; i < 8 && !peer.is_connected(); ++i) {
        peer.turn(now += seconds(3));
    }
    ASSERT_TRUE(back.accept());
    peer.turn(now);
    EXPECT_TRUE(peer.send("hello", now));
    EXPECT_EQ(back.read(), "hello");
    EXPECT_FALSE(peer.take_trouble());
}

TEST(TcpPeer, never_waits_for_a_server_that_does_not_read) {
    test::TcpListener hole;
    TcpPeer peer({"127.0.0.1", hole.port()});
    HostTime now = host_now();
    for (int i = 0; i < 5; ++i) {
        peer.turn(now += seconds(1));
    }
    ASSERT_TRUE(hole.accept());
    peer.turn(now);
    const std::string message(1'000, 'x');
    int sent = 0;
    while (sent < 1'000'000 && peer.send(message, now)) {
        ++sent;
    }
    EXPECT_LT(sent, 1'000'000) << "what nobody reads is not kept without end";
    EXPECT_TRUE(peer.take_trouble());
    static_cast<void>(peer.send(message, now));
    EXPECT_FALSE(peer.take_trouble());
}

}  // namespace
}  // namespace raks::engine
