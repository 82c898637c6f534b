#include "engine/remote/osc_requests.hpp"

#include <oscpack/osc/OscReceivedElements.h>

#include <cmath>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <string_view>
#include <utility>

#include "base/expected.hpp"
#include "base/printable.hpp"
#include "engine/control/remote_request.hpp"

#include <fmt/format.h>

namespace raks::engine {
namespace {

constexpr std::string_view kPrefix = "/raks/do/";
// Of one packet: enough for all actions at once.
constexpr std::size_t kMostMessages = 256;

// The library takes sizes as signed numbers, and does not come to an end where one is negative.
bool has_whole_parts(std::string_view bundle) {
    constexpr std::size_t kHead = 16;  // "#bundle" and the time tag
    constexpr std::size_t kSize = 4;
    std::size_t at = kHead;
    while (at + kSize <= bundle.size()) {
        std::uint32_t size = 0;
        for (std::size_t i = 0; i < kSize; ++i) {
            size = size << 8U | static_cast<unsigned char>(bundle[at + i]);
        }
        at += kSize;
        if (size > bundle.size() - at) {
            return false;
        }
        at += size;
    }
    return at >= bundle.size();
}

/// A packet that is being read.
class OscReader {
 public:
    explicit OscReader(HostTime now) : now_(now) {}

    void read(const osc::ReceivedPacket& packet) {
        packet.IsBundle() ? read_bundle(packet, 1) : read(osc::ReceivedMessage(packet));
    }
    [[nodiscard]] OscRequests take() { return std::move(result_); }
    void count(std::string fault) {
        ++result_.faults;
        if (result_.fault.empty()) {
            result_.fault = std::move(fault);
        }
    }

 private:
    // A packet, or a part of a bundle, that is a bundle itself.
    template <typename Part>
    void read_bundle(const Part& from, int depth) {
        if (depth > kDeepestOscBundle) {
            count("bundles in bundles are too deep");
            return;
        }
        if (!has_whole_parts({from.Contents(), static_cast<std::size_t>(from.Size())})) {
            count("no OSC: the parts of a bundle do not fit into it");
            return;
        }
        const osc::ReceivedBundle bundle(from);
        for (auto part = bundle.ElementsBegin(); part != bundle.ElementsEnd(); ++part) {
            part->IsBundle() ? read_bundle(*part, depth + 1) : read(osc::ReceivedMessage(*part));
        }
    }

    void read(const osc::ReceivedMessage& message) {
        if (++messages_ > kMostMessages) {
            count("too many messages in one packet");
            return;
        }
        const std::string_view address = message.AddressPattern();
        if (!address.starts_with(kPrefix)) {
            count(fmt::format("{} is unknown: addresses begin with {}",
                              printable(std::string(address.substr(0, 80))),
                              kPrefix));
            return;
        }
        if (auto done = ask(address.substr(kPrefix.size()), message); !done) {
            count(done.error().message);
        }
    }

    Expected<void> ask(std::string_view name, const osc::ReceivedMessage& message) {
        if (message.ArgumentCount() > 1) {
            return fail(fmt::format("{}: one argument is taken", printable(std::string(name))));
        }
        std::string value;
        if (message.ArgumentCount() == 1) {
            const auto argument = message.ArgumentsBegin();
            if (const auto number = number_of(*argument)) {
                if (*number == 0.0) {
                    return {};  // a button that is let go
                }
                const auto row = find_action(name);
                value = row && !(*row)->value ? "" : fmt::format("{}", *number);
            } else if (argument->IsString() || argument->IsSymbol()) {
                value = argument->IsString() ? argument->AsStringUnchecked()
                                             : argument->AsSymbolUnchecked();
            } else {
                return fail(
                    fmt::format("{}: a number or a text is taken", printable(std::string(name))));
            }
        }
        auto request = remote_request(name, value, now_);
        if (!request) {
            return fail(printable(request.error().message));
        }
        result_.requests.push_back(std::move(*request));
        return {};
    }

    static std::optional<double> number_of(const osc::ReceivedMessageArgument& argument) {
        if (argument.IsBool()) {
            return argument.AsBoolUnchecked() ? 1.0 : 0.0;
        }
        if (argument.IsInt32()) {
            return argument.AsInt32Unchecked();
        }
        if (argument.IsInt64()) {
            return static_cast<double>(argument.AsInt64Unchecked());
        }
        if (argument.IsFloat()) {
            const float number = argument.AsFloatUnchecked();
            return std::isfinite(number) ? std::optional<double>(number) : std::nullopt;
        }
        if (argument.IsDouble() && std::isfinite(argument.AsDoubleUnchecked())) {
            return argument.AsDoubleUnchecked();
        }
        return std::nullopt;
    }

    HostTime now_;
    OscRequests result_;
    std::size_t messages_ = 0;
};

}  // namespace

OscRequests read_osc_requests(std::span<const char> packet, HostTime now) {
    OscReader reader(now);
    if (packet.empty() || packet.size() > kLongestOscPacket) {
        reader.count("a packet has 1 to 8192 bytes");
        return reader.take();
    }
    // The library says by exceptions what is wrong with a packet.
    try {
        reader.read(osc::ReceivedPacket(
            packet.data(), static_cast<osc::osc_bundle_element_size_t>(packet.size())));
    } catch (const osc::Exception& fault) {
        reader.count(std::string("no OSC: ") + fault.what());
    }
    return reader.take();
}

}  // namespace raks::engine
