#include "engine/remote/osc_requests.hpp"

#include <oscpack/osc/OscReceivedElements.h>

#include <cmath>
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

/// A packet that is being read.
class OscReader {
 public:
    explicit OscReader(HostTime now) : now_(now) {}

    void read(const osc::ReceivedPacket& packet) {
        packet.IsBundle() ? read(osc::ReceivedBundle(packet), 1)
                          : read(osc::ReceivedMessage(packet));
    }
    [[nodiscard]] OscRequests take() { return std::move(result_); }
    void count(std::string fault) {
        ++result_.faults;
        if (result_.fault.empty()) {
            result_.fault = std::move(fault);
        }
    }

 private:
    void read(const osc::ReceivedBundle& bundle, int depth) {
        if (depth > kDeepestOscBundle) {
            count("bundles in bundles are too deep");
            return;
        }
        for (auto part = bundle.ElementsBegin(); part != bundle.ElementsEnd(); ++part) {
            part->IsBundle() ? read(osc::ReceivedBundle(*part), depth + 1)
                             : read(osc::ReceivedMessage(*part));
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
