#pragma once

#include <oscpack/osc/OscOutboundPacketStream.h>

#include <array>
#include <cstdint>
#include <span>
#include <string>

#include "base/time.hpp"

namespace raks::engine {

/// The NTP time of a moment, as OSC writes it: seconds since 1900 in units of 2^-32.
[[nodiscard]] std::uint64_t osc_time(HostTime moment);

/// One OSC 1.0 packet that is being written, a message or a bundle of messages; the caller keeps it
/// below kRoom. Numbers are std::int32_t or float.
/// Threads: one. Real-time: no allocation.
class OscPacket {
 public:
    static constexpr std::size_t kRoom = 1'200;  ///< bytes: no network cuts it

    /// Of one message.
    OscPacket() : stream_(bytes_.data(), bytes_.size()) {}
    /// A bundle of this time, which has no messages yet.
    explicit OscPacket(std::uint64_t time) : OscPacket() {
        stream_ << osc::BeginBundle(time);
        is_bundle_ = true;
    }
    OscPacket(const OscPacket&) = delete;             ///< the writer refers to the bytes
    OscPacket& operator=(const OscPacket&) = delete;  ///< likewise

    /// The message, or one more of a bundle.
    template <typename... Arguments>
    void add(const std::string& address, Arguments... arguments) {
        stream_ << osc::BeginMessage(address.c_str());
        (static_cast<void>(stream_ << arguments), ...);
        stream_ << osc::EndMessage;
        ++messages_;
    }
    /// How many messages it has.
    [[nodiscard]] int messages() const noexcept { return messages_; }
    /// The bytes. Nothing may be added after that.
    [[nodiscard]] std::span<const char> finish() {
        if (is_bundle_ && stream_.IsBundleInProgress()) {
            stream_ << osc::EndBundle;
        }
        return {stream_.Data(), stream_.Size()};
    }

 private:
    std::array<char, kRoom> bytes_{};
    osc::OutboundPacketStream stream_;
    bool is_bundle_ = false;
    int messages_ = 0;
};

}  // namespace raks::engine
