#include "engine/outputs/wled_output.hpp"

#include <gtest/gtest.h>

#include <bit>
#include <optional>
#include <vector>

#include "tests/support/peers.hpp"

namespace raks::engine {
namespace {

using std::chrono::milliseconds;

float float_at(const std::string& packet, std::size_t at) {
    std::uint32_t bits = 0;
    for (std::size_t i = 0; i < 4; ++i) {
        bits |= static_cast<std::uint32_t>(static_cast<unsigned char>(packet[at + i])) << (8 * i);
    }
    return std::bit_cast<float>(bits);
}

class Wled : public ::testing::Test {
 protected:
    void SetUp() override {
        auto opened = open_wled(light_.place());
        ASSERT_TRUE(opened) << opened.error().message;
        output_ = std::move(*opened);
    }
    void hear(std::uint8_t value, float hertz) {
        MusicState music;
        music.spectrum.bands.fill(value);
        music.spectrum.bands[15] = 0;
        music.spectrum.strongest_hz = hertz;
        output_->hear({music, {}, {}});
    }
    /// The packets of the next `span`, by turns of 5 ms. No line: nothing is followed.
    std::vector<std::string> packets_of(Nanos span,
                                        const std::optional<HeardLine>& line = HeardLine{}) {
        for (const HostTime end = now_ + span; now_ < end; now_ += milliseconds(5)) {
            output_->turn({now_, line});
        }
        return light_.take_all();
    }

    test::UdpReceiver light_;
    HostTime now_ = host_now();
    std::unique_ptr<Output> output_;
};

TEST_F(Wled, packets_have_the_bytes_of_sound_sync_2) {
    hear(200, 440.0F);
    const std::vector<std::string> packets = packets_of(milliseconds(5));
    ASSERT_EQ(packets.size(), 1U);
    const std::string& packet = packets[0];
    ASSERT_EQ(packet.size(), 44U);
    EXPECT_EQ(packet.substr(0, 8), std::string("00002\0\0\0", 8));
    EXPECT_EQ(float_at(packet, 8), 200.0F);
    EXPECT_FLOAT_EQ(float_at(packet, 12), 30.0F);
    EXPECT_EQ(packet[16], 0);
    EXPECT_EQ(packet[17], 0);
    for (std::size_t band = 0; band < 16; ++band) {
        EXPECT_EQ(static_cast<unsigned char>(packet[18 + band]), band == 15 ? 0 : 200);
    }
    EXPECT_EQ(packet.substr(34, 2), std::string("\0\0", 2));
    EXPECT_EQ(float_at(packet, 36), 1600.0F);
    EXPECT_EQ(float_at(packet, 40), 440.0F);
}

TEST_F(Wled, there_are_50_a_second_and_none_is_made_up_for) {
    EXPECT_EQ(packets_of(std::chrono::seconds(1)).size(), 50U);
    now_ += std::chrono::seconds(5);
    EXPECT_EQ(packets_of(milliseconds(100)).size(), 5U);
}

TEST_F(Wled, a_beat_is_the_peak_of_five_packets) {
    EXPECT_EQ(packets_of(milliseconds(40)).size(), 2U);
    output_->tell({});
    std::string peaks;
    for (const std::string& packet : packets_of(milliseconds(160))) {
        peaks += packet[16] == 1 ? '1' : '0';
    }
    EXPECT_EQ(peaks, "11111000");
}

TEST_F(Wled, lights_go_out_when_nothing_comes_any_more) {
    hear(255, 100.0F);
    const std::vector<std::string> packets = packets_of(milliseconds(300));
    EXPECT_EQ(float_at(packets.front(), 8), 255.0F);
    EXPECT_EQ(float_at(packets.back(), 8), 0.0F);
    EXPECT_EQ(float_at(packets.back(), 40), 0.0F);
}

TEST_F(Wled, a_last_packet_puts_the_lights_out_when_nothing_is_followed) {
    hear(255, 100.0F);
    EXPECT_EQ(packets_of(milliseconds(100)).size(), 5U);
    output_->tell({});
    const std::vector<std::string> packets = packets_of(std::chrono::seconds(1), std::nullopt);
    ASSERT_EQ(packets.size(), 6U);
    EXPECT_EQ(packets[4][16], 1);
    EXPECT_EQ(packets[5][16], 0);
    EXPECT_EQ(float_at(packets[5], 8), 0.0F);
    EXPECT_EQ(float_at(packets[5], 12), 0.0F);
}

TEST_F(Wled, the_end_tells_a_beat_that_waits_and_puts_the_lights_out) {
    hear(255, 100.0F);
    EXPECT_EQ(packets_of(milliseconds(5)).size(), 1U);
    output_->tell({});
    output_.reset();
    const std::vector<std::string> packets = light_.take_all();
    ASSERT_EQ(packets.size(), 2U);
    EXPECT_EQ(packets[0][16], 1);
    EXPECT_EQ(packets[1][16], 0);
    EXPECT_EQ(float_at(packets[1], 8), 0.0F);
}

TEST_F(Wled, nothing_is_sent_where_nothing_was_heard) {
    EXPECT_TRUE(packets_of(milliseconds(100), std::nullopt).empty());
    output_.reset();
    EXPECT_TRUE(light_.take_all().empty());
}

}  // namespace
}  // namespace raks::engine
