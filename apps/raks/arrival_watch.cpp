#include "apps/raks/arrival_watch.hpp"

#include <arpa/inet.h>
#include <netinet/in.h>
#include <poll.h>
#include <sys/socket.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <memory>
#include <numeric>
#include <optional>
#include <string_view>

#include "base/thread_priority.hpp"
#include "engine/outputs/osc_packet.hpp"
#include "engine/outputs/output.hpp"

#include <fmt/format.h>

namespace raks::apps {
namespace {

constexpr int kLookMs = 50;         // a receiver's thread looks so often whether it shall end
constexpr double kSettles = 10.0;   // seconds of music: until then the beat may be sought
constexpr double kNearBeat = 0.15;  // of a beat that is out: farther ones are of no beat

// A socket of its own port on 127.0.0.1.
std::optional<int> bind_any(const Descriptor& socket) {
    sockaddr_in address{};
    address.sin_family = AF_INET;
    address.sin_addr.s_addr = htonl(INADDR_LOOPBACK);
    socklen_t length = sizeof(address);
    auto* const raw = reinterpret_cast<sockaddr*>(&address);
    return bind(socket.number, raw, length) == 0 && getsockname(socket.number, raw, &length) == 0
               ? std::optional<int>(ntohs(address.sin_port))
               : std::nullopt;
}

bool is_readable(int file) {
    pollfd state{file, POLLIN, 0};
    return poll(&state, 1, kLookMs) > 0;
}

// The moment of a bundle's time tag.
HostTime moment_of(std::string_view bundle, HostTime now) {
    std::uint64_t tag = 0;
    for (std::size_t i = 8; i < 16; ++i) {
        tag = (tag << 8U) | static_cast<unsigned char>(bundle[i]);
    }
    const auto apart = static_cast<std::int64_t>(tag - engine::osc_time(now));
    return now + nanos_from_seconds(static_cast<double>(apart) / 4294967296.0);
}

}  // namespace

Expected<std::unique_ptr<ArrivalWatch>> ArrivalWatch::open() {
    std::unique_ptr<ArrivalWatch> watch(new ArrivalWatch);
    watch->osc_socket_ = Descriptor(socket(AF_INET, SOCK_DGRAM | SOCK_CLOEXEC, 0));
    watch->os2l_socket_ = Descriptor(socket(AF_INET, SOCK_STREAM | SOCK_CLOEXEC, 0));
    const auto osc = bind_any(watch->osc_socket_);
    const auto os2l = bind_any(watch->os2l_socket_);
    if (!osc || !os2l || listen(watch->os2l_socket_.number, 1) != 0) {
        return fail("no port on 127.0.0.1 to receive beats at");
    }
    watch->osc_port_ = *osc;
    watch->os2l_port_ = *os2l;
    watch->osc_thread_ = std::thread([raw = watch.get()] { raw->hear_osc(); });
    watch->os2l_thread_ = std::thread([raw = watch.get()] { raw->hear_os2l(); });
    return watch;
}

ArrivalWatch::~ArrivalWatch() {
    is_stopping_ = true;
    osc_thread_.join();
    os2l_thread_.join();
}

std::vector<engine::OutputWish> ArrivalWatch::wishes() const {
    std::vector<engine::OutputWish> wishes;
    for (const engine::OutputKind& kind : engine::output_kinds()) {
        if (kind.option == "osc") {
            wishes.push_back({&kind, fmt::format("127.0.0.1:{}", osc_port_)});
        } else if (kind.option == "os2l") {
            wishes.push_back({&kind, fmt::format("127.0.0.1:{}", os2l_port_)});
        }
    }
    return wishes;
}

// The trigger comes first; the bundle behind it says when the beat was meant to be heard.
void ArrivalWatch::hear_osc() {
    prefer_this_thread(RealtimeThread::transport);
    std::array<char, 2048> bytes{};
    HostTime trigger{};
    while (!is_stopping_) {
        if (!is_readable(osc_socket_.number)) {
            continue;
        }
        const ssize_t got = recv(osc_socket_.number, bytes.data(), bytes.size(), 0);
        const HostTime now = host_now();
        const std::string_view packet(bytes.data(),
                                      static_cast<std::size_t>(std::max<ssize_t>(got, 0)));
        if (packet.starts_with("/raks/trigger/beat")) {
            trigger = now;
        } else if (packet.size() > 16 && packet.starts_with("#bundle") &&
                   packet.find("/raks/beat") != std::string_view::npos) {
            const std::lock_guard lock(mutex_);
            osc_.push_back({trigger, moment_of(packet, now)});
        }
    }
}

void ArrivalWatch::hear_os2l() {
    prefer_this_thread(RealtimeThread::transport);
    std::array<char, 2048> bytes{};
    Descriptor connection;
    while (!is_stopping_) {
        const int file = connection.number >= 0 ? connection.number : os2l_socket_.number;
        if (!is_readable(file)) {
            continue;
        }
        if (connection.number < 0) {
            connection = Descriptor(accept4(os2l_socket_.number, nullptr, nullptr, SOCK_CLOEXEC));
            continue;
        }
        const ssize_t got = recv(connection.number, bytes.data(), bytes.size(), 0);
        const HostTime now = host_now();
        if (got <= 0) {
            connection.close();
        } else if (std::string_view(bytes.data(), static_cast<std::size_t>(got))
                       .starts_with("{\"evt\":\"beat\"")) {
            const std::lock_guard lock(mutex_);
            os2l_.push_back({now});
        }
    }
}

void ArrivalWatch::add_spread(const std::string& name,
                              const std::vector<Arrival>& arrivals,
                              const std::vector<engine::AudibleBeat>& audible,
                              const audio::GeneratedMusic& music,
                              BenchReport& report) const {
    std::vector<double> late;
    std::size_t beats = 0;
    for (const engine::AudibleBeat& beat : audible) {
        if (to_seconds(music.beats[beat.beat].time) < kSettles) {
            continue;
        }
        ++beats;
        for (const Arrival& arrival : arrivals) {
            if (const double apart = to_seconds(arrival.at - beat.heard);
                std::abs(apart) < kNearBeat) {
                late.push_back(1e3 * apart);
            }
        }
    }
    report.values.emplace_back(name + "_beats_heard", static_cast<double>(beats));
    report.values.emplace_back(name + "_beats_arrived", static_cast<double>(late.size()));
    if (late.empty()) {
        return;
    }
    const double mean =
        std::accumulate(late.begin(), late.end(), 0.0) / static_cast<double>(late.size());
    std::vector<double> deviations;
    deviations.reserve(late.size());
    for (const double one : late) {
        deviations.push_back(std::abs(one - mean));
    }
    report.values.emplace_back(name + "_arrival_mean_ms", mean);
    report.spreads.emplace_back(name + "_arrival_deviation_ms", spread_of(std::move(deviations)));
}

void ArrivalWatch::add_to(BenchReport& report,
                          const std::vector<engine::AudibleBeat>& audible,
                          const audio::GeneratedMusic& music) const {
    const std::lock_guard lock(mutex_);
    add_spread("osc", osc_, audible, music, report);
    add_spread("os2l", os2l_, audible, music, report);
    std::vector<double> behind;
    behind.reserve(osc_.size());
    for (const Arrival& arrival : osc_) {
        behind.push_back(1e3 * to_seconds(arrival.at - arrival.meant));
    }
    report.spreads.emplace_back("osc_after_meant_ms", spread_of(std::move(behind)));
}

}  // namespace raks::apps
