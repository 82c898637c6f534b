#include "engine/remote/osc_input.hpp"

#include <poll.h>
#include <sys/eventfd.h>
#include <sys/socket.h>

#include <array>
#include <cerrno>
#include <chrono>
#include <cstddef>
#include <system_error>
#include <utility>

#include "engine/remote/listen_place.hpp"
#include "engine/remote/osc_requests.hpp"

namespace raks::engine {

Expected<void> check_osc_input(const std::string& place) {
    const auto parsed = parse_listen_place(place, std::nullopt);
    return parsed ? Expected<void>() : fail(parsed.error());
}

Expected<std::unique_ptr<OscInput>> OscInput::open(const std::string& place, RequestInbox& inbox) {
    const auto parsed = parse_listen_place(place, std::nullopt);
    if (!parsed) {
        return fail("--osc-in: " + parsed.error().message);
    }
    const auto bound = bind_to(*parsed, SOCK_DGRAM);
    if (!bound) {
        return fail("--osc-in: " + bound.error().message);
    }
    Descriptor socket(*bound);
    Descriptor stop(eventfd(0, EFD_CLOEXEC | EFD_NONBLOCK));
    if (stop.number < 0) {
        return fail("--osc-in: " + std::generic_category().message(errno));
    }
    return std::unique_ptr<OscInput>(new OscInput(
        Descriptor(socket.release()), Descriptor(stop.release()), parsed->text(), inbox));
}

OscInput::OscInput(Descriptor socket, Descriptor stop, std::string place, RequestInbox& inbox)
    : place_(std::move(place)), inbox_(inbox) {
    socket_ = std::move(socket);
    stop_ = std::move(stop);
    thread_ = std::thread([this] { run(); });
}

OscInput::~OscInput() {
    const std::uint64_t one = 1;
    static_cast<void>(!write(stop_.number, &one, sizeof(one)));
    thread_.join();
}

void OscInput::run() {
    std::array<pollfd, 2> waits = {{{socket_.number, POLLIN, 0}, {stop_.number, POLLIN, 0}}};
    for (;;) {
        if (poll(waits.data(), waits.size(), -1) < 0 && errno != EINTR) {
            complain(std::generic_category().message(errno));
            return;
        }
        if (waits[1].revents != 0) {
            return;
        }
        if (waits[0].revents != 0) {
            read_one();
        }
    }
}

void OscInput::read_one() {
    std::array<char, kLongestOscPacket + 1> bytes{};
    const ssize_t size = recv(socket_.number, bytes.data(), bytes.size(), 0);
    const HostTime now = HostClock::now();
    if (size < 0) {
        return;
    }
    if (!has_budget(now)) {
        ++passed_over_;
        return;
    }
    OscRequests read =
        read_osc_requests(std::span(bytes).first(static_cast<std::size_t>(size)), now);
    passed_over_ += read.faults;
    if (!read.fault.empty()) {
        complain(std::move(read.fault));
    }
    for (ActionRequest& request : read.requests) {
        ++(inbox_.post(std::move(request)) ? taken_ : passed_over_);
    }
}

bool OscInput::has_budget(HostTime now) {
    if (now - second_ >= std::chrono::seconds(1)) {
        second_ = now;
        packets_ = 0;
    }
    return ++packets_ <= kMostPackets;
}

void OscInput::complain(std::string fault) {
    const std::lock_guard lock(mutex_);
    if (!std::exchange(has_complained_, true)) {
        trouble_ = std::move(fault);
    }
}

std::optional<std::string> OscInput::take_trouble() {
    const std::lock_guard lock(mutex_);
    return std::exchange(trouble_, std::nullopt);
}

}  // namespace raks::engine
