#include "audio/io/opus_stamps.hpp"

#include <algorithm>
#include <array>

namespace raks::audio {
namespace {

constexpr std::uint64_t kHeadPackets = 2;    // OpusHead and OpusTags
constexpr unsigned char kFullSegment = 255;  // its packet goes on in the next one
constexpr std::size_t kStartBytes = 2;       // of a packet, by which its length is known

// Samples of one frame by the configuration, in fours that share a mode and a band width.
std::int64_t frame_samples(unsigned configuration) {
    constexpr std::array<std::int64_t, 4> kSilk{480, 960, 1920, 2880};
    constexpr std::array<std::int64_t, 4> kHybrid{480, 960, 480, 960};
    constexpr std::array<std::int64_t, 4> kCelt{120, 240, 480, 960};
    const auto& table = configuration < 12 ? kSilk : (configuration < 16 ? kHybrid : kCelt);
    return table[configuration % 4];
}

}  // namespace

std::int64_t opus_packet_samples(std::string_view packet) noexcept {
    if (packet.empty()) {
        return 0;
    }
    const auto head = static_cast<unsigned char>(packet[0]);
    const unsigned code = head & 3U;
    std::int64_t frames = code == 0 ? 1 : 2;
    if (code == 3) {
        frames = packet.size() < 2 ? 0 : static_cast<unsigned char>(packet[1]) & 63U;
    }
    return frames * frame_samples(head >> 3U);
}

void OpusStamps::end_packet() {
    samples_ += packets_ < kHeadPackets ? 0 : opus_packet_samples(start_);
    ++packets_;
    start_.clear();
}

void OpusStamps::add(const OpusPage& page) {
    const std::uint64_t before = packets_;
    std::size_t at = 0;
    for (const char segment : page.segments) {
        const auto length = static_cast<unsigned char>(segment);
        const std::size_t wanted = kStartBytes - start_.size();
        start_ +=
            page.body.substr(std::min(at, page.body.size()), std::min<std::size_t>(length, wanted));
        at += length;
        if (length != kFullSegment) {
            end_packet();
        }
    }
    if (page.granule < 0 || packets_ == before || packets_ <= kHeadPackets) {
        return;
    }
    // The first position may have any start: a stream that was cut out of a longer one.
    const std::int64_t added = page.granule - last_;
    const bool fits = page.is_last ? added <= samples_ : added == samples_;
    agree_ = agree_ && (last_ < 0 || fits);
    last_ = page.granule;
    samples_ = 0;
}

}  // namespace raks::audio
