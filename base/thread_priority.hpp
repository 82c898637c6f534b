#pragma once

#include <string_view>

namespace raks {

/// How urgent a real-time thread is among them, low to high: what serves another must be above it.
enum class RealtimeThread { outputs, motion, callback, transport };

/// Above every priority that a system gives: see prefer_this_thread().
inline constexpr int kAnyPriority = 100;

/// Asks the system to run the calling thread before all ordinary ones (SCHED_FIFO); where that is
/// refused, RealtimeKit (SCHED_RR, see realtime_kit.hpp); and last, to run it before most of them
/// (nice -11). True when one of these was granted. The thread gets a name
/// by which `top -H` and the like show it: raks-outputs, raks-motion, raks-audio, raks-transport.
///
/// The priorities are low, so that no sound server and none of its clients waits for Raks. `below`:
/// of a thread that the calling one must stay below all the same; where that leaves no real-time
/// priority, 1 and less, the thread is an ordinary one afterwards, and the result false.
/// Threads: any. Real-time: no (RealtimeKit may let one wait).
bool prefer_this_thread(RealtimeThread kind, int below = kAnyPriority) noexcept;

/// Lets all threads of this process whose name begins with `prefix` run after others (nice 10):
/// what draws in software must not hold up sound. Returns how many there were.
/// Threads: any. Real-time: no.
int put_threads_behind(std::string_view prefix) noexcept;

}  // namespace raks
