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

/// The same code, in which -Wfunction-effects trusts the calls that it cannot see into: other
/// libraries' functions that are known not to block, what frees nothing as it is known to be empty.
/// A comment beside it says why. The rtsan build checks these calls all the same.
#if defined(__clang__) && __has_cpp_attribute(clang::nonblocking)
#define RAKS_TRUSTED(...)                                                                       \
    _Pragma("clang diagnostic push") _Pragma("clang diagnostic ignored \"-Wfunction-effects\"") \
        __VA_ARGS__ _Pragma("clang diagnostic pop")
#else
#define RAKS_TRUSTED(...) __VA_ARGS__
#endif

namespace raks {

/// Sets flush-to-zero and denormals-are-zero on this thread and restores the old state at the end,
/// so that decaying signals cost the same and give the same bits everywhere (a loop that decays
/// into denormals is 60 times slower without it).
/// Threads: any. Real-time: yes.
class FlushToZeroScope {
 public:
    FlushToZeroScope() noexcept RAKS_NONBLOCKING;        ///< sets both modes
    ~FlushToZeroScope() RAKS_NONBLOCKING;                ///< restores them; on the same thread
    FlushToZeroScope(const FlushToZeroScope&) = delete;  ///< not copyable: the state is a thread's
    FlushToZeroScope& operator=(const FlushToZeroScope&) = delete;  ///< not assignable

 private:
    std::uint32_t saved_;
};

}  // namespace raks
