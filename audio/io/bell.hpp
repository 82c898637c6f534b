#pragma once

#include <semaphore.h>

#include "base/realtime.hpp"
#include "base/sleep_until.hpp"

namespace raks::audio {

/// Wakes one thread from another. Rings are counted: one that comes before the wait ends it at
/// once. Threads: ring() from any, wait() from one. Real-time: ring() yes (never blocks), wait()
/// no.
class Bell {
 public:
    Bell() noexcept { sem_init(&semaphore_, 0, 0); }  ///< silent
    ~Bell() { sem_destroy(&semaphore_); }             ///< nobody waits any more
    Bell(const Bell&) = delete;                       ///< not copied: threads hold its address
    Bell& operator=(const Bell&) = delete;            ///< as above

    /// Ends one wait.
    void ring() noexcept RAKS_NONBLOCKING {
        // POSIX lets it be called even from signal handlers: it waits for nobody.
        RAKS_TRUSTED(sem_post(&semaphore_));
    }
    /// Waits until it rings, at most 100 ms.
    void wait() noexcept {
        const timespec until = timespec_of(HostClock::now() + std::chrono::milliseconds(100));
        sem_clockwait(&semaphore_, CLOCK_MONOTONIC, &until);
    }

 private:
    sem_t semaphore_{};
};

}  // namespace raks::audio
