#include "engine/remote/listen_place.hpp"

#include <gtest/gtest.h>
#include <sys/socket.h>

#include <string>
#include <vector>

#include "base/descriptor.hpp"

namespace raks::engine {
namespace {

TEST(ListenPlace, reads_addresses_and_ports) {
    struct Case {
        const char* text;
        const char* place;
        bool is_loopback;
    };
    for (const Case& row : std::vector<Case>{{"9000", "127.0.0.1:9000", true},
                                             {"0.0.0.0", "0.0.0.0:7880", false},
                                             {"0.0.0.0:1", "0.0.0.0:1", false},
                                             {"127.0.0.2:65535", "127.0.0.2:65535", true},
                                             {"::1", "[::1]:7880", true},
                                             {"[::1]", "[::1]:7880", true},
                                             {"[::1]:9000", "[::1]:9000", true},
                                             {"::", "[::]:7880", false}}) {
        const auto place = parse_listen_place(row.text, 7880);
        ASSERT_TRUE(place) << row.text << ": " << place.error().message;
        EXPECT_EQ(place->text(), row.place);
        EXPECT_EQ(place->is_loopback(), row.is_loopback) << row.text;
    }
}

TEST(ListenPlace, says_what_is_wrong) {
    const auto fault = [](const char* text) {
        const auto place = parse_listen_place(text, std::nullopt);
        return place ? place->text() : place.error().message;
    };
    EXPECT_EQ(fault("0"), "port \"0\" must be 1 to 65535");
    EXPECT_EQ(fault("65536"), "port \"65536\" must be 1 to 65535");
    EXPECT_EQ(fault("127.0.0.1:x"), "port \"x\" must be 1 to 65535");
    EXPECT_EQ(fault("127.0.0.1:"), "port \"\" must be 1 to 65535");
    EXPECT_EQ(fault("127.0.0.1"), "a port is missing: ADDRESS:PORT");
    for (const char* text : {"", "studio:9000", "-1", "127.0.0.1.5:9", "[::1:9", "[]:9"}) {
        EXPECT_TRUE(fault(text).find("is no numeric address") != std::string::npos)
            << text << ": " << fault(text);
    }
}

TEST(ListenPlace, a_port_that_is_taken_is_said) {
    const auto first = bind_to({"127.0.0.1", 0}, SOCK_DGRAM);
    ASSERT_TRUE(first) << first.error().message;
    const Descriptor held(*first);
    const std::uint16_t port = port_of_socket(held.number);
    EXPECT_GT(port, 0);
    const auto second = bind_to({"127.0.0.1", port}, SOCK_DGRAM);
    ASSERT_FALSE(second);
    EXPECT_EQ(second.error().message,
              "127.0.0.1:" + std::to_string(port) + ": Address already in use");
}

}  // namespace
}  // namespace raks::engine
