#include "engine/outputs/osc_packet.hpp"

#include <chrono>

namespace raks::engine {

// The wall clock is asked each time: it may be set while the program runs.
std::uint64_t osc_time(HostTime moment) {
    constexpr std::int64_t kSecondsTo1970 = 2'208'988'800;
    constexpr std::int64_t kNanosInSecond = 1'000'000'000;
    const auto since_1970 =
        std::chrono::duration_cast<Nanos>(std::chrono::system_clock::now().time_since_epoch());
    const std::int64_t nanos = (since_1970 + (moment - host_now())).count();
    const auto seconds = static_cast<std::uint64_t>(nanos / kNanosInSecond + kSecondsTo1970);
    const auto rest = static_cast<std::uint64_t>(nanos % kNanosInSecond);
    return (seconds << 32U) | ((rest << 32U) / static_cast<std::uint64_t>(kNanosInSecond));
}

}  // namespace raks::engine
