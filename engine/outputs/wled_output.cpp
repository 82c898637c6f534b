#include "engine/outputs/wled_output.hpp"

#include <algorithm>
#include <array>
#include <bit>
#include <cstring>
#include <functional>
#include <numeric>
#include <utility>

#include "engine/outputs/paced_turns.hpp"
#include "engine/outputs/udp_peer.hpp"

namespace raks::engine {
namespace {

constexpr std::uint16_t kSoundSyncPort = 11988;
constexpr const char* kGroup = "239.0.0.1";
constexpr double kPacketsPerSecond = 50.0;
constexpr int kPeakPackets = 5;                           // one beat shows in so many
constexpr Nanos kStale = std::chrono::milliseconds(200);  // then nothing sounds
constexpr float kSmoothing = 0.15F;                       // of a packet
constexpr float kMagnitude = 8.0F;                        // of a band's unit
constexpr std::size_t kLoudestBands = 4;                  // make the volume

struct WledTarget {
    HostPort place;
    OutputTiming timing;
};

Expected<WledTarget> read_wled(const std::string& target) {
    TargetReader reader(target);
    WledTarget read;
    if (reader.place() == "multicast") {
        read.place = {kGroup, kSoundSyncPort};
    } else {
        read.place = reader.host_port(kSoundSyncPort);
    }
    read.timing = reader.timing();
    if (auto done = reader.finish(); !done) {
        return fail(done.error());
    }
    return read;
}

// The packet as WLED's audioSyncPacket has it, little-endian.
class SoundSyncPacket {
 public:
    static constexpr std::size_t kBytes = 44;

    SoundSyncPacket() { std::memcpy(bytes_.data(), "00002", 6); }
    void set_volume(float raw, float smooth) {
        put(8, raw);
        put(12, smooth);
    }
    void set_peak(bool is_peak) { bytes_[16] = is_peak ? 1 : 0; }
    void set_spectrum(const MusicSpectrum& spectrum, float magnitude) {
        std::memcpy(bytes_.data() + 18, spectrum.bands.data(), spectrum.bands.size());
        put(36, magnitude);
        put(40, spectrum.strongest_hz);
    }
    [[nodiscard]] std::span<const char> bytes() const noexcept { return bytes_; }

 private:
    void put(std::size_t at, float value) {
        const auto bits = std::bit_cast<std::uint32_t>(value);
        for (std::size_t i = 0; i < 4; ++i) {
            bytes_[at + i] = static_cast<char>((bits >> (8 * i)) & 0xFFU);
        }
    }

    std::array<char, kBytes> bytes_{};
};

class WledOutput final : public Output {
 public:
    explicit WledOutput(const WledTarget& target) : Output(target.timing), peer_(target.place) {}
    ~WledOutput() override {
        if (peaks_left_ == kPeakPackets) {
            send_packet();  // a beat that no packet has told yet
        }
        if (is_lit_) {
            send_dark();
        }
    }

    void tell(const OutputMoment& moment) override {
        if (moment.notice.kind == Notice::Kind::beat && moment.notice.is_paced) {
            peaks_left_ = kPeakPackets;
        }
    }

    void hear(const OutputHop& hop) override {
        spectrum_ = hop.music.spectrum;
        has_heard_ = true;
    }

    void turn(const OutputTurn& turn) override {
        peer_.turn(turn.now);
        if (std::exchange(has_heard_, false)) {
            heard_at_ = turn.now;
        }
        // A beat may be told as the last of what is heard.
        const bool sounds = turn.line || peaks_left_ > 0;
        if ((!sounds && !is_lit_) || !turns_.take(turn.now)) {
            return;
        }
        if (!sounds) {
            send_dark();
            return;
        }
        if (turn.now - heard_at_ > kStale) {
            spectrum_ = {};
        }
        send_packet();
    }

    [[nodiscard]] std::optional<HostTime> due() const override { return turns_.next(); }
    std::optional<std::string> take_trouble() override { return peer_.take_trouble(); }

 private:
    void send_packet() {
        auto loudest = spectrum_.bands;
        std::partial_sort(
            loudest.begin(), loudest.begin() + kLoudestBands, loudest.end(), std::greater<>());
        const float raw = static_cast<float>(std::accumulate(
                              loudest.begin(), loudest.begin() + kLoudestBands, 0)) /
                          static_cast<float>(kLoudestBands);
        smooth_ += kSmoothing * (raw - smooth_);
        SoundSyncPacket packet;
        packet.set_volume(raw, smooth_);
        packet.set_peak(peaks_left_ > 0);
        packet.set_spectrum(spectrum_, kMagnitude * static_cast<float>(loudest.front()));
        peaks_left_ = std::max(0, peaks_left_ - 1);
        count(peer_.send(packet.bytes()));
        is_lit_ = true;
    }
    // The last one: lights would hold what they heard until they give up waiting.
    void send_dark() {
        spectrum_ = {};
        smooth_ = 0.0F;
        peaks_left_ = 0;
        send_packet();
        is_lit_ = false;
    }

    UdpPeer peer_;
    PacedTurns turns_{kPacketsPerSecond};
    MusicSpectrum spectrum_;
    bool has_heard_ = false;  // since the last turn
    HostTime heard_at_{};
    float smooth_ = 0.0F;
    int peaks_left_ = 0;
    bool is_lit_ = false;  // packets were sent, and no last one
};

}  // namespace

Expected<std::unique_ptr<Output>> open_wled(const std::string& target) {
    const auto read = read_wled(target);
    if (!read) {
        return fail("--wled " + target + ": " + read.error().message);
    }
    return std::make_unique<WledOutput>(*read);
}

Expected<void> check_wled(const std::string& target) {
    const auto read = read_wled(target);
    return read ? Expected<void>() : fail(read.error());
}

}  // namespace raks::engine
