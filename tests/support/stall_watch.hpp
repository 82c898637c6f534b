#pragma once

#include <atomic>
#include <chrono>
#include <thread>
#include <vector>

namespace raks::test {

/// Whether the machine itself stood still: on each core a thread above every sound server's wakes
/// each 2 ms; what it wakes too late is time that no program had. A figure of real time that was
/// measured then says nothing about the program.
///
///     const StallWatch watch;
///     ... measure ...
///     if (watch.is_machine_slow()) { ... measure again, or skip ... }
class StallWatch {
 public:
    StallWatch();
    ~StallWatch();
    StallWatch(const StallWatch&) = delete;
    StallWatch& operator=(const StallWatch&) = delete;

    /// The core that lost most since the start; a wake up to 2 ms late is not counted.
    [[nodiscard]] std::chrono::nanoseconds lost() const noexcept;
    /// Half a hundredth of the time since the start is lost.
    [[nodiscard]] bool is_machine_slow() const noexcept;

 private:
    void watch(std::size_t core) noexcept;

    std::chrono::steady_clock::time_point start_ = std::chrono::steady_clock::now();
    std::atomic<bool> ends_{false};
    std::vector<std::atomic<std::int64_t>> lost_ns_;
    std::vector<std::thread> threads_;
};

}  // namespace raks::test
