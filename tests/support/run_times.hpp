#pragma once

#include <algorithm>
#include <cstdint>
#include <ctime>
#include <vector>

namespace raks::test {

/// The CPU time of this thread in each of many runs of the same thing.
///
///     RunTimes times;
///     for (...) { times.begin(); tick(); times.end(); }
///     EXPECT_LE(times.worst_over_median(), 6.0);
class RunTimes {
 public:
    void begin() noexcept { began_ = now(); }
    void end() { spans_.push_back(now() - began_); }

    /// The longest, in nanoseconds.
    [[nodiscard]] std::int64_t worst() const {
        return *std::max_element(spans_.begin(), spans_.end());
    }
    [[nodiscard]] std::int64_t median() const {
        std::vector<std::int64_t> sorted = spans_;
        const auto middle = sorted.begin() + static_cast<std::ptrdiff_t>(sorted.size() / 2);
        std::nth_element(sorted.begin(), middle, sorted.end());
        return *middle;
    }
    [[nodiscard]] double worst_over_median() const {
        return static_cast<double>(worst()) / static_cast<double>(median());
    }

 private:
    static std::int64_t now() noexcept {
        timespec time{};
        clock_gettime(CLOCK_THREAD_CPUTIME_ID, &time);
        return std::int64_t{1'000'000'000} * time.tv_sec + time.tv_nsec;
    }

    std::int64_t began_ = 0;
    std::vector<std::int64_t> spans_;
};

}  // namespace raks::test
