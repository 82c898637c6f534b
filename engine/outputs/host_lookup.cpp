#include "engine/outputs/host_lookup.hpp"

#include <netdb.h>

#include <cstring>
#include <mutex>
#include <string>
#include <system_error>
#include <thread>

namespace raks::engine {
namespace {

Expected<SocketAddress> look_up(const HostPort& place, int flags) {
    addrinfo hints{};
    hints.ai_socktype = SOCK_DGRAM;  // one answer an address; the ports are the same
    hints.ai_flags = flags | AI_NUMERICSERV;
    addrinfo* list = nullptr;
    const int error =
        getaddrinfo(place.host.c_str(), std::to_string(place.port).c_str(), &hints, &list);
    if (error != 0 || list == nullptr) {
        return fail(std::string("the host is not known (") + gai_strerror(error) + ")");
    }
    SocketAddress address;
    address.length = list->ai_addrlen;
    std::memcpy(&address.storage, list->ai_addr, list->ai_addrlen);
    freeaddrinfo(list);
    return address;
}

}  // namespace

struct HostLookup::Answer {
    std::mutex mutex;
    std::optional<Expected<SocketAddress>> found;
};

HostLookup::HostLookup(const HostPort& place) : answer_(std::make_shared<Answer>()) {
    if (auto address = look_up(place, AI_NUMERICHOST)) {
        answer_->found = std::move(address);
        return;
    }
    try {
        std::thread([answer = answer_, place] {
            auto found = look_up(place, 0);
            const std::lock_guard lock(answer->mutex);
            answer->found = std::move(found);
        }).detach();
    } catch (const std::system_error&) {
        answer_->found = fail("the system has no thread left to look the host up");
    }
}

std::optional<Expected<SocketAddress>> HostLookup::found() const {
    const std::lock_guard lock(answer_->mutex);
    return answer_->found;
}

}  // namespace raks::engine
