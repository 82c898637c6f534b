#pragma once

#include <cstdint>
#include <string>

namespace raks::test {

/// What a thread did that a real-time thread must not do.
struct RealtimeCounts {
    std::uint64_t allocations = 0;  ///< malloc, calloc, realloc, aligned_alloc, posix_memalign
    std::uint64_t frees = 0;
    std::uint64_t locks = 0;   ///< pthread_mutex_lock
    std::uint64_t throws = 0;  ///< __cxa_allocate_exception
    long waits = 0;            ///< voluntary context switches (ru_nvcsw): sleeps, futex waits, I/O
    long page_faults = 0;      ///< memory that was not there yet (minor) or was on disk (major)

    /// True when nothing forbidden was counted. Page faults are not among it: the first use of
    /// memory and of code has them, and the system may take memory away that is not locked.
    [[nodiscard]] bool is_clean() const noexcept {
        return allocations == 0 && frees == 0 && locks == 0 && throws == 0 && waits == 0;
    }
    [[nodiscard]] std::string describe() const;
};

/// Counts what this thread does from here to stop(). The counting replaces malloc and friends in
/// every test program (under address and thread sanitizer it uses their hooks, and counts no
/// locks and throws there; under the thread sanitizer no waits either: its own would count).
///
///     RealtimeScope scope;
///     analyzer.process(block, sink);
///     EXPECT_TRUE(scope.stop().is_clean()) << scope.stop().describe();
class RealtimeScope {
 public:
    RealtimeScope() noexcept;
    ~RealtimeScope();
    RealtimeScope(const RealtimeScope&) = delete;
    RealtimeScope& operator=(const RealtimeScope&) = delete;

    /// Ends the region (once) and returns what was counted in it.
    const RealtimeCounts& stop() noexcept;

 private:
    RealtimeCounts counts_;
    bool is_running_ = true;
};

}  // namespace raks::test
