#include "engine/remote/osc_input.hpp"

#include <gtest/gtest.h>
#include <netinet/in.h>
#include <sys/socket.h>

#include <string>
#include <thread>

#include "base/descriptor.hpp"
#include "engine/remote/listen_place.hpp"

namespace raks::engine {
namespace {

/// A socket that is bound nowhere and sends to a port of this machine.
class Sender {
 public:
    explicit Sender(std::uint16_t port) : socket_(::socket(AF_INET, SOCK_DGRAM, 0)) {
        to_.sin_family = AF_INET;
        to_.sin_addr.s_addr = htonl(INADDR_LOOPBACK);
        to_.sin_port = htons(port);
    }
    void send(const std::string& bytes) const {
        sendto(socket_.number,
               bytes.data(),
               bytes.size(),
               0,
               reinterpret_cast<const sockaddr*>(&to_),
               sizeof(to_));
    }

 private:
    Descriptor socket_;
    sockaddr_in to_{};
};

std::uint16_t free_port() {
    const Descriptor socket(bind_to({"127.0.0.1", 0}, SOCK_DGRAM).value());
    return port_of_socket(socket.number);
}

const std::string kTap("/raks/do/tap\0\0\0\0,\0\0\0", 20);

TEST(OscInput, hands_requests_on_and_counts_what_it_cannot_read) {
    RequestInbox inbox;
    const std::uint16_t port = free_port();
    const auto input = OscInput::open(std::to_string(port), inbox);
    ASSERT_TRUE(input) << input.error().message;
    EXPECT_EQ((*input)->place(), "127.0.0.1:" + std::to_string(port));
    const Sender sender(port);
    const HostTime before = HostClock::now();
    sender.send(kTap);
    while ((*input)->taken() < 1) {
        std::this_thread::yield();
    }
    sender.send("nonsense");
    sender.send(std::string(9000, '/'));
    while ((*input)->passed_over() < 2) {
        std::this_thread::yield();
    }
    EXPECT_NE((*input)->take_trouble(), std::nullopt);
    EXPECT_EQ((*input)->take_trouble(), std::nullopt) << "said once";
    std::vector<HostTime> taps;
    ActionDispatcher actions([](const std::string&) {});
    actions.on_dated(Action::tap_tempo, [&](double, HostTime came) { taps.push_back(came); });
    EXPECT_EQ(inbox.carry_out(actions), std::nullopt);
    ASSERT_EQ(taps.size(), 1U);
    EXPECT_GE(taps[0], before);
    EXPECT_LE(taps[0], HostClock::now());
}

TEST(OscInput, a_flood_fills_the_inbox_and_no_more) {
    RequestInbox inbox;
    const std::uint16_t port = free_port();
    const auto input = OscInput::open("127.0.0.1:" + std::to_string(port), inbox);
    ASSERT_TRUE(input) << input.error().message;
    const Sender sender(port);
    // Until more were passed over than fit: whatever the system lost of them meanwhile.
    while ((*input)->passed_over() < 500) {
        sender.send(kTap);
    }
    EXPECT_EQ((*input)->taken(), RequestInbox::kRoom);
    EXPECT_EQ(inbox.refused() > 0, true);
}

TEST(OscInput, a_port_that_is_taken_is_one_line) {
    RequestInbox inbox;
    const Descriptor held(bind_to({"127.0.0.1", 0}, SOCK_DGRAM).value());
    const std::string port = std::to_string(port_of_socket(held.number));
    const auto input = OscInput::open(port, inbox);
    ASSERT_FALSE(input);
    EXPECT_EQ(input.error().message, "--osc-in: 127.0.0.1:" + port + ": Address already in use");
}

}  // namespace
}  // namespace raks::engine
