#pragma once

#include <algorithm>
#include <atomic>
#include <cstddef>
#include <thread>
#include <vector>

namespace raks {

/// Calls work(0) ... work(count - 1), each once, on up to `threads` threads (the caller's among
/// them; at most 256), in no fixed order. Results stored by index are the same for any number of
/// threads. `work` must not throw.
template <typename Work>
void run_parallel(std::size_t count, int threads, const Work& work) {
    std::atomic<std::size_t> next{0};
    const auto take_turns = [&] {
        // relaxed: the counter only deals out indices; join() publishes the results.
        for (std::size_t i = next.fetch_add(1, std::memory_order_relaxed); i < count;
             i = next.fetch_add(1, std::memory_order_relaxed)) {
            work(i);
        }
    };
    std::vector<std::thread> others;
    const std::size_t wanted = static_cast<std::size_t>(std::clamp(threads, 1, 256));
    for (std::size_t i = 1; i < std::min(wanted, count); ++i) {
        others.emplace_back(take_turns);
    }
    take_turns();
    for (std::thread& other : others) {
        other.join();
    }
}

}  // namespace raks
