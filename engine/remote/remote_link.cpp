#include <arpa/inet.h>
#include <ifaddrs.h>
#include <net/if.h>
#include <netinet/in.h>

#include <array>

#include "engine/remote/remote_server.hpp"

#include <fmt/format.h>

namespace raks::engine {
namespace {

// Of IPv4, as every router at home has it; 127.0.0.1 where there is no network.
std::string address_that_others_see() {
    ifaddrs* all = nullptr;
    std::string found = "127.0.0.1";
    if (getifaddrs(&all) != 0) {
        return found;
    }
    for (const ifaddrs* one = all; one != nullptr; one = one->ifa_next) {
        const bool is_up = (one->ifa_flags & IFF_UP) != 0 && (one->ifa_flags & IFF_LOOPBACK) == 0;
        if (is_up && one->ifa_addr != nullptr && one->ifa_addr->sa_family == AF_INET) {
            std::array<char, INET_ADDRSTRLEN> text{};
            const auto* const address = reinterpret_cast<const sockaddr_in*>(one->ifa_addr);
            inet_ntop(AF_INET, &address->sin_addr, text.data(), text.size());
            found = text.data();
            break;
        }
    }
    freeifaddrs(all);
    return found;
}

}  // namespace

std::string remote_link(const ListenPlace& place, const std::string& token) {
    ListenPlace seen = place;
    if (place.address == "0.0.0.0" || place.address == "::") {
        seen.address = address_that_others_see();
    }
    return fmt::format("http://{}/?token={}", seen.text(), token);
}

}  // namespace raks::engine
