#include "engine/remote/osc_requests.hpp"

#include <gtest/gtest.h>
#include <oscpack/osc/OscOutboundPacketStream.h>

#include <array>
#include <chrono>
#include <cmath>
#include <cstdint>
#include <limits>
#include <string>
#include <vector>

namespace raks::engine {
namespace {

const HostTime kReadAt = HostTime(std::chrono::seconds(5));

template <typename... Arguments>
OscRequests read(const std::string& address, Arguments... arguments) {
    std::array<char, 1024> bytes{};
    osc::OutboundPacketStream stream(bytes.data(), bytes.size());
    stream << osc::BeginMessage(address.c_str());
    static_cast<void>((stream << ... << arguments));
    stream << osc::EndMessage;
    return read_osc_requests({stream.Data(), stream.Size()}, kReadAt);
}

TEST(OscRequests, takes_one_number_or_text_or_none) {
    const auto only = [](const OscRequests& read) {
        EXPECT_EQ(read.faults, 0U) << read.fault;
        EXPECT_EQ(read.requests.size(), 1U);
        return read.requests.empty() ? ActionRequest{} : read.requests[0];
    };
    EXPECT_EQ(only(read("/raks/do/tap")).action, Action::tap_tempo);
    EXPECT_EQ(only(read("/raks/do/tap")).came, kReadAt);
    EXPECT_EQ(only(read("/raks/do/tap", 1.0F)).action, Action::tap_tempo);
    EXPECT_EQ(only(read("/raks/do/tap", std::int32_t{1})).action, Action::tap_tempo);
    EXPECT_EQ(only(read("/raks/do/tap", true)).action, Action::tap_tempo);
    EXPECT_EQ(only(read("/raks/do/nudge", -12.5F)).value, -12.5);
    EXPECT_EQ(only(read("/raks/do/nudge", 10.0)).value, 10.0);
    EXPECT_EQ(only(read("/raks/do/select-figure", std::int32_t{3})).value, 3.0);
    EXPECT_EQ(only(read("/raks/do/set-tempo", "96.5")).value, 96.5);
    EXPECT_EQ(only(read("/raks/do/dance", "salsa")).text, "salsa");
    EXPECT_EQ(only(read("/raks/do/dance", 1.0F)).text, "") << "a button: on to the list";
}

TEST(OscRequests, a_button_that_is_let_go_does_nothing) {
    for (const char* name : {"tap", "nudge", "dance", "select-figure", "set-tempo"}) {
        const auto read = raks::engine::read("/raks/do/" + std::string(name), 0.0F);
        EXPECT_TRUE(read.requests.empty()) << name;
        EXPECT_EQ(read.faults, 0U) << name;
    }
    EXPECT_TRUE(read("/raks/do/tap", false).requests.empty());
}

TEST(OscRequests, what_cannot_be_read_is_counted_and_said) {
    constexpr float kNan = std::numeric_limits<float>::quiet_NaN();
    const auto fault = [](const OscRequests& read) {
        EXPECT_TRUE(read.requests.empty());
        EXPECT_EQ(read.faults, 1U);
        return read.fault;
    };
    EXPECT_EQ(fault(read("/raks/beat", 1.0F)),
              "/raks/beat is unknown: addresses begin with /raks/do/");
    EXPECT_EQ(fault(read("/raks/do/quit")),
              "action quit: only who sits at the program may ask for it");
    EXPECT_EQ(fault(read("/raks/do/nudge", kNan)), "nudge: a number or a text is taken");
    EXPECT_EQ(fault(read("/raks/do/nudge", 1.0 / 0.0)), "nudge: a number or a text is taken");
    EXPECT_EQ(fault(read("/raks/do/nudge", 1.0F, 2.0F)), "nudge: one argument is taken");
    EXPECT_EQ(fault(read("/raks/do/nudge")), "action nudge: it takes a number in ms");
    EXPECT_EQ(fault(read("/raks/do/avatar", "/etc/passwd")),
              "action avatar: a name is taken, no path");
}

TEST(OscRequests, bundles_are_read_four_deep) {
    for (const int depth : {1, kDeepestOscBundle, kDeepestOscBundle + 1}) {
        std::array<char, 1024> bytes{};
        osc::OutboundPacketStream stream(bytes.data(), bytes.size());
        for (int i = 0; i < depth; ++i) {
            stream << osc::BeginBundle(12345);
        }
        stream << osc::BeginMessage("/raks/do/tap") << osc::EndMessage;
        for (int i = 0; i < depth; ++i) {
            stream << osc::EndBundle;
        }
        const auto read = read_osc_requests({stream.Data(), stream.Size()}, kReadAt);
        EXPECT_EQ(read.requests.size(), depth <= kDeepestOscBundle ? 1U : 0U) << depth;
        EXPECT_EQ(read.faults, depth <= kDeepestOscBundle ? 0U : 1U) << depth;
    }
}

TEST(OscRequests, bytes_that_are_no_osc_ask_for_nothing) {
    std::vector<std::string> packets = {"", "x", "/raks/do/tap", std::string(8193, '/')};
    packets.push_back(std::string("#bundle\0\0\0\0\0\0\0\0\1\177\377\377\377", 20));
    // Its part is four bytes less than nothing long: it would never end.
    packets.push_back(std::string("#bundle\0\0\0\0\0\0\0\0\1\377\377\377\374", 20));
    packets.push_back(std::string("/raks/do/nudge\0\0,f\0\0", 20));  // its number is missing
    packets.push_back(std::string("/raks/do/tap\0\0\0\0,\377\377\377", 20));
    for (const std::string& packet : packets) {
        const auto read = read_osc_requests(packet, kReadAt);
        EXPECT_TRUE(read.requests.empty()) << packet.substr(0, 40);
        EXPECT_GE(read.faults, 1U) << packet.substr(0, 40);
        EXPECT_FALSE(read.fault.empty());
    }
}

}  // namespace
}  // namespace raks::engine
