#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <ctime>
#include <vector>

namespace raks::test {

/// The CPU time of this thread in each of many runs of the same thing.
///
///     RunTimes times;
///     for (...) { times.begin(); tick(); times.end(); times.keep(); }
///     EXPECT_LE(times.worst_over_median(), 6.0);
///
/// What the machine does for others in a thread's time is counted as that thread's: now and then a
/// run is ten times as long as the same run at any other time. Where all runs can be made again in
/// the same order, start_again() takes the shorter time of each.
class RunTimes {
 public:
    void begin() noexcept { began_ = now(); }
    void end() noexcept { last_ = now() - began_; }
    /// The run that has ended counts.
    void keep() {
        if (next_ < spans_.size()) {
            spans_[next_] = std::min(spans_[next_], last_);
        } else {
            spans_.push_back(last_);
        }
        ++next_;
    }
    /// The next run that is kept is the first one once more.
    void start_again() noexcept { next_ = 0; }

    /// How many runs count.
    [[nodiscard]] std::size_t count() const noexcept { return spans_.size(); }
    /// The longest, in nanoseconds; count() > 0.
    [[nodiscard]] std::int64_t worst() const {
        return *std::max_element(spans_.begin(), spans_.end());
    }
    /// The one in the middle; count() > 0.
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
    std::int64_t last_ = 0;
    std::vector<std::int64_t> spans_;
    std::size_t next_ = 0;
};

}  // namespace raks::test
