#include "engine/trials/block_clock.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include "base/statistics.hpp"

namespace raks::engine {
namespace {

// Blocks within this many seconds to either side of a frame date it.
constexpr double kMedianSeconds = 0.5;

}  // namespace

HostTime BlockClock::heard_at(std::int64_t frame) const {
    // Every block says when frame 0 would have been; a late wake-up says too late. The median over
    // the blocks nearby takes such ones out.
    const std::int64_t reach = std::llround(kMedianSeconds * rate_.hertz());
    const auto is_before = [](const Mark& mark, std::int64_t at) { return mark.frame < at; };
    // At least one block, even when the frame lies outside the recording.
    const auto from = std::lower_bound(marks_.begin(), marks_.end() - 1, frame - reach, is_before);
    const auto to = std::lower_bound(from + 1, marks_.end(), frame + reach, is_before);
    std::vector<Nanos> origins;  // host time of frame 0, as each block has it
    for (auto mark = from; mark != to; ++mark) {
        origins.push_back(mark->heard.time_since_epoch() -
                          rate_.time_of(mark->frame).time_since_epoch());
    }
    return HostTime(upper_median(std::move(origins)) + rate_.time_of(frame).time_since_epoch());
}

std::int64_t BlockClock::frame_near(HostTime host) const {
    const auto after = std::upper_bound(
        marks_.begin() + 1, marks_.end(), host, [](HostTime time, const Mark& mark) {
            return time < mark.heard;
        });
    const Mark& before = *(after - 1);
    return before.frame + std::llround(to_seconds(host - before.heard) * rate_.hertz());
}

}  // namespace raks::engine
