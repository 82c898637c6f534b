#pragma once

#include <cstdint>

/// Marks a function that runs on the audio or motion thread: no allocation, lock, system call that
/// can block, throw or log. The rtsan build (clang 22) checks it when it runs, and
/// -Wfunction-effects when it is compiled; g++ knows no such attribute.
#if defined(__clang__) && __has_cpp_attribute(clang::nonblocking)
#define RAKS_NONBLOCKING [[clang::nonblocking]]
#else
#define RAKS_NONBLOCKING
#endif

namespace raks {

/// Sets flush-to-zero and denormals-are-zero on this thread and restores the old state at the end,
/// so that decaying signals cost the same and give the same bits everywhere (a loop that decays
/// into denormals is 60 times slower without it).
/// Threads: any. Real-time: yes.
class FlushToZeroScope {
 public:
    FlushToZeroScope() noexcept;                         ///< sets both modes
    ~FlushToZeroScope();                                 ///< restores them; on the same thread
    FlushToZeroScope(const FlushToZeroScope&) = delete;  ///< not copyable: the state is a thread's
    FlushToZeroScope& operator=(const FlushToZeroScope&) = delete;  ///< not assignable

 private:
    std::uint32_t saved_;
};

}  // namespace raks
