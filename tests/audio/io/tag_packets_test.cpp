#include "audio/io/tag_packets.hpp"

#include <gtest/gtest.h>

#include <string>
#include <vector>

namespace raks::audio {
namespace {

bool is_tag(TagPackets& packets, const std::string& bytes) {
    return packets.is_tag({reinterpret_cast<const std::uint8_t*>(bytes.data()), bytes.size()});
}

TEST(TagPackets, are_known_by_how_they_begin) {
    for (const std::string tag : {"TAGtitle", "APETAGEX....", "LYRICSBEGIN"}) {
        TagPackets packets;
        EXPECT_TRUE(is_tag(packets, tag)) << tag;
    }
    TagPackets packets;
    EXPECT_TRUE(is_tag(packets, std::string(128, '\0')));
    EXPECT_TRUE(is_tag(packets, ""));
    EXPECT_FALSE(is_tag(packets, "TA"));
    EXPECT_FALSE(is_tag(packets, std::string("\xff\xfb\x92\x64 damaged", 12)));
    EXPECT_FALSE(is_tag(packets, "ID3")) << "no whole head";
}

TEST(TagPackets, follow_a_long_tag_to_its_end) {
    TagPackets packets;
    // 1 * 128 + 2 bytes behind the head of 10.
    EXPECT_TRUE(is_tag(packets, std::string("ID3\4\0\0\0\0\1\2picture", 17)));
    EXPECT_TRUE(is_tag(packets, std::string(100, 'x')));
    EXPECT_TRUE(is_tag(packets, std::string(23, 'x'))) << "the last bytes of it";
    EXPECT_FALSE(is_tag(packets, std::string(23, 'x')));
}

}  // namespace
}  // namespace raks::audio
