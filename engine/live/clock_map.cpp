#include "engine/live/clock_map.hpp"

#include <algorithm>
#include <cmath>

namespace raks::engine {
namespace {

// Bandwidth of the loop: wide while it settles, then narrow enough to average the jitter of
// callbacks (5 ms and more on a busy machine) and wide enough to follow a crystal that warms up.
constexpr double kFirstBandwidthHz = 1.0;
constexpr double kBandwidthHz = 0.1;
constexpr double kSettleSeconds = 4.0;
// More than this is no jitter: audio was lost, or the machine slept.
constexpr double kJumpSeconds = 0.2;
// Crystals differ by 0.02 %; anything beyond 1 % is an artefact of the first callbacks.
constexpr double kMaxDrift = 0.01;

}  // namespace

StreamTime ClockLine::stream_at(HostTime host) const noexcept {
    if (!is_running) {
        return stream_anchor;
    }
    // Differences in double seconds: exact enough near the anchor, which moves with every block.
    return stream_anchor + nanos_from_seconds(to_seconds(host - host_anchor) * stream_per_host);
}

HostTime ClockLine::host_at(StreamTime stream) const noexcept {
    if (!is_running) {
        return host_anchor;
    }
    return host_anchor + nanos_from_seconds(to_seconds(stream - stream_anchor) / stream_per_host);
}

void ClockMap::update(StreamTime stream, HostTime host) noexcept RAKS_NONBLOCKING {
    const double block = to_seconds(stream - line_.stream_anchor);
    // Backwards or not running: the line of before says nothing about this block.
    if (!line_.is_running || block < 0.0) {
        restart(stream, host);
        return;
    }
    // The same block again gives no new slope: dividing by its length would fail.
    if (block == 0.0) {
        return;
    }
    // Prediction error of the loop: how much later this block came than the line said.
    const HostTime expected = line_.host_at(stream);
    const double error = to_seconds(host - expected);
    if (std::abs(error) > kJumpSeconds) {
        restart(stream, host);
        return;
    }
    // The bandwidth narrows linearly over the settling time.
    seconds_since_restart_ += block;
    const double settled = std::min(1.0, seconds_since_restart_ / kSettleSeconds);
    const double bandwidth = kFirstBandwidthHz + settled * (kBandwidthHz - kFirstBandwidthHz);
    // A block longer than the loop's time constant would make it unstable.
    const double omega = std::min(0.5, 2.0 * M_PI * bandwidth * block);
    // Second-order loop (Adriaensen 2005), damping 1 / sqrt(2): the anchor is corrected by sqrt(2)
    // omega times the error, the slope by omega squared times the error per second of the block.
    line_.stream_anchor = stream;
    line_.host_anchor = expected + nanos_from_seconds(std::sqrt(2.0) * omega * error);
    const double host_per_stream = 1.0 / line_.stream_per_host + omega * omega * error / block;
    line_.stream_per_host = std::clamp(1.0 / host_per_stream, 1.0 - kMaxDrift, 1.0 + kMaxDrift);
}

void ClockMap::stop(StreamTime stream) noexcept RAKS_NONBLOCKING {
    line_.stream_anchor = stream;
    line_.is_running = false;
}

// Slope 1 through this pair: the device's drift is learnt again from here.
void ClockMap::restart(StreamTime stream, HostTime host) noexcept {
    line_ = {stream, host, 1.0, true};
    seconds_since_restart_ = 0.0;
}

}  // namespace raks::engine
