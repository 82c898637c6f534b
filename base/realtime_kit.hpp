#pragma once

#include <sys/types.h>

namespace raks {

/// Asks RealtimeKit, the service of desktops that gives real-time priorities to programs of people
/// without the right to take them, for one for the calling thread (SCHED_RR). True when it was
/// granted. Costs a question over D-Bus, answered in milliseconds; given up after 0.3 s.
///
/// RealtimeKit wants a bound on what a real-time thread computes in one go (RLIMIT_RTTIME), which
/// is set for the process. Should a thread ever reach it, all threads that were granted a priority
/// here become ordinary ones, instead of the system ending the process. Threads: any. Real-time: no
/// (it waits for an answer).
[[nodiscard]] bool ask_realtime_kit(int priority) noexcept;

}  // namespace raks
